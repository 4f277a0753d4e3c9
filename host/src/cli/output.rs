//! Where commands write: data to standard output and files, messages to standard error.

use std::fmt;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::failure::Failure;

/// Prints a message for the user to standard error, formatted as by `format!`.
macro_rules! message {
    ($($arguments:tt)*) => {
        $crate::cli::output::write_message(format_args!($($arguments)*))
    };
}

pub(in crate::cli) use message;

/// Writes text to standard output.
///
/// A reader that closes the pipe early, such as `head`, is no failure.
///
/// # Errors
///
/// When standard output cannot be written for another reason, such as a full disk.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = Stdout::default();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush());
    written.map_err(|error| stdout_failure(&error))
}

/// The failure to write standard output.
pub fn stdout_failure(error: &io::Error) -> Failure {
    Failure::internal(format!("failed to write to standard output: {error}"))
}

/// Standard output that goes on writing into nothing when its reader has closed the pipe.
#[derive(Debug, Default)]
pub struct Stdout {
    closed: bool,
}

impl Stdout {
    fn unless_closed<T>(&mut self, written: io::Result<T>, otherwise: T) -> io::Result<T> {
        match written {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(otherwise)
            }
            other => other,
        }
    }
}

impl Write for Stdout {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.closed {
            return Ok(bytes.len());
        }
        let written = io::stdout().lock().write(bytes);
        self.unless_closed(written, bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.closed {
            return Ok(());
        }
        let flushed = io::stdout().lock().flush();
        self.unless_closed(flushed, ())
    }
}

/// Writes a line to standard error.
///
/// Whether it can be written decides nothing: results and exit codes are the same when
/// standard error is closed, or on a full disk.
pub fn write_message(line: fmt::Arguments<'_>) {
    let _ = writeln!(anstream::stderr(), "{line}");
}

/// What to do with a file that already exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// Keep it and fail.
    Keep,
    /// Replace it: `--force`.
    Replace,
}

impl Existing {
    /// What the flag `--force` asks for.
    pub const fn from_flag(force: bool) -> Self {
        if force { Self::Replace } else { Self::Keep }
    }
}

/// Writes a file so that its name never stands for half of it.
///
/// # Errors
///
/// As [`Draft::create`] and [`Draft::commit`].
pub fn save(path: &Path, bytes: &[u8], existing: Existing) -> Result<(), Failure> {
    let mut draft = Draft::create(path, existing)?;
    let written = draft.write_all(bytes);
    written.map_err(|error| failure(path, &error))?;
    draft.commit()
}

/// A file that is being written under a temporary name, beside the one that it will replace.
#[derive(Debug)]
pub struct Draft {
    path: PathBuf,
    /// Behind symbolic links, so that they stay.
    target: PathBuf,
    file: io::BufWriter<NamedTempFile>,
    existing: Existing,
}

impl Draft {
    /// Begins to write a file. Called before long work, so that it is not lost over a name.
    ///
    /// # Errors
    ///
    /// When the file exists and is to be kept, when a folder or a device has its name, which a
    /// rename would destroy, or when its folder cannot be written to.
    pub fn create(path: &Path, existing: Existing) -> Result<Self, Failure> {
        let target = target(path, existing)?;
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            // As for any new file; without it, temporary files are private.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = builder
            .tempfile_in(folder(&target))
            .map_err(|error| failure(path, &error))?;
        Ok(Self {
            path: path.to_owned(),
            target,
            file: io::BufWriter::new(file),
            existing,
        })
    }

    /// Puts the complete file in its place.
    ///
    /// # Errors
    ///
    /// When it cannot be written or renamed.
    pub fn commit(self) -> Result<(), Failure> {
        let failed = |error: &io::Error| failure(&self.path, error);
        let file = self.file.into_inner();
        let file = file.map_err(|error| failed(error.error()))?;
        let persisted = match self.existing {
            Existing::Keep => file.persist_noclobber(&self.target),
            Existing::Replace => file.persist(&self.target),
        };
        persisted.map(drop).map_err(|error| failed(&error.error))
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

fn folder(target: &Path) -> &Path {
    match target.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

fn target(path: &Path, existing: Existing) -> Result<PathBuf, Failure> {
    match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let folder = folder(path);
            if folder.is_dir() {
                Ok(path.to_owned())
            } else {
                Err(Failure::input(format!(
                    "failed to write `{}`: the folder `{}` does not exist",
                    path.display(),
                    folder.display()
                )))
            }
        }
        Err(error) => Err(failure(path, &error)),
        Ok(metadata) if !metadata.is_file() => Err(Failure::input(format!(
            "failed to write `{}`: not a regular file",
            path.display()
        ))),
        Ok(_) if existing == Existing::Keep => Err(Failure::input(format!(
            "failed to write `{}`: the file already exists",
            path.display()
        ))
        .hint("replace it with --force")),
        Ok(_) => path.canonicalize().map_err(|error| failure(path, &error)),
    }
}

fn failure(path: &Path, error: &io::Error) -> Failure {
    Failure::internal(format!("failed to write `{}`: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_kept_unless_forced() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.txt");
        save(&path, b"one", Existing::Keep).expect("a new file");
        let failure = save(&path, b"two", Existing::Keep).expect_err("it exists");
        assert!(failure.to_string().contains("--force"), "{failure}");
        assert_eq!(fs::read(&path).expect("a file"), b"one");
        save(&path, b"two", Existing::Replace).expect("forced");
        assert_eq!(fs::read(&path).expect("a file"), b"two");
        let files = fs::read_dir(folder.path()).expect("a folder").count();
        assert_eq!(files, 1, "temporary files are gone");
    }

    #[test]
    fn folders_and_missing_folders_are_rejected() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let failure = save(folder.path(), b"", Existing::Replace).expect_err("a folder");
        assert!(failure.to_string().contains("not a regular file"));
        let lost = folder.path().join("lost/a.txt");
        let failure = save(&lost, b"", Existing::Keep).expect_err("no folder");
        assert!(failure.to_string().contains("lost/a.txt"), "{failure}");
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_links_and_files_are_not_private() {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        save(&file, b"one", Existing::Keep).expect("a new file");
        let plain = folder.path().join("plain");
        fs::write(&plain, "").expect("a file");
        let mode = |path| {
            let metadata = fs::metadata(path).expect("a file");
            metadata.permissions().mode()
        };
        assert_eq!(mode(&file), mode(&plain));
        std::os::unix::fs::symlink(&file, &link).expect("a link");
        save(&link, b"two", Existing::Replace).expect("forced");
        assert!(fs::symlink_metadata(&link).expect("a link").is_symlink());
        assert_eq!(fs::read(&file).expect("a file"), b"two");
    }
}
