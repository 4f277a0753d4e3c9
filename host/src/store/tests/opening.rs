//! Files that are no stores, or cannot be used as such: refused, and untouched.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use rusqlite::Connection;
use tempfile::TempDir;

use super::super::sample::{Contest, new_store};
use super::super::{KeptTranscripts, Store, StoreError, StoreErrorKind};
use crate::contest::Seeds;

const SEEDS: Seeds = Seeds { first: 0, count: 9 };

type Open = fn(&Path) -> Result<Store, StoreError>;

/// How a store is opened that has to be there.
const OPEN: [Open; 2] = [
    |path| Store::open_existing(path),
    |path| Store::open_read_only(path),
];

/// A finished store, closed.
fn finished() -> TempDir {
    let contest = Contest::new(3, 3, SEEDS);
    let (folder, mut store) = new_store();
    contest.store(&mut store, KeptTranscripts::All, |_, _, _| true);
    folder
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let names = entries.map(|it| it.expect("an entry").file_name());
    names.map(|it| it.to_string_lossy().into_owned()).collect()
}

/// Checks that `results.db` of a folder is refused with this message however it is opened, and
/// that nothing in the folder changes.
#[track_caller]
fn check_refused(folder: &Path, message: &str) {
    let path = folder.join("results.db");
    let is_file = fs::metadata(&path).is_ok_and(|it| it.is_file());
    let before = is_file.then(|| fs::read(&path).expect("a file"));
    let names_before = names(folder);
    let create: Open = |path| Store::create_or_open(path);
    for open in OPEN.into_iter().chain([create]) {
        let error = open(&path).expect_err(message);
        let shown = error.to_string();
        let expected = format!("store `{}`: {message}", path.display());
        assert!(shown.starts_with(&expected), "{shown}");
        assert!(error.hint().is_some(), "{shown}");
    }
    let after = is_file.then(|| fs::read(&path).expect("a file"));
    assert!(before == after, "{message}: the file changed");
    assert_eq!(names(folder), names_before, "{message}");
}

fn folder_with(bytes: &[u8]) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("results.db"), bytes).expect("a file");
    folder
}

#[test]
fn files_that_are_no_stores_are_refused_untouched() {
    check_refused(folder_with(b"").path(), "the file is empty");
    check_refused(folder_with(b"robot,score\n").path(), "it is not a database");
    check_refused(folder_with(&[7; 9000]).path(), "it is not a database");

    let folder = TempDir::new().expect("a folder");
    fs::create_dir(folder.path().join("results.db")).expect("a folder");
    check_refused(folder.path(), "it is a folder, not a file");

    for mode in ["DELETE", "WAL"] {
        let folder = TempDir::new().expect("a folder");
        let other = Connection::open(folder.path().join("results.db")).expect("a database");
        other
            .query_row(&format!("PRAGMA journal_mode = {mode}"), [], |_| Ok(()))
            .expect("a mode");
        let sql = "PRAGMA application_id = 7; CREATE TABLE t(x); INSERT INTO t VALUES(1)";
        other.execute_batch(sql).expect("valid SQL");
        drop(other);
        check_refused(
            folder.path(),
            "it is a database of another program (application id 0x00000007)",
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn pipes_and_devices_are_refused_without_waiting() {
    use rustix::fs::{CWD, FileType, Mode, mknodat};
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("results.db");
    mknodat(CWD, &path, FileType::Fifo, Mode::RUSR | Mode::WUSR, 0).expect("a pipe");
    check_refused(folder.path(), "it is a pipe, not a file");

    fs::remove_file(&path).expect("a pipe");
    std::os::unix::fs::symlink("/dev/null", &path).expect("a link");
    check_refused(folder.path(), "it is a device, not a file");

    fs::remove_file(&path).expect("a link");
    std::os::unix::fs::symlink("nothing", &path).expect("a link");
    check_refused(folder.path(), "no such file");
}

#[test]
fn an_absent_file_is_created_only_on_request() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("results.db");
    for open in OPEN {
        let error = open(&path).expect_err("no file");
        assert!(matches!(error.kind, StoreErrorKind::Absent), "{error}");
    }
    assert!(names(folder.path()).is_empty());
    drop(Store::create_or_open(&path).expect("a new store"));
    let left: Vec<_> = names(folder.path()).into_iter().collect();
    assert_eq!(left, ["results.db", "results.db-lock"]);
    Store::open_read_only(&path).expect("a store");
    let error = Store::create_or_open(folder.path().join("no/results.db")).expect_err("no folder");
    assert!(matches!(error.kind, StoreErrorKind::Io(_)), "{error}");
}

/// Changes bytes of a finished store.
fn changed(change: impl FnOnce(&mut Vec<u8>)) -> TempDir {
    let folder = finished();
    let path = folder.path().join("results.db");
    let mut bytes = fs::read(&path).expect("a file");
    change(&mut bytes);
    fs::write(&path, bytes).expect("a file");
    folder
}

#[test]
fn truncated_and_newer_stores_are_refused_untouched() {
    let half = changed(|bytes| bytes.truncate(bytes.len() / 2));
    check_refused(half.path(), "the file is truncated: it has ");
    let page = changed(|bytes| bytes.truncate(4096));
    check_refused(page.path(), "the file is truncated: it has 4096 bytes of ");
    let header = changed(|bytes| bytes.truncate(100));
    check_refused(header.path(), "it is not a database");
    let magic = changed(|bytes| bytes[3] = b'!');
    check_refused(magic.path(), "it is not a database");
    let newer = changed(|bytes| bytes[63] = 9);
    check_refused(
        newer.path(),
        "it was written by a newer version of wasmouse (schema 9; this version knows up to 1)",
    );
}

/// Checks that a store that SQLite can open is refused for what is in it.
#[track_caller]
fn check_damaged(folder: &Path, message: &str) {
    let path = folder.join("results.db");
    for open in OPEN {
        let error = open(&path).expect_err(message);
        assert!(error.to_string().contains(message), "{error}");
    }
}

#[test]
fn other_schemas_are_refused() {
    let is_damaged = "it is damaged: ";
    for (sql, message) in [
        ("DROP TABLE unplayed", "its tables are not those of a store"),
        (
            "DROP TABLE transcript; CREATE VIEW transcript AS SELECT * FROM match",
            "its tables are not those of a store",
        ),
        (
            "CREATE TRIGGER t AFTER INSERT ON robot BEGIN DELETE FROM seal; END",
            "its tables are not those of a store",
        ),
        ("PRAGMA user_version = 0", "its schema has version 0"),
    ] {
        let folder = finished();
        super::tamper::tamper(&folder.path().join("results.db"), sql);
        check_damaged(folder.path(), &format!("{is_damaged}{message}"));
    }
    let page_bytes = changed(|bytes| bytes[16..18].copy_from_slice(&[3, 3]));
    check_damaged(page_bytes.path(), "it is ");
}

#[test]
fn a_read_only_file_is_read_and_not_written() {
    let folder = finished();
    let path = folder.path().join("results.db");
    let mut permissions = fs::metadata(&path).expect("a file").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).expect("my file");
    let error = Store::open_existing(&path).expect_err("it is read-only");
    assert!(matches!(error.kind, StoreErrorKind::ReadOnly), "{error}");
    let mut store = Store::open_read_only(&path).expect("it can be read");
    let integrity = store.integrity().expect("in order");
    assert_eq!((integrity.matches, integrity.transcripts), (81, 81));
    let error = store.seal().expect_err("it is open for reading");
    assert!(matches!(error.kind, StoreErrorKind::ReadOnly), "{error}");
}

#[test]
fn there_is_one_writer_and_any_number_of_readers() {
    let folder = finished();
    let path = folder.path().join("results.db");
    let mut writer = Store::open_existing(&path).expect("the first writer");
    let error = Store::create_or_open(&path).expect_err("the second writer");
    let expected = format!(
        "store `{}`: another wasmouse is writing to it",
        path.display()
    );
    assert_eq!(error.to_string(), expected);
    let reader = Store::open_read_only(&path).expect("a reader");
    writer.seal().expect("readers do not matter");
    assert!(reader.sealed().expect("read").is_some());
    drop(writer);
    Store::open_existing(&path).expect("the lock is free");
}

#[test]
fn a_lock_of_another_program_is_named() {
    let folder = finished();
    let path = folder.path().join("results.db");
    let mut store = Store::open_existing(&path).expect("a store");
    let other = Connection::open(&path).expect("a database");
    other.execute_batch("BEGIN IMMEDIATE").expect("it is free");
    let error = store.seal().expect_err("it is locked");
    assert!(matches!(error.kind, StoreErrorKind::Locked), "{error}");
    other.execute_batch("ROLLBACK").expect("a transaction");
    store.seal().expect("it is free");
}
