//! Where commands write: data to standard output and files, messages to standard error.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use serde::Serialize;
use tempfile::NamedTempFile;

use super::exit::Exit;
use super::failure::Failure;
use crate::report::text::{Text, text};

/// Prints a message for the user to standard error, made as by `text!`: all
/// arguments are escaped.
macro_rules! message {
    ($($arguments:tt)*) => {
        $crate::cli::output::write_message(&$crate::report::text::text!($($arguments)*))
    };
}

pub(in crate::cli) use message;

/// Writes lines for people to standard output. Names in them should be escaped already, so that
/// none can look like a line of its own; whatever else controls a terminal is escaped here.
///
/// # Errors
///
/// As [`print_data`].
pub fn print(lines: &str) -> Result<(), Failure> {
    print_data(Text::of_lines(lines).as_str())
}

/// Writes data to standard output as it is: files, scripts, and pictures in colour.
///
/// # Errors
///
/// None at present: what goes wrong is kept for [`finish`], so that everything else is done
/// before the command fails.
pub fn print_data(text: &str) -> Result<(), Failure> {
    let mut stdout = Stdout::default();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush());
    written.map_err(|error| stdout_failure(&error))
}

/// The failure to write standard output.
pub fn stdout_failure(error: &io::Error) -> Failure {
    Failure::internal(text!("failed to write to standard output: {}", error))
}

/// The first error of standard output. What is written after it goes nowhere.
static LOST: OnceLock<io::Error> = OnceLock::new();

/// Whether standard output was closed when the process began.
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Notes whether standard output is closed, before the standard library opens `/dev/null` in its
/// place: what is written there would be lost without an error.
#[cfg(target_os = "linux")]
extern "C" fn note_closed_stdout() {
    let flags = rustix::io::fcntl_getfd(rustix::stdio::stdout());
    CLOSED.store(flags.is_err(), Ordering::Relaxed);
}

// SAFETY: the section has pointers to functions that run before `main`, and this is one. It makes
// a system call and stores a value, for which nothing needs to be set up.
#[cfg(target_os = "linux")]
#[used]
#[unsafe(link_section = ".init_array")]
static NOTE_CLOSED_STDOUT: extern "C" fn() = note_closed_stdout;

/// Standard output. The first error is kept for [`finish`], and what is written after it goes
/// nowhere: results also go into files, which have to be complete whatever happens here.
#[derive(Debug, Default)]
pub struct Stdout(());

impl Stdout {
    fn kept<T>(written: io::Result<T>, otherwise: T) -> io::Result<T> {
        match written {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => Err(error),
            Err(error) => {
                keep_error(error);
                Ok(otherwise)
            }
            written => written,
        }
    }
}

impl Write for Stdout {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if LOST.get().is_some() {
            return Ok(bytes.len());
        }
        if CLOSED.load(Ordering::Relaxed) {
            keep_error(io::Error::other("it is closed"));
            return Ok(bytes.len());
        }
        Self::kept(io::stdout().lock().write(bytes), bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if LOST.get().is_some() {
            return Ok(());
        }
        Self::kept(io::stdout().lock().flush(), ())
    }
}

/// Keeps an error of standard output for [`finish`].
pub fn keep_error(error: io::Error) {
    // Only the first one matters.
    let _ = LOST.set(error);
}

/// The exit code of a command that would have that one, when standard output may have been lost.
///
/// A reader that closes the pipe early, such as `head`, wants no message; but not all was
/// written, so it is no success either. Everything else is reported.
pub fn finish(exit: Exit) -> Exit {
    // Nothing is buffered but the rest of a line.
    let _ = Stdout::default().flush();
    match LOST.get() {
        None => exit,
        Some(error) if error.kind() == io::ErrorKind::BrokenPipe => match exit {
            Exit::Success => Exit::Unread,
            other => other,
        },
        // It was the terminal that was closed.
        Some(_) if exit == Exit::HungUp => exit,
        Some(error) => {
            write_message(&stdout_failure(error).report());
            Exit::Internal
        }
    }
}

/// Where a child process that was started for the user writes its stdout: ours is for results.
pub fn child_stdout() -> Stdio {
    io::stderr().into()
}

/// Writes a line to standard error.
///
/// Whether it can be written decides nothing: results and exit codes are the same when
/// standard error is closed, or on a full disk.
pub fn write_message(text: &Text) {
    let _ = writeln!(anstream::stderr(), "{}", text.as_str());
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

/// Writes a value as indented JSON.
///
/// # Errors
///
/// When the file cannot be written.
pub fn write_json(draft: &mut Draft, path: &Path, value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).expect("the value has a JSON form");
    let written = writeln!(draft, "{text}");
    written.map_err(|error| failure(path, &error))
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
        let file = temporary_file(folder(&target)).map_err(|error| failure(path, &error))?;
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

fn temporary_file(folder: &Path) -> io::Result<NamedTempFile> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // As for any new file; without it, temporary files are private.
        tempfile::Builder::new()
            .permissions(fs::Permissions::from_mode(0o666))
            .tempfile_in(folder)
    }
    #[cfg(not(unix))]
    NamedTempFile::new_in(folder)
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
                Err(Failure::input(text!(
                    "failed to write `{}`: the folder `{}` does not exist",
                    Text::of_path(path),
                    Text::of_path(folder)
                )))
            }
        }
        Err(error) => Err(failure(path, &error)),
        Ok(metadata) if !metadata.is_file() => Err(Failure::input(text!(
            "failed to write `{}`: not a regular file",
            Text::of_path(path)
        ))),
        Ok(_) if existing == Existing::Keep => Err(Failure::input(text!(
            "failed to write `{}`: the file already exists",
            Text::of_path(path)
        ))
        .hint("replace it with --force")),
        Ok(_) => path.canonicalize().map_err(|error| failure(path, &error)),
    }
}

/// The failure to write a file.
pub fn failure(path: &Path, error: &io::Error) -> Failure {
    Failure::internal(text!(
        "failed to write `{}`: {}",
        Text::of_path(path),
        error
    ))
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
