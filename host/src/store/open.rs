//! [`Store`]: opening and creating.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::config::DbConfig;
use rusqlite::{Connection, OpenFlags, Transaction, TransactionBehavior};

use super::error::{StoreError, StoreErrorKind};
use super::file::{StoreFile, has_log};
use super::schema::{self, APPLICATION_ID, SCHEMA_VERSION};

/// How long to wait for a lock of another program. Those of this one are held for milliseconds.
const BUSY_TIMEOUT: Duration = Duration::from_secs(3);

/// Memory for pages of a writer, in KiB: the last pages of thousands of robots fit.
const WRITER_CACHE_KIB: i64 = 16 * 1024;

/// The same for a reader, which goes through tables from their beginning to their end.
const READER_CACHE_KIB: i64 = 2 * 1024;

/// Pages in the log before SQLite copies them into the file: 16 MiB.
const LOG_PAGES: i64 = 4096;

/// Results of contests in a file: a SQLite database with `application_id` [`APPLICATION_ID`].
///
/// Everything is written in transactions that are on the disk when a call returns: whatever
/// happens to the process or the machine, a store has all of a transaction or nothing of it.
/// Beside the file there may be three others, whose names end in `-wal` and `-shm` (SQLite's) and
/// in `-lock` (of writers). The first belongs to the store as long as it is there.
#[derive(Debug)]
pub struct Store {
    // Dropped in this order: no lock may be gone before the connection is.
    connection: Connection,
    path: PathBuf,
    file: StoreFile,
    lock: Option<File>,
}

impl Store {
    /// Opens a store for writing, and creates it if there is no file.
    ///
    /// # Errors
    ///
    /// As [`Store::open_existing`], and when the file cannot be created.
    pub fn create_or_open(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        let path = path.as_ref();
        // A link to nothing is not absent, and is refused as what it is.
        if fs::symlink_metadata(path).is_err_and(|it| it.kind() == io::ErrorKind::NotFound) {
            create(path).map_err(|kind| kind.at(path))?;
        }
        Self::open_existing(path)
    }

    /// Opens a store for writing. Migrates an older schema to the latest.
    ///
    /// # Errors
    ///
    /// When the file is no store, is damaged, cannot be written, is newer than this program, or
    /// has another writer. Such a file stays as it is.
    pub fn open_existing(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        let path = path.as_ref();
        open_for_writing(path).map_err(|kind| kind.at(path))
    }

    /// Opens a store for reading; others may write to it meanwhile.
    ///
    /// # Errors
    ///
    /// When the file is no store, is damaged, cannot be read, or has another version of the
    /// schema. Such a file stays as it is.
    pub fn open_read_only(path: impl AsRef<Path>) -> Result<Self, StoreError> {
        let path = path.as_ref();
        open_for_reading(path).map_err(|kind| kind.at(path))
    }

    /// The file, as it was opened.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether both are the same file.
    pub(super) fn is_same_file(&self, other: &Self) -> bool {
        self.file.path == other.file.path
    }

    /// Whether it was opened for writing.
    pub const fn is_writable(&self) -> bool {
        self.lock.is_some()
    }

    /// Whether SQLite looks up the rows that a row refers to whenever it adds one. It does unless
    /// told otherwise; what is added without is checked by whoever adds it.
    pub(super) fn check_references(&self, checks: bool) -> Result<(), StoreError> {
        let changed = self.connection.pragma_update(None, "foreign_keys", checks);
        changed.map_err(|error| self.error(error))
    }

    /// A transaction to read in.
    pub(super) fn reading(&self) -> Result<Transaction<'_>, StoreError> {
        let transaction = self.connection.unchecked_transaction();
        transaction.map_err(|error| self.error(error))
    }

    /// A transaction to write in.
    pub(super) fn writing(&mut self) -> Result<Transaction<'_>, StoreError> {
        if self.lock.is_none() {
            return Err(self.error(StoreErrorKind::ReadOnly));
        }
        let behavior = TransactionBehavior::Immediate;
        let transaction = self.connection.transaction_with_behavior(behavior);
        transaction.map_err(|error| StoreErrorKind::from(error).at(&self.path))
    }

    /// An error with the place.
    pub(super) fn error(&self, kind: impl Into<StoreErrorKind>) -> StoreError {
        kind.into().at(&self.path)
    }

    /// Reads in one transaction, so that everything is of the same moment.
    pub(super) fn read<T>(
        &self,
        read: impl FnOnce(&Connection) -> Result<T, StoreErrorKind>,
    ) -> Result<T, StoreError> {
        let transaction = self.reading()?;
        read(&transaction).map_err(|kind| self.error(kind))
    }

    /// Writes in one transaction, which is on the disk when this returns.
    pub(super) fn write<T>(
        &mut self,
        write: impl FnOnce(&Transaction<'_>) -> Result<T, StoreErrorKind>,
    ) -> Result<T, StoreError> {
        let path = self.path.clone();
        let transaction = self.writing()?;
        let value = write(&transaction).map_err(|kind| kind.at(&path))?;
        let committed = transaction.commit();
        committed.map_err(|error| StoreErrorKind::from(error).at(path))?;
        Ok(value)
    }
}

/// Creates an empty store: complete, or not at all.
fn create(path: &Path) -> Result<(), StoreErrorKind> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let read_only = |error: io::Error| match error.kind() {
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            StoreErrorKind::ReadOnly
        }
        io::ErrorKind::StorageFull => StoreErrorKind::Full,
        _ => StoreErrorKind::Io(error),
    };
    let file = tempfile::Builder::new()
        .prefix(".wasmouse-")
        .permissions_of_new_files()
        .tempfile_in(folder)
        .map_err(read_only)?;
    let mut connection = open(file.path(), OpenFlags::SQLITE_OPEN_READ_WRITE)?;
    // Nobody knows this file yet, so it needs no journal.
    connection.pragma_update(None, "journal_mode", "MEMORY")?;
    schema::migrate(&mut connection)?;
    connection.pragma_update(None, "journal_mode", "WAL")?;
    connection.close().map_err(|(_, error)| error)?;
    file.as_file().sync_all()?;
    match file.persist_noclobber(path) {
        Ok(_) => {}
        // Another process was faster, and its store is as good.
        Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => {}
        Err(error) => return Err(read_only(error.error)),
    }
    // The name is on the disk, too. Folders cannot be opened everywhere, and need it only here.
    if cfg!(unix) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}

/// The permissions of files that a program creates, instead of those of temporary files, which
/// only their owner can read.
trait UsualPermissions {
    fn permissions_of_new_files(&mut self) -> &mut Self;
}

impl UsualPermissions for tempfile::Builder<'_, '_> {
    #[cfg(unix)]
    fn permissions_of_new_files(&mut self) -> &mut Self {
        use std::os::unix::fs::PermissionsExt as _;
        // Less what the umask of the user takes away.
        self.permissions(fs::Permissions::from_mode(0o666))
    }

    #[cfg(not(unix))]
    fn permissions_of_new_files(&mut self) -> &mut Self {
        self
    }
}

fn open_for_writing(path: &Path) -> Result<Store, StoreErrorKind> {
    let file = StoreFile::check(path)?;
    if file.is_read_only {
        return Err(StoreErrorKind::ReadOnly);
    }
    let lock = file.lock()?.ok_or(StoreErrorKind::InUse)?;
    let mut connection = connect(&file, OpenFlags::SQLITE_OPEN_READ_WRITE)?;
    let mode: String = connection.query_row("PRAGMA journal_mode = WAL", [], |row| row.get(0))?;
    if !mode.eq_ignore_ascii_case("wal") {
        let problem = format!("the journal mode is `{mode}`, not `wal`");
        return Err(StoreErrorKind::Damaged(problem));
    }
    connection.pragma_update(None, "synchronous", "FULL")?;
    connection.pragma_update(None, "wal_autocheckpoint", LOG_PAGES)?;
    connection.pragma_update(None, "cache_size", -WRITER_CACHE_KIB)?;
    version(&connection)?;
    schema::migrate(&mut connection)?;
    schema::check(&connection)?;
    Ok(Store {
        connection,
        path: path.to_owned(),
        file,
        lock: Some(lock),
    })
}

fn open_for_reading(path: &Path) -> Result<Store, StoreErrorKind> {
    let file = StoreFile::check(path)?;
    let mut flags = OpenFlags::SQLITE_OPEN_READ_ONLY;
    if !file.is_read_only {
        // SQLite removes its files beside the store only if it may write. It writes nothing
        // else, because of `query_only`.
        flags = OpenFlags::SQLITE_OPEN_READ_WRITE;
    }
    let connection = connect(&file, flags).or_else(|error| match error {
        // SQLite cannot make its files in a folder that it may not write to, and needs none
        // where nobody else can write.
        StoreErrorKind::ReadOnly | StoreErrorKind::Sqlite(_) if !has_log(&file.path) => {
            connect_immutable(&file)
        }
        error => Err(error),
    })?;
    connection.pragma_update(None, "query_only", true)?;
    connection.pragma_update(None, "cache_size", -READER_CACHE_KIB)?;
    let found = version(&connection)?;
    if found < SCHEMA_VERSION {
        let supported = SCHEMA_VERSION;
        return Err(StoreErrorKind::Older { found, supported });
    }
    schema::check(&connection)?;
    Ok(Store {
        connection,
        path: path.to_owned(),
        file,
        lock: None,
    })
}

fn connect(file: &StoreFile, access: OpenFlags) -> Result<Connection, StoreErrorKind> {
    let connection = open(&file.path, access)?;
    configure(&connection)?;
    Ok(connection)
}

/// A connection that takes it for granted that nobody writes.
fn connect_immutable(file: &StoreFile) -> Result<Connection, StoreErrorKind> {
    use std::fmt::Write as _;
    let mut uri = "file:".to_owned();
    if cfg!(windows) {
        uri.push_str("///");
    }
    for &byte in file.path.as_os_str().as_encoded_bytes() {
        match byte {
            b'\\' if cfg!(windows) => uri.push('/'),
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' | b':' => {
                uri.push(char::from(byte));
            }
            _ => write!(uri, "%{byte:02X}").expect("writing to a string cannot fail"),
        }
    }
    uri.push_str("?immutable=1");
    let access = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI;
    let connection = open(uri, access)?;
    configure(&connection)?;
    Ok(connection)
}

fn open(path: impl AsRef<Path>, access: OpenFlags) -> Result<Connection, StoreErrorKind> {
    // A connection cannot be shared between threads, so SQLite need not lock it for each value.
    let flags = access | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    Ok(Connection::open_with_flags(path, flags)?)
}

fn configure(connection: &Connection) -> Result<(), StoreErrorKind> {
    connection.busy_timeout(BUSY_TIMEOUT)?;
    // What a store says about itself cannot run functions or write to its own pages.
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
    connection.pragma_update(None, "cell_size_check", true)?;
    connection.pragma_update(None, "foreign_keys", true)?;
    let id: u32 = connection.query_row("PRAGMA application_id", [], |row| row.get(0))?;
    if id != APPLICATION_ID {
        return Err(StoreErrorKind::OtherProgram(id));
    }
    Ok(())
}

/// The version of the schema, if it is supported.
fn version(connection: &Connection) -> Result<u32, StoreErrorKind> {
    let found: i64 = connection.query_row("PRAGMA user_version", [], |row| row.get(0))?;
    let supported = SCHEMA_VERSION;
    match u32::try_from(found) {
        Ok(found) if found > supported => Err(StoreErrorKind::Newer { found, supported }),
        Ok(found) if found > 0 => Ok(found),
        _ => Err(StoreErrorKind::Damaged(format!(
            "its schema has version {found}"
        ))),
    }
}
