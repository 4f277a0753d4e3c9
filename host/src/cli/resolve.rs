//! Robots and mazes by their content: [`Robots`] and [`Mazes`] at hand.
//!
//! A recorded result names what it was played with by digest. Those that come with
//! wasmouse are always at hand, generated mazes are made by their names, and the rest
//! is searched in the files and folders that the user names.

use std::fs;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::mazes::{self, Source};
use super::robots;
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::maze::{Maze, bundled as bundled_mazes, format};
use crate::report::result::{RecordedMaze, RecordedRobot};
use crate::report::escape::for_terminal as visible;
use crate::robot::bundled::{BundledRobot, bundled as bundled_robots};
use crate::robot::{Digest, Trust};

/// Something that has the recorded name and another content.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Namesake {
    /// What to call it: a name or a path.
    pub label: String,
    /// The digest of its content.
    pub digest: Digest,
}

/// Robots in files, and those that come with wasmouse.
pub struct Robots {
    files: Vec<RobotFile>,
    bytes_max: u64,
}

struct RobotFile {
    path: PathBuf,
    digest: Digest,
}

/// A robot that is at hand.
pub enum FoundRobot<'a> {
    /// It comes with wasmouse.
    Bundled(&'static BundledRobot),
    /// It is this file.
    File(&'a Path),
}

impl Robots {
    /// The robots in these files, and in the `.wasm` files of these folders without
    /// their subfolders. Of a file, `bytes_max` and one more are read.
    ///
    /// # Errors
    ///
    /// When a file or folder cannot be read, or a folder has no such file.
    pub fn load(paths: &[PathBuf], bytes_max: u64) -> Result<Self, Failure> {
        let mut files = Vec::new();
        for path in paths {
            let own = if path.is_dir() {
                folder(path)?
            } else {
                vec![path.clone()]
            };
            for path in own {
                let digest = Digest::of(&robots::read_file(&path, bytes_max)?);
                files.push(RobotFile { path, digest });
            }
        }
        Ok(Self { files, bytes_max })
    }

    /// The robot with the recorded digest.
    pub fn find(&self, robot: RecordedRobot<'_>) -> Option<FoundRobot<'_>> {
        let mut bundled = bundled_robots().iter();
        if let Some(found) = bundled.find(|it| it.sha256 == robot.sha256) {
            return Some(FoundRobot::Bundled(found));
        }
        let mut files = self.files.iter();
        let found = files.find(|file| file.digest.hex() == robot.sha256)?;
        Some(FoundRobot::File(&found.path))
    }

    /// A robot that has the recorded name, but not the digest.
    pub fn namesake(&self, robot: RecordedRobot<'_>) -> Option<Namesake> {
        let setting = format!(":{}", robot.setting);
        let name = robot.name.strip_suffix(&setting).unwrap_or(robot.name);
        let mut files = self.files.iter();
        let is_called = |path: &Path| {
            path.file_stem().is_some_and(|stem| stem == name) || path == Path::new(name)
        };
        if let Some(file) = files.find(|file| is_called(&file.path)) {
            return Some(Namesake {
                label: file.path.display().to_string(),
                digest: file.digest,
            });
        }
        let bundled = bundled_robots().iter().find(|it| it.name == name)?;
        Some(Namesake {
            label: format!("{name} of this version"),
            digest: Digest::of(bundled.component),
        })
    }

    /// The bytes of a robot, and whose code it is.
    ///
    /// # Errors
    ///
    /// When its file cannot be read any more, or has changed.
    pub fn read(&self, robot: &FoundRobot<'_>, sha256: &str) -> Result<(Vec<u8>, Trust), Failure> {
        match robot {
            FoundRobot::Bundled(robot) => Ok((robot.component.to_vec(), Trust::Trusted)),
            FoundRobot::File(path) => {
                let bytes = robots::read_file(path, self.bytes_max)?;
                if Digest::of(&bytes).hex() == sha256 {
                    return Ok((bytes, Trust::Stranger));
                }
                let path = visible(&path.display().to_string());
                Err(Failure::input(format!(
                    "robot `{path}` has changed since this command began"
                )))
            }
        }
    }
}

fn folder(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    let shown = visible(&path.display().to_string());
    let failed = |error| Failure::input(format!("failed to read folder `{shown}`: {error}"));
    let mut files = Vec::new();
    for entry in fs::read_dir(path).map_err(failed)? {
        let file = entry.map_err(failed)?.path();
        if robots::has_wasm_extension(&file) && file.is_file() {
            files.push(file);
        }
    }
    if files.is_empty() {
        let message = format!("folder `{shown}` has no robots");
        return Err(Failure::input(message).hint("robots end in .wasm"));
    }
    files.sort();
    Ok(files)
}

/// Mazes that the user names, and those that come with wasmouse.
pub struct Mazes {
    all: Vec<MazeAtHand>,
}

struct MazeAtHand {
    label: String,
    short_name: String,
    maze: Maze,
    digest: Digest,
}

impl MazeAtHand {
    fn new(source: &Source, maze: Maze) -> Self {
        Self {
            label: source.label(),
            short_name: source.short_name(),
            digest: Digest::of(&maze.identity_bytes()),
            maze,
        }
    }
}

impl Mazes {
    /// The mazes that these specifications name. Files of a folder that are no mazes
    /// are passed over.
    ///
    /// # Errors
    ///
    /// When a specification is wrong, or the file that it names is no maze.
    pub fn load(specifications: &[String]) -> Result<Self, Failure> {
        let mut all: Vec<MazeAtHand> = Vec::new();
        for specification in specifications {
            let is_folder = Path::new(specification).is_dir();
            for source in mazes::resolve(specification)? {
                match source.read() {
                    Ok((maze, _)) => all.push(MazeAtHand::new(&source, maze)),
                    Err(_) if is_folder => {}
                    Err(failure) => return Err(failure),
                }
            }
        }
        all.extend(bundled_mazes().iter().map(|maze| {
            let parsed = format::parse(maze.text).expect("bundled mazes parse");
            MazeAtHand::new(&Source::Bundled(maze), parsed.maze)
        }));
        Ok(Self { all })
    }

    /// The maze with the recorded digest.
    pub fn find(&self, maze: RecordedMaze<'_>) -> Option<Maze> {
        let is_meant = |digest: &Digest| digest.hex() == maze.sha256;
        if let Some(found) = self.all.iter().find(|it| is_meant(&it.digest)) {
            return Some(found.maze.clone());
        }
        generated(maze.name).filter(|it| is_meant(&Digest::of(&it.identity_bytes())))
    }

    /// A maze that has the recorded name, but not the digest.
    pub fn namesake(&self, maze: RecordedMaze<'_>) -> Option<Namesake> {
        let name = maze.name;
        let mut all = self.all.iter();
        if let Some(found) = all.find(|it| it.short_name == name || it.label == name) {
            return Some(Namesake {
                label: found.label.clone(),
                digest: found.digest,
            });
        }
        generated(name).map(|maze| Namesake {
            label: name.to_owned(),
            digest: Digest::of(&maze.identity_bytes()),
        })
    }
}

/// The maze that a name generates, when it names a single one.
fn generated(name: &str) -> Option<Maze> {
    let spec: GenSpec = Some(name)
        .filter(|name| GenSpec::is_meant_by(name))?
        .parse()
        .ok()?;
    if spec.count() != 1 {
        return None;
    }
    spec.expand().next().map(|(_, maze)| maze)
}
