//! Where commands put their results: standard output and files; and what they
//! say about them: standard error.

use std::fmt;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::failure::Failure;

/// Writes `text` to standard output.
///
/// A reader that has heard enough, such as `head`, is no failure.
///
/// # Errors
///
/// When standard output cannot be written for another reason, such as a full disk.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush());
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::host(format!(
            "failed to write standard output: {error}"
        ))),
        _ => Ok(()),
    }
}

/// Writes a line to standard error.
///
/// Whether anybody hears it decides nothing: results and exit codes are the same
/// when standard error is closed, or on a full disk.
pub fn tell(line: fmt::Arguments<'_>) {
    let _ = writeln!(anstream::stderr(), "{line}");
}

/// What to do with a file that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// Leave it and fail.
    Keep,
    /// Put the new one in its place: `--force`.
    Replace,
}

/// Writes a file so that its name never stands for half of it: the bytes go to
/// a temporary file beside it, which is renamed when it is complete.
///
/// # Errors
///
/// When the file is there already and is to be kept, when a folder or a device
/// has its name, or when it cannot be written.
pub fn save(path: &Path, bytes: &[u8], existing: Existing) -> Result<(), Failure> {
    let target = check(path, existing)?;
    let failed = |error: io::Error| failure(path, &error);
    let folder = folder(&target);
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // As for any new file; without it, temporary files are private.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder).map_err(failed)?;
    file.write_all(bytes).map_err(failed)?;
    match existing {
        Existing::Keep => file.persist_noclobber(&target).map(drop),
        Existing::Replace => file.persist(&target).map(drop),
    }
    .map_err(|error| failed(error.error))
}

fn folder(target: &Path) -> &Path {
    match target.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// The file that [`save`] would write: behind symbolic links, so that they stay,
/// and never a folder or a device, which a rename would destroy.
///
/// Called before long work, so that it is not lost over a name.
///
/// # Errors
///
/// As [`save`], as far as it can be known beforehand.
pub fn check(path: &Path, existing: Existing) -> Result<PathBuf, Failure> {
    match fs::metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let folder = folder(path);
            if folder.is_dir() {
                Ok(path.to_owned())
            } else {
                Err(Failure::input(format!(
                    "failed to write `{}`: there is no folder `{}`",
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
            "failed to write `{}`: the file is there already",
            path.display()
        ))
        .hint("replace it with --force")),
        Ok(_) => path.canonicalize().map_err(|error| failure(path, &error)),
    }
}

fn failure(path: &Path, error: &io::Error) -> Failure {
    Failure::host(format!("failed to write `{}`: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_kept_unless_forced() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.txt");
        save(&path, b"one", Existing::Keep).expect("a new file");
        let failure = save(&path, b"two", Existing::Keep).expect_err("it is there");
        assert!(failure.to_string().contains("--force"), "{failure}");
        assert_eq!(fs::read(&path).expect("a file"), b"one");
        save(&path, b"two", Existing::Replace).expect("forced");
        assert_eq!(fs::read(&path).expect("a file"), b"two");
        let files = fs::read_dir(folder.path()).expect("a folder").count();
        assert_eq!(files, 1, "temporary files are gone");
    }

    #[test]
    fn folders_and_lost_folders_are_refused() {
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
