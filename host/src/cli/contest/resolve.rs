//! [`resolve`]: from the entries of a contest file to robots and mazes.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use wasmouse_core::game::Ruleset;
use wasmouse_core::maze::bundled as bundled_mazes;
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::{Digest, GuestText};

use super::super::failure::Failure;
use super::super::maze_source::{self, Source};
use super::super::mazes::{self, BadFiles, Legality, Request};
use super::super::output::message;
use super::super::pattern;
use super::super::project;
use super::super::robots::{self, RobotSpec};
use super::load::ContestFolder;
use crate::contest::config::{FilePath, suggestion};
use crate::contest::{MazeSet, MazeSource, NamesFrom, RobotSource, RobotsEntry, Seeds};
use crate::report::text::{Text, text};

/// What a contest file names, found. Mazes are read, robots are not.
pub struct Resolved {
    /// The robots, by entry, then by file, then by variant.
    pub robots: Vec<ResolvedRobot>,
    /// The sets with their mazes. No maze is in two sets, or twice in one.
    pub sets: Vec<ResolvedSet>,
    /// The rules.
    pub rules: Arc<Ruleset>,
    /// The seeds.
    pub seeds: Seeds,
}

/// A robot of a contest.
pub struct ResolvedRobot {
    /// The robot. `entrants::load` makes entrants of it.
    pub spec: RobotSpec,
    /// What results call it. Names are unique.
    pub name: GuestText,
    /// Who submitted it; `None` for bundled robots.
    pub author: Option<GuestText>,
    /// The class that the file says it competes in. Else it depends on what it uses:
    /// [`ContestFile::class_by_usage`](crate::contest::ContestFile::class_by_usage).
    pub class: Option<GuestText>,
}

/// A set of mazes.
pub struct ResolvedSet {
    /// The set.
    pub set: MazeSet,
    /// Its mazes. At least one.
    pub mazes: Vec<MazeSource>,
}

impl Resolved {
    /// How many matches there are, if all robots are admitted and different.
    pub fn matches(&self) -> u64 {
        let mazes: u64 = self.sets.iter().map(|it| it.mazes.len() as u64).sum();
        self.robots.len() as u64 * mazes * u64::from(self.seeds.count)
    }
}

/// Finds all robots and mazes of a contest; robot projects are built.
///
/// # Errors
///
/// When a path names nothing, a maze cannot be used or is in two sets, two robots have the same
/// name, or there are no robots. A pattern or a folder without robots is a warning: they may come
/// later.
pub fn resolve(contest: &ContestFolder) -> Result<Resolved, Failure> {
    let rules = contest.file.rules.ruleset();
    let rules = rules.expect("a parsed file has a bundled ruleset as its base");
    Ok(Resolved {
        robots: all_robots(contest)?,
        sets: all_mazes(contest)?,
        rules: Arc::new(rules),
        seeds: contest.file.seeds.into(),
    })
}

fn all_robots(contest: &ContestFolder) -> Result<Vec<ResolvedRobot>, Failure> {
    let mut found = Vec::new();
    for (index, entry) in contest.file.robots.iter().enumerate() {
        let robots = entry_robots(contest, entry, index)?;
        found.extend(robots.into_iter().map(|robot| (robot, entry)));
    }
    if found.is_empty() {
        let message = text!("`{}` names no robot", Text::of_path(contest.path()));
        return Err(Failure::input(message).hint("the warnings above say why"));
    }
    let specs: Vec<RobotSpec> = found.iter().map(|((spec, _), _)| spec.clone()).collect();
    let names = robots::unique_names(&specs)
        .map_err(|failure| failure.hint("`name` in `[[robots]]` gives a robot another name"))?;
    let robots = found.into_iter().zip(names);
    let robots = robots.map(|(((spec, author), entry), name)| ResolvedRobot {
        spec,
        name,
        author: entry
            .author
            .as_ref()
            .map(|it| it.as_str().into())
            .or(author),
        class: entry.class.as_ref().map(|it| it.as_str().into()),
    });
    Ok(robots.collect())
}

/// The robots of an entry, with the authors that their files name.
fn entry_robots(
    contest: &ContestFolder,
    entry: &RobotsEntry,
    index: usize,
) -> Result<Vec<(RobotSpec, Option<GuestText>)>, Failure> {
    let variants = entry.variant_numbers();
    let name = entry.name.as_ref().map(|it| GuestText::from(it.as_str()));
    let source = entry.source();
    let path = match source.expect("a parsed file says where robots are") {
        RobotSource::Path(path) => path,
        RobotSource::Bundled(robot) => {
            let spec = |variant| RobotSpec::of_bundled(robot, variant, name.clone());
            return Ok(variants.into_iter().map(|it| (spec(it), None)).collect());
        }
    };
    let files = robot_files(contest, path, &format!("robots[{index}].path"))?;
    if name.is_some() && files.len() > 1 {
        let key = format!("robots[{index}].name");
        let message = text!("`{}` has {} robots", path.as_str(), files.len());
        let failure = contest.failure_at(&key, message);
        return Err(failure.hint("give a name to a single robot"));
    }
    let mut robots = Vec::new();
    for file in files {
        let in_folder = entry.names_from == Some(NamesFrom::Folder);
        let named_by = if in_folder {
            file.parent()
        } else {
            Some(file.as_path())
        };
        let author = named_by.and_then(|it| {
            if in_folder {
                it.file_name()
            } else {
                it.file_stem()
            }
        });
        let author = author.map(|it| GuestText::from(it.to_string_lossy().into_owned()));
        let name = name
            .clone()
            .or_else(|| author.clone().filter(|_| in_folder));
        for &variant in &variants {
            let spec = RobotSpec::of_file(file.clone(), variant, name.clone());
            robots.push((spec, author.clone()));
        }
    }
    Ok(robots)
}

/// The files of the robots at a path.
fn robot_files(
    contest: &ContestFolder,
    path: &FilePath,
    key: &str,
) -> Result<Vec<PathBuf>, Failure> {
    if path.is_pattern() {
        // Never a project: building one runs what its author wrote, outside of any sandbox.
        let found = pattern::matches(contest.folder(), path.as_str(), robots::has_robot_extension)
            .map_err(|error| unreadable(contest, key, path, &error))?;
        if found.is_empty() {
            message!("warning: no robot matches `{}`", path.as_str());
        }
        return Ok(found.into_iter().filter(|it| it.is_file()).collect());
    }
    let full = contest.join(path);
    if !full.exists() {
        let message = text!("robot `{}` does not exist", path.as_str());
        let hint = "paths are relative to the folder of the contest file; `bundled` names a \
                    robot that comes with wasmouse";
        return Err(contest.failure_at(key, message).hint(hint));
    }
    if full.is_dir() && !project::is_project(&full) && !robots::has_robots(&full) {
        message!("warning: folder `{}` has no robots", path.as_str());
        return Ok(Vec::new());
    }
    robots::files_at(&full)
}

/// The sets of a contest with their mazes, which are read.
///
/// # Errors
///
/// When a path names nothing, or a maze cannot be used or is in two sets.
pub fn all_mazes(contest: &ContestFolder) -> Result<Vec<ResolvedSet>, Failure> {
    let mut sets = Vec::new();
    let mut requests = Vec::new();
    // Set and path of each.
    let mut origins = Vec::new();
    for (set, entry) in contest.file.mazes.iter().enumerate() {
        for (index, path) in entry.paths.iter().enumerate() {
            if GenSpec::is_meant_by(path.as_str()) {
                continue;
            }
            let key = format!("mazes[{set}].paths[{index}]");
            for source in maze_sources(contest, path, &key)? {
                requests.push(Request {
                    source,
                    rules: Legality::from_flag(entry.lenient),
                    bad_files: BadFiles::Fail,
                });
                origins.push((set, index));
            }
        }
    }
    let hint = "`lenient = true` in the set accepts it";
    let loaded = mazes::load_requests(&requests, hint)?;
    let mut loaded = loaded.into_iter().zip(origins).peekable();
    let mut seen = Seen::default();
    for (set, entry) in contest.file.mazes.iter().enumerate() {
        let mut mazes = Vec::new();
        for (index, path) in entry.paths.iter().enumerate() {
            // No two paths generate the same maze: the parser has seen to that.
            if GenSpec::is_meant_by(path.as_str()) {
                let generated = maze_source::specification(path.as_str())?.expand();
                mazes.extend(generated.map(MazeSource::Generated));
            }
            while let Some((maze, _)) = loaded.next_if(|(_, origin)| *origin == (set, index)) {
                let Some(maze) = maze else { continue };
                if seen.is_new(&maze, (set, index), contest)? {
                    mazes.push(maze);
                }
            }
        }
        sets.push(ResolvedSet {
            set: entry.maze_set(),
            mazes,
        });
    }
    Ok(sets)
}

/// The mazes that were read, with set and name of each.
#[derive(Default)]
struct Seen(HashMap<Digest, (usize, GuestText)>);

impl Seen {
    /// Whether a maze of a path of a set is none of those before. It may be one of its own set.
    fn is_new(
        &mut self,
        maze: &MazeSource,
        (set, index): (usize, usize),
        contest: &ContestFolder,
    ) -> Result<bool, Failure> {
        let MazeSource::Loaded { name, maze } = maze else {
            return Ok(true);
        };
        let (other, twin) = match self.0.entry(maze.digest()) {
            Entry::Vacant(place) => {
                place.insert((set, name.clone()));
                return Ok(true);
            }
            Entry::Occupied(twin) => twin.get().clone(),
        };
        if other == set {
            message!(
                "warning: skipped `{}`, which is the same maze as `{}`",
                name.escaped(),
                twin.escaped()
            );
            return Ok(false);
        }
        let sets = [set, other].map(|it| contest.file.mazes[it].set.as_str());
        let message = text!(
            "maze `{}` of set `{}` is the same as `{}` of set `{}`",
            name.escaped(),
            sets[0],
            twin.escaped(),
            sets[1]
        );
        let key = format!("mazes[{set}].paths[{index}]");
        let failure = contest.failure_at(&key, message);
        Err(failure.hint("a maze can be in one set only"))
    }
}

/// The mazes that a path of a set names, if it is no specification.
fn maze_sources(
    contest: &ContestFolder,
    path: &FilePath,
    key: &str,
) -> Result<Vec<Source>, Failure> {
    let text = path.as_str();
    if let Some(maze) = bundled_mazes().iter().find(|maze| maze.name == text) {
        return Ok(vec![Source::Bundled(maze)]);
    }
    if path.is_pattern() {
        let is_maze = |it: &Path| maze_source::is_maze_file(it) && it.is_file();
        let found = pattern::matches(contest.folder(), text, is_maze)
            .map_err(|error| unreadable(contest, key, path, &error))?;
        if found.is_empty() {
            return Err(contest.failure_at(key, text!("no maze matches `{}`", text)));
        }
        return Ok(found.into_iter().map(Source::File).collect());
    }
    maze_source::at_path(&contest.join(path))?.ok_or_else(|| {
        let names = bundled_mazes().iter().map(|maze| maze.name);
        let hint = suggestion(text, names)
            .unwrap_or_else(|| "paths are relative to the folder of the contest file".to_owned());
        let message = text!("maze `{}` does not exist", text);
        contest.failure_at(key, message).hint(hint)
    })
}

fn unreadable(
    contest: &ContestFolder,
    key: &str,
    path: &FilePath,
    error: &std::io::Error,
) -> Failure {
    let message = text!("failed to find files for `{}`: {}", path.as_str(), error);
    contest.failure_at(key, message)
}
