//! [`Source`]: what users write for a maze, resolved but not read.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use wasmouse_core::GuestText;
use wasmouse_core::maze::format::{self, Format, ParseError, Parsed, TEXT_BYTES_MAX};
use wasmouse_core::maze::generate::{GenSpec, GeneratedMaze};
use wasmouse_core::maze::{BundledMaze, Maze, bundled};

use super::failure::Failure;
use super::input;
use crate::contest::config::suggestion;
use crate::report::text::Text;

/// The endings of file names that count as mazes in a folder.
const EXTENSIONS: [&str; 4] = ["txt", "map", "maz", "num"];

/// The name and specification of standard input.
const STDIN: &str = "-";

/// One maze that an argument names, not yet read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A generated maze.
    Generated(GeneratedMaze),
    /// A maze that comes with wasmouse.
    Bundled(&'static BundledMaze),
    /// A file.
    File(PathBuf),
    /// Standard input, to its end.
    Stdin,
}

/// Whether a specification was written with a maze in mind, right or wrong.
pub fn is_meant_by(spec: &str) -> bool {
    let is_bundled = bundled().iter().any(|maze| maze.name == spec);
    spec == STDIN || is_bundled || GenSpec::is_meant_by(spec) || Path::new(spec).exists()
}

/// The sources that one specification names: one, or all mazes of a folder.
///
/// # Errors
///
/// When it names nothing, a `gen:` specification is wrong, or a folder cannot be listed or has no
/// mazes.
pub fn resolve(spec: &str) -> Result<Vec<Source>, Failure> {
    if spec == STDIN {
        return Ok(vec![Source::Stdin]);
    }
    if GenSpec::is_meant_by(spec) {
        return generated(spec);
    }
    if let Some(maze) = bundled().iter().find(|maze| maze.name == spec) {
        return Ok(vec![Source::Bundled(maze)]);
    }
    at_path(Path::new(spec))?.ok_or_else(|| unknown(spec))
}

/// The source at a path, or all mazes of a folder; `None` if nothing is there.
///
/// # Errors
///
/// When it cannot be read, or is a folder without mazes.
pub fn at_path(path: &Path) -> Result<Option<Vec<Source>>, Failure> {
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => folder(path).map(Some),
        Ok(_) => Ok(Some(vec![Source::File(path.to_owned())])),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(unreadable(path, &error)),
    }
}

impl Source {
    /// What messages and listings call it: the name, the path, or `-`.
    pub fn label(&self) -> GuestText {
        match self {
            Self::Generated(maze) => maze.to_string().into(),
            Self::Bundled(maze) => maze.name.into(),
            Self::File(path) => shown(path).into(),
            Self::Stdin => STDIN.into(),
        }
    }

    /// Reads the maze; the format is `None` when it did not come from text.
    ///
    /// # Errors
    ///
    /// When it cannot be read or is no maze.
    pub fn read(&self) -> Result<(Maze, Option<Format>), Failure> {
        let bytes = match self {
            Self::Generated(maze) => return Ok((maze.generate(), None)),
            Self::Bundled(maze) => maze.text.as_bytes().to_vec(),
            Self::File(path) => input::read_file(path, TEXT_BYTES_MAX as u64)
                .map_err(|error| unreadable(path, &error))?,
            Self::Stdin => input::read_stdin(TEXT_BYTES_MAX as u64)
                .map_err(|error| unreadable(Path::new(STDIN), &error))?,
        };
        let Parsed { format, maze } = self.parse(bytes)?;
        Ok((maze, Some(format)))
    }

    fn parse(&self, bytes: Vec<u8>) -> Result<Parsed, Failure> {
        let failed = |reason: &dyn std::fmt::Display| {
            Failure::input(format!(
                "failed to parse maze `{}`: {reason}",
                self.label().escaped()
            ))
        };
        let text = String::from_utf8(bytes).map_err(|error| {
            let place = error.utf8_error().valid_up_to();
            failed(&format!("byte {place} is not UTF-8"))
                .hint("save the file as UTF-8 or ASCII text")
        })?;
        format::parse(&text).map_err(|error| match &error {
            ParseError::Unrecognized { .. } => {
                failed(&error).hint("`wasmouse maze convert --help` describes the formats")
            }
            _ => failed(&error),
        })
    }

    /// What results call it, if nothing else is called so.
    pub fn short_name(&self) -> GuestText {
        match self {
            Self::File(path) => path
                .file_stem()
                .map_or_else(|| shown(path), |stem| shown(Path::new(stem)))
                .into(),
            Self::Generated(_) | Self::Bundled(_) | Self::Stdin => self.label(),
        }
    }
}

/// What a text that begins with `gen:` stands for.
///
/// # Errors
///
/// When it is no specification: an input like any other, wherever it stands.
pub fn specification(spec: &str) -> Result<GenSpec, Failure> {
    spec.parse().map_err(|error| {
        Failure::input(format!(
            "failed to generate `{}`: {error}",
            shown(Path::new(spec))
        ))
    })
}

fn generated(spec: &str) -> Result<Vec<Source>, Failure> {
    let mazes = specification(spec)?.expand();
    Ok(mazes.map(Source::Generated).collect())
}

fn folder(path: &Path) -> Result<Vec<Source>, Failure> {
    let files = input::list(path, is_maze_file).map_err(|error| unreadable(path, &error))?;
    if files.is_empty() {
        let message = format!("folder `{}` has no mazes", shown(path));
        let hint = format!("mazes end in .{}", EXTENSIONS.join(", ."));
        return Err(Failure::input(message).hint(hint));
    }
    Ok(files.into_iter().map(Source::File).collect())
}

/// Whether a file of a folder is taken for a maze: by the ending of its name.
pub fn is_maze_file(path: &Path) -> bool {
    let is_hidden = path
        .file_name()
        .is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
    let has_extension = path.extension().is_some_and(|extension| {
        EXTENSIONS
            .iter()
            .any(|known| extension.eq_ignore_ascii_case(known))
    });
    has_extension && !is_hidden
}

fn unreadable(path: &Path, error: &io::Error) -> Failure {
    input::failure("maze", path, error)
}

fn unknown(spec: &str) -> Failure {
    let message = format!(
        "unknown maze `{}`: no bundled maze, file or folder has this name",
        shown(Path::new(spec))
    );
    let names = bundled().iter().map(|maze| maze.name);
    Failure::input(message).hint(suggestion(spec, names.clone()).unwrap_or_else(|| {
        let names: Vec<&str> = names.collect();
        format!("bundled mazes are {}", names.join(", "))
    }))
}

/// A path for people.
fn shown(path: &Path) -> String {
    Text::of_path(path).as_str().to_owned()
}
