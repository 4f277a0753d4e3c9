//! [`ContestFolder`]: a contest file that was read, and the paths in it.

use std::path::{Path, PathBuf};

use super::super::failure::Failure;
use super::super::input;
use crate::contest::ContestFile;
use crate::contest::config::{BYTES_MAX, ConfigError, Document, FilePath, decode};
use crate::report::config::config_error;
use crate::report::text::{Printable, Text, text};

/// The name of the contest file in a folder that is given instead of it.
pub const FILE_NAME: &str = "contest.toml";

/// A contest file and the folder that it is in.
pub struct ContestFolder {
    /// The contest file.
    pub file: ContestFile,
    path: PathBuf,
    text: String,
}

/// The contest file that an argument means: itself, or the one in a folder.
pub fn contest_path(argument: &Path) -> PathBuf {
    if argument.is_dir() {
        argument.join(FILE_NAME)
    } else {
        argument.to_owned()
    }
}

impl ContestFolder {
    /// Reads the contest file, or the one in a folder.
    ///
    /// # Errors
    ///
    /// When it cannot be read, or something in it is wrong.
    pub fn read(argument: &Path) -> Result<Self, Failure> {
        let path = contest_path(argument);
        let bytes = input::read_file(&path, BYTES_MAX as u64).map_err(|error| {
            input::failure("contest file", &path, &error).hint("`wasmouse contest init` writes one")
        })?;
        let parsed = decode(&bytes).and_then(|text| Ok((ContestFile::parse(text)?, text)));
        let (file, text) = parsed.map_err(|error| failure(&path, &error))?;
        let text = text.to_owned();
        let contest = Self { file, path, text };
        contest.check_written()?;
        Ok(contest)
    }

    /// Checks that nothing that is written takes the place of the contest file.
    fn check_written(&self) -> Result<(), Failure> {
        let itself = self.path.canonicalize().ok();
        let outputs = self.outputs().into_iter();
        let outputs = outputs.map(|(key, path)| (format!("outputs.{key}"), path));
        let store = ("store".to_owned(), self.store());
        for (key, path) in outputs.chain([store]) {
            let is_itself = itself.is_some() && path.canonicalize().ok() == itself;
            if path == self.path || is_itself {
                let message = text!("`{}`: `{}` is the contest file", key, Text::of_path(&path));
                let failure = self.failure_at(&key, message);
                return Err(failure.hint("give it another name"));
            }
        }
        Ok(())
    }

    /// The path of the contest file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The folder that paths are relative to; empty for the current one.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// A path that the file names.
    pub fn join(&self, path: &FilePath) -> PathBuf {
        self.folder().join(path.as_str())
    }

    /// The database with the results.
    pub fn store(&self) -> PathBuf {
        match &self.file.store {
            Some(path) => self.join(path),
            None => self.path.with_extension("db"),
        }
    }

    /// Where each output goes, with its key: `html`, `csv`, `json`, `jsonl` or `markdown`.
    pub fn outputs(&self) -> Vec<(&'static str, PathBuf)> {
        let outputs = self.file.outputs.paths().into_iter();
        outputs.map(|(key, path)| (key, self.join(path))).collect()
    }

    /// The failure of something that a key of the file names, such as `robots[0].path`.
    pub fn failure_at(&self, key: &str, message: impl Printable) -> Failure {
        match Document::parse(&self.text) {
            Ok(document) => {
                let message = message.to_text();
                let error = document.error(key, "");
                failure(&self.path, &error_with(error, &message))
            }
            // It was parsed before.
            Err(error) => failure(&self.path, &error),
        }
    }
}

fn error_with(error: ConfigError, message: &Text) -> ConfigError {
    ConfigError {
        message: message.as_str().to_owned(),
        ..error
    }
}

/// What is wrong with a contest file.
fn failure(path: &Path, error: &ConfigError) -> Failure {
    let failure = Failure::input(config_error(&Text::of_path(path), error));
    match &error.hint {
        Some(hint) => failure.hint(hint),
        None => failure,
    }
}
