//! The file of a store before SQLite opens it: whether it is one, and who else uses it.
//!
//! SQLite would write beside a database of another program, or wait for the writer of a pipe. So
//! this looks at the file first, and what is refused stays untouched.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::{self, File, Metadata, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::error::StoreErrorKind;
use super::schema::{APPLICATION_ID, SCHEMA_VERSION};

/// The bytes of the header of a SQLite database.
const HEADER_BYTES: usize = 100;

/// The size of the smallest page, and so of the smallest database.
const PAGE_BYTES_MIN: u64 = 512;

const MAGIC: &[u8; 16] = b"SQLite format 3\0";

/// The stores that this process has open, by path, with their number.
///
/// Closing any descriptor of a file makes a process lose its locks of it, those of SQLite too, so
/// a file must not be read here while this process has it open.
static OPEN: Mutex<BTreeMap<PathBuf, usize>> = Mutex::new(BTreeMap::new());

fn open_stores() -> MutexGuard<'static, BTreeMap<PathBuf, usize>> {
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file that looks like a store of a supported version. While it lives, this process has it
/// open.
#[derive(Debug)]
pub(super) struct StoreFile {
    /// The path without links.
    pub path: PathBuf,
    /// Whether the file may only be read.
    pub is_read_only: bool,
}

impl StoreFile {
    /// Checks the file.
    pub fn check(path: &Path) -> Result<Self, StoreErrorKind> {
        let metadata = fs::metadata(path).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => StoreErrorKind::Absent,
            _ => StoreErrorKind::Io(error),
        })?;
        if !metadata.is_file() {
            return Err(StoreErrorKind::NotAFile(what_it_is(&metadata)));
        }
        let path = fs::canonicalize(path)?;
        let mut open = open_stores();
        if !open.contains_key(&path) {
            check_header(&path, metadata.len())?;
        }
        *open.entry(path.clone()).or_default() += 1;
        Ok(Self {
            path,
            is_read_only: metadata.permissions().readonly(),
        })
    }

    /// Makes this process the only writer; `None` where another one is.
    pub fn lock(&self) -> Result<Option<File>, StoreErrorKind> {
        let path = beside(&self.path, "-lock");
        let file = File::options()
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(|error| match error.kind() {
                io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                    StoreErrorKind::ReadOnly
                }
                _ => StoreErrorKind::Io(error),
            })?;
        match file.try_lock() {
            Ok(()) => Ok(Some(file)),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(error.into()),
        }
    }
}

impl Drop for StoreFile {
    fn drop(&mut self) {
        let mut open = open_stores();
        if let Some(count) = open.get_mut(&self.path) {
            *count -= 1;
            if *count == 0 {
                open.remove(&self.path);
            }
        }
    }
}

/// The path with something after its name, as SQLite names its own files.
pub(super) fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(suffix);
    name.into()
}

/// Whether SQLite has changes for the file that are not in it yet.
pub(super) fn has_log(path: &Path) -> bool {
    fs::metadata(beside(path, "-wal")).is_ok_and(|log| log.len() > 0)
}

fn what_it_is(metadata: &Metadata) -> &'static str {
    if metadata.is_dir() {
        return "a folder";
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt as _;
        let kind = metadata.file_type();
        if kind.is_fifo() {
            return "a pipe";
        }
        if kind.is_socket() {
            return "a socket";
        }
    }
    "a device"
}

fn check_header(path: &Path, size: u64) -> Result<(), StoreErrorKind> {
    if size == 0 {
        return Err(StoreErrorKind::Empty);
    }
    let mut header = [0; HEADER_BYTES];
    let is_read = File::open(path)?.read_exact(&mut header);
    if is_read.is_err() || size < PAGE_BYTES_MIN || header[..16] != *MAGIC {
        return Err(StoreErrorKind::NotADatabase);
    }
    let number = |at: usize| {
        let bytes = header[at..].first_chunk();
        u32::from_be_bytes(*bytes.expect("the header has 100 bytes"))
    };
    let (changes, pages, version, application, valid_for) =
        (number(24), number(28), number(60), number(68), number(92));
    if application != APPLICATION_ID {
        return Err(StoreErrorKind::OtherProgram(application));
    }
    if version > SCHEMA_VERSION {
        return Err(StoreErrorKind::Newer {
            found: version,
            supported: SCHEMA_VERSION,
        });
    }
    // 1 stands for 65,536.
    let page_bytes = match u16::from_be_bytes([header[16], header[17]]) {
        1 => 65_536,
        other => u64::from(other),
    };
    let expected = u64::from(pages) * page_bytes;
    // While there is a log, pages may be in it alone.
    if changes == valid_for && size < expected && !has_log(path) {
        return Err(StoreErrorKind::Truncated {
            found: size,
            expected,
        });
    }
    Ok(())
}
