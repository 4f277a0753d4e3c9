//! [`MazeFile`]: where an edited maze comes from and goes to.

use std::io;
use std::path::{Path, PathBuf};

use wasmouse_core::maze::Maze;
use wasmouse_core::maze::format::{self, Format, TEXT_BYTES_MAX};

use super::super::super::failure::Failure;
use super::super::super::input;
use super::super::super::output::{self, Existing};
use crate::report::text::{Text, text};

/// A maze file that is written as a whole or not at all.
pub struct MazeFile {
    path: PathBuf,
    format: Format,
    /// What the file has as far as is known; `None` if there should be no file.
    known: Option<Vec<u8>>,
}

/// Why a maze was not saved. The file is as it was.
#[derive(Debug)]
pub enum NotSaved {
    /// The file is not what it was when it was read or saved: somebody else has written it.
    Changed,
    /// It cannot be written.
    Failed(Failure),
}

impl MazeFile {
    /// A file that is not there yet.
    pub const fn new(path: PathBuf, format: Format) -> Self {
        Self {
            path,
            format,
            known: None,
        }
    }

    /// The maze in a file, and the file.
    ///
    /// # Errors
    ///
    /// When it cannot be read or is no maze.
    pub fn open(path: &Path) -> Result<(Self, Maze), Failure> {
        let failed = |reason: Text| {
            Failure::input(text!(
                "failed to parse maze `{}`: {}",
                Text::of_path(path),
                reason
            ))
        };
        let bytes = input::read_file(path, TEXT_BYTES_MAX as u64)
            .map_err(|error| input::failure("maze", path, &error))?;
        let text = std::str::from_utf8(&bytes)
            .map_err(|error| failed(text!("byte {} is not UTF-8", error.valid_up_to())))?;
        let parsed = format::parse(text).map_err(|error| failed(text!("{}", error)))?;
        let file = Self {
            path: path.to_owned(),
            format: parsed.format,
            known: Some(bytes),
        };
        Ok((file, parsed.maze))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// How mazes are written in it.
    pub const fn format(&self) -> Format {
        self.format
    }

    /// Writes a maze. The file is replaced when all of it has been written.
    ///
    /// # Errors
    ///
    /// When somebody else has changed the file, unless `anyway`, or it cannot be written.
    pub fn save(&mut self, maze: &Maze, anyway: bool) -> Result<(), NotSaved> {
        let text = format::print(maze, self.format).map_err(|error| {
            NotSaved::Failed(Failure::input(text!(
                "failed to write `{}`: {}",
                Text::of_path(&self.path),
                error
            )))
        })?;
        if !anyway && self.is_changed() {
            return Err(NotSaved::Changed);
        }
        // A file that appeared a moment ago is kept.
        let existing = match self.known {
            None if !anyway => Existing::Keep,
            _ => Existing::Replace,
        };
        output::save(&self.path, text.as_bytes(), existing).map_err(NotSaved::Failed)?;
        self.known = Some(text.into_bytes());
        Ok(())
    }

    fn is_changed(&self) -> bool {
        match input::read_file(&self.path, TEXT_BYTES_MAX as u64) {
            Ok(bytes) => self.known != Some(bytes),
            // A file that was removed is written again.
            Err(error) => error.kind() != io::ErrorKind::NotFound,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use wasmouse_core::maze::{Cell, Heading, Walls, bundled};

    use super::*;

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().expect("a temporary folder")
    }

    fn other(maze: &Maze) -> Maze {
        let mut walls = maze.walls().clone();
        walls.set(Cell::new(0, 0), Heading::Right, true);
        Maze::contest(walls).expect("start and goal fit")
    }

    #[test]
    fn mazes_are_saved_in_the_format_they_were_read_in() {
        let folder = folder();
        let parsed = format::parse(bundled()[0].text).expect("a maze");
        for format in Format::ALL {
            let path = folder.path().join(format.name());
            fs::write(&path, format::print(&parsed.maze, format).expect("text")).expect("a file");
            let (mut file, maze) = MazeFile::open(&path).expect("a maze");
            assert_eq!((file.format(), &maze), (format, &parsed.maze));
            file.save(&other(&maze), false).expect("saved");
            file.save(&maze, false).expect("saved once more");
            file.save(&other(&maze), false).expect("and again");
            let (file, saved) = MazeFile::open(&path).expect("a maze");
            assert_eq!((file.format(), saved), (format, other(&maze)));
        }
    }

    #[test]
    fn what_others_wrote_is_kept_unless_told_otherwise() {
        let folder = folder();
        let path = folder.path().join("a.txt");
        let maze = Maze::contest(Walls::open(4)).expect("start and goal fit");
        let mut file = MazeFile::new(path.clone(), Format::Num);
        fs::write(&path, "somebody was faster").expect("a file");
        assert!(matches!(file.save(&maze, false), Err(NotSaved::Changed)));
        assert_eq!(fs::read(&path).expect("a file"), b"somebody was faster");
        file.save(&maze, true).expect("saved anyway");
        assert_eq!(MazeFile::open(&path).expect("a maze").1, maze);
        fs::remove_file(&path).expect("a file");
        file.save(&maze, false)
            .expect("a file that is gone is written again");
    }

    #[test]
    fn a_failed_save_keeps_the_file() {
        let folder = folder();
        let path = folder.path().join("a.txt");
        fs::write(&path, bundled()[0].text).expect("a file");
        let (mut file, maze) = MazeFile::open(&path).expect("a maze");
        // The format has no place for another start.
        let moved = Maze::new(maze.walls().clone(), Cell::new(1, 0), maze.goal()).expect("fits");
        let Err(NotSaved::Failed(failure)) = file.save(&moved, false) else {
            panic!("it cannot be written")
        };
        assert!(failure.to_string().contains("start"), "{failure}");
        assert_eq!(
            fs::read_to_string(&path).expect("a file"),
            bundled()[0].text
        );
        // Its folder is gone, and with it the room for a new file.
        let path = folder.path().join("lost/a.txt");
        let mut file = MazeFile::new(path.clone(), Format::Udacity);
        assert!(matches!(file.save(&maze, false), Err(NotSaved::Failed(_))));
        assert!(!path.exists());
    }
}
