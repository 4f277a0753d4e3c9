//! Reading files that others may have put there: regular ones, of a limited size, without
//! waiting.
//!
//! A contest runs on folders of submissions. A pipe among them would never end, and a link could
//! lead to a file that only the organiser may read.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::output::message;
use crate::report::text::{Text, text};

/// Reads a regular file of at most that many bytes, or all of what a descriptor that was handed
/// to this process gives, such as `/dev/stdin`.
///
/// # Errors
///
/// When it cannot be read, is no regular file or has more bytes.
pub fn read_file(path: &Path, bytes_max: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = open(path)?;
    if file.metadata()?.len() > bytes_max {
        return Err(too_large(bytes_max));
    }
    // It may grow meanwhile, and not everything has a length.
    file.take(bytes_max.saturating_add(1))
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > bytes_max {
        return Err(too_large(bytes_max));
    }
    Ok(bytes)
}

/// Reads standard input to its end, at most that many bytes.
///
/// # Errors
///
/// When it cannot be read or has more bytes.
pub fn read_stdin(bytes_max: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let stdin = io::stdin().lock();
    stdin
        .take(bytes_max.saturating_add(1))
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > bytes_max {
        return Err(too_large(bytes_max));
    }
    Ok(bytes)
}

fn too_large(bytes_max: u64) -> io::Error {
    io::Error::other(format!("the file has more than {bytes_max} bytes"))
}

/// Opens a file to read it: a regular one, without waiting for anything.
///
/// # Errors
///
/// When it cannot be opened or is something else.
pub fn open(path: &Path) -> io::Result<File> {
    if is_descriptor(path) {
        return File::open(path);
    }
    let file = open_at_once(path)?;
    let metadata = file.metadata()?;
    if metadata.is_file() {
        Ok(file)
    } else if metadata.is_dir() {
        Err(io::ErrorKind::IsADirectory.into())
    } else {
        Err(io::Error::other("not a regular file"))
    }
}

/// Whether a path names what this process has open already, as a shell passes it for `<(...)`.
fn is_descriptor(path: &Path) -> bool {
    let folders = ["/dev/fd", "/proc/self/fd"];
    path == Path::new("/dev/stdin")
        || path
            .parent()
            .is_some_and(|folder| folders.iter().any(|it| folder == Path::new(it)))
}

#[cfg(unix)]
fn open_at_once(path: &Path) -> io::Result<File> {
    use rustix::fs::OFlags;
    use std::os::unix::fs::OpenOptionsExt as _;

    // Opening a pipe waits for a writer otherwise, and opening a terminal may become its owner.
    let flags = (OFlags::NONBLOCK | OFlags::NOCTTY).bits();
    let flags = i32::try_from(flags).map_err(io::Error::other)?;
    File::options().read(true).custom_flags(flags).open(path)
}

#[cfg(not(unix))]
fn open_at_once(path: &Path) -> io::Result<File> {
    File::open(path)
}

/// The files of a folder that are wanted, by name, without subfolders. What else is named like
/// one is skipped with a warning: links that lead out of the folder, pipes, devices.
///
/// # Errors
///
/// When the folder cannot be listed.
pub fn list(folder: &Path, is_wanted: impl Fn(&Path) -> bool) -> io::Result<Vec<PathBuf>> {
    let (files, others) = sorted(folder, is_wanted)?;
    for (path, problem) in others {
        message!("warning: skipped `{}`: {}", Text::of_path(&path), problem);
    }
    Ok(files)
}

/// Whether a folder has a file that is wanted.
pub fn has_any(folder: &Path, is_wanted: impl Fn(&Path) -> bool) -> bool {
    sorted(folder, is_wanted).is_ok_and(|(files, _)| !files.is_empty())
}

type Skipped = (PathBuf, &'static str);

fn sorted(
    folder: &Path,
    is_wanted: impl Fn(&Path) -> bool,
) -> io::Result<(Vec<PathBuf>, Vec<Skipped>)> {
    let inside = folder.canonicalize()?;
    let (mut files, mut others) = (Vec::new(), Vec::new());
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        if !is_wanted(&path) {
            continue;
        }
        let is_link = entry.file_type()?.is_symlink();
        // A link that leads nowhere cannot be followed.
        let target = is_link.then(|| path.canonicalize().unwrap_or_default());
        if target.is_some_and(|it| !it.starts_with(&inside)) {
            others.push((path, "it is a link that leads out of the folder"));
        } else if path.is_file() {
            files.push(path);
        } else if !path.is_dir() {
            others.push((path, "it is not a regular file"));
        }
    }
    files.sort();
    others.sort();
    Ok((files, others))
}

/// The failure to read a file of some kind, such as `robot`.
pub fn failure(what: &'static str, path: &Path, error: &io::Error) -> Failure {
    Failure::input(text!(
        "failed to read {} `{}`: {}",
        what,
        Text::of_path(path),
        error
    ))
}
