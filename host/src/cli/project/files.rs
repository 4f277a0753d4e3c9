//! Files of projects: reading them, searching them, and temporary ones for tools to write.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::failure::Failure;
use crate::report::text::{Text, text};

/// Reads a text file.
///
/// # Errors
///
/// When it cannot be read, or is not UTF-8.
pub fn read(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|error| {
        Failure::input(text!("failed to read `{}`: {}", Text::of_path(path), error))
    })
}

/// Whether one of the files in a folder fulfils a condition, down to that many folders below it.
/// Hidden folders and `node_modules` are left out.
pub fn any(folder: &Path, depth: u32, condition: &mut dyn FnMut(&Path) -> bool) -> bool {
    let Ok(entries) = fs::read_dir(folder) else {
        return false;
    };
    entries.flatten().any(|entry| {
        let (path, name) = (entry.path(), entry.file_name());
        match entry.file_type() {
            Ok(kind) if kind.is_dir() => {
                let is_skipped = name == "node_modules" || name.to_string_lossy().starts_with('.');
                depth > 0 && !is_skipped && any(&path, depth - 1, condition)
            }
            Ok(kind) => kind.is_file() && condition(&path),
            Err(_) => false,
        }
    })
}

/// A place for a file in a temporary folder, which is removed with it.
pub struct Temporary {
    folder: tempfile::TempDir,
    path: PathBuf,
}

impl Temporary {
    /// A place for a file of that name; nothing is there yet.
    ///
    /// # Errors
    ///
    /// When the folder cannot be created.
    pub fn new(name: &str) -> Result<Self, Failure> {
        let folder = tempfile::tempdir().map_err(|error| {
            Failure::internal(text!("failed to create a temporary folder: {}", error))
        })?;
        // Tools report canonical paths.
        let path = folder
            .path()
            .canonicalize()
            .unwrap_or_else(|_| folder.path().to_owned());
        let path = path.join(name);
        Ok(Self { folder, path })
    }

    /// A file with this content.
    ///
    /// # Errors
    ///
    /// When it cannot be written.
    pub fn with(name: &str, text: &str) -> Result<Self, Failure> {
        let file = Self::new(name)?;
        file.write(text)?;
        Ok(file)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The folder, in which there may be other files.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or_else(|| self.folder.path())
    }

    /// Replaces the content.
    ///
    /// # Errors
    ///
    /// When it cannot be written.
    pub fn write(&self, text: &str) -> Result<(), Failure> {
        fs::write(&self.path, text).map_err(|error| {
            Failure::internal(text!(
                "failed to write `{}`: {}",
                Text::of_path(&self.path),
                error
            ))
        })
    }

    /// What a tool has written there.
    ///
    /// # Errors
    ///
    /// When it has not.
    pub fn read(&self) -> Result<Vec<u8>, Failure> {
        fs::read(&self.path).map_err(|error| {
            Failure::internal(text!(
                "failed to read `{}`: {}",
                Text::of_path(&self.path),
                error
            ))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_down_to_a_depth() {
        let folder = tempfile::tempdir().unwrap();
        for path in [
            "a/b/deep.txt",
            ".git/hidden.txt",
            "node_modules/installed.txt",
        ] {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "").unwrap();
        }
        let found = |name: &str, depth| any(folder.path(), depth, &mut |path| path.ends_with(name));
        assert!(found("deep.txt", 2));
        assert!(!found("deep.txt", 1));
        assert!(!found("hidden.txt", 9) && !found("installed.txt", 9));
    }
}
