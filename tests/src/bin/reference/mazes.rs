//! The mazes that are not generated: official ones and those of competitions.

use std::env;
use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};

use wasmouse_core::maze::{Maze, bundled, format};

use crate::published::OFFICIAL;

/// The directory of an option, or the one in `$WASMOUSE_SHARED` if it exists.
fn directory(option: Option<&Path>, name: &str, shared: &str) -> Option<PathBuf> {
    let found = option.map(Path::to_owned).or_else(|| {
        let path = PathBuf::from(env::var_os("WASMOUSE_SHARED")?).join(shared);
        path.is_dir().then_some(path)
    });
    if found.is_none() {
        eprintln!("hint: without --{name} DIR or $WASMOUSE_SHARED, the page lacks {name} mazes");
    }
    found
}

fn failure(path: &Path, error: impl Display) -> String {
    format!("failed to read `{}`: {error}", path.display())
}

fn read(path: &Path) -> Result<Maze, String> {
    let text = fs::read_to_string(path).map_err(|error| failure(path, error))?;
    let parsed = format::parse(&text).map_err(|error| failure(path, error))?;
    Ok(parsed.maze)
}

/// The official maze 01, which is bundled.
pub fn maze_01() -> Maze {
    let parsed = format::parse(bundled()[0].text);
    parsed.expect("bundled mazes parse").maze
}

/// The official mazes 01, 02 and 03; `None` for those that are not available.
///
/// # Errors
///
/// If a file cannot be read or is a different maze.
pub fn official(option: Option<&Path>) -> Result<[Option<Maze>; 3], String> {
    let mut mazes = [Some(maze_01()), None, None];
    if let Some(directory) = directory(option, "official", "mazes/udacity") {
        for (maze, (name, _)) in mazes.iter_mut().zip(OFFICIAL).skip(1) {
            *maze = Some(read(&directory.join(name).with_extension("txt"))?);
        }
    }
    for (maze, (name, digest)) in mazes.iter().zip(OFFICIAL) {
        let actual = maze.as_ref().map(|it| it.digest().to_string());
        if actual.as_ref().is_some_and(|it| it != digest) {
            return Err(format!(
                "`{name}` is not the official maze: digest {actual:?}"
            ));
        }
    }
    Ok(mazes)
}

/// The competition mazes with the names of their files, sorted; empty if there is no directory.
///
/// # Errors
///
/// If a directory has no mazes, or something in it cannot be read.
pub fn competition(option: Option<&Path>) -> Result<Vec<(String, Maze)>, String> {
    let Some(directory) = directory(option, "competition", "mazes/competition") else {
        return Ok(Vec::new());
    };
    let mut mazes = Vec::new();
    for entry in fs::read_dir(&directory).map_err(|error| failure(&directory, error))? {
        let path = entry.map_err(|error| failure(&directory, error))?.path();
        let extension = path.extension().and_then(|it| it.to_str());
        if let (Some("txt" | "map" | "maz" | "num"), Some(name)) = (extension, path.file_stem()) {
            mazes.push((name.to_string_lossy().into_owned(), read(&path)?));
        }
    }
    mazes.sort_by(|(a, _), (b, _)| a.cmp(b));
    match mazes.is_empty() {
        true => Err(failure(&directory, "no mazes")),
        false => Ok(mazes),
    }
}
