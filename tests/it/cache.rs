//! The cache of compiled robots never changes a result: not when it is damaged, unusable, full
//! or writable by others. In this process as in workers.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use wasmouse_core::Digest;
use wasmouse_core::game::SandboxLimits;
use wasmouse_core::record::MatchRecord;
use wasmouse_engine::bundled::find;
use wasmouse_engine::{
    Cache, CacheUse, Executor, InProcess, InfrastructureError, Limits, WASMTIME_VERSION,
};

use crate::matches::{WORKER, bundled_mazes, rules, sandboxed, spec};

/// Makes an executor with that cache.
type New = fn(Option<Cache>) -> Box<dyn Executor>;

const EXECUTORS: [(&str, New); 2] = [
    ("in process", |cache| {
        let executor = InProcess::new(Limits::default(), 1, cache);
        Box::new(executor.expect("address space for one match"))
    }),
    ("sandboxed", |cache| {
        Box::new(sandboxed(WORKER, cache).expect("a worker starts"))
    }),
];

/// Where a new executor got the code of a robot from, and the record of a match.
fn play(new: New, cache: Option<&Path>) -> (CacheUse, MatchRecord) {
    let executor = new(cache.map(|folder| Cache::open(folder).expect("a cache")));
    let component = find("dfs").expect("a bundled robot").component;
    let robot = executor.admit(component).expect("the host works");
    let robot = robot.expect("a bundled robot");
    let (_, maze) = &bundled_mazes()[0];
    let rules = rules(SandboxLimits::default());
    let spec = spec(&rules, robot.digest(), maze, (0, 0));
    let played = executor.execute_with_details(&robot, &spec);
    let record = played.expect("the host works").record;
    (robot.cache_use().clone(), record)
}

/// The files of the cache with their content.
fn entries(cache: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(cache).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths
        .map(|path| (path.clone(), fs::read(path).expect("a file")))
        .collect()
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Bytes of an entry before its code: the digest of the code.
const DIGEST_BYTES: usize = 32;

/// Changes the version of wasmtime in the code: its first number, behind the version of the
/// format and a length.
fn change_version(entry: &mut [u8]) {
    let (major, _) = WASMTIME_VERSION.split_once('.').expect("three numbers");
    let length = u8::try_from(major.len()).expect("a short number");
    let marker = [&[0, length], major.as_bytes()].concat();
    let found = entry.windows(marker.len()).position(|it| it == marker);
    entry[found.expect("the code has a version") + 2] ^= 1;
}

/// Makes the digest that of the damaged code: then only wasmtime can tell.
fn fix_digest(entry: &mut [u8]) {
    let (digest, code) = entry.split_at_mut(DIGEST_BYTES);
    digest.copy_from_slice(Digest::of(code).as_bytes());
}

type Damage = fn(&mut Vec<u8>);

const DAMAGES: [(&str, Damage); 10] = [
    ("first byte", |it| it[0] ^= 1),
    ("first byte of the code", |it| it[DIGEST_BYTES] ^= 0x80),
    ("last byte", |it| *it.last_mut().expect("bytes") ^= 1),
    ("one byte less", |it| it.truncate(it.len() - 1)),
    ("one byte more", |it| it.push(0)),
    ("half of it", |it| it.truncate(it.len() / 2)),
    ("half a digest", |it| it.truncate(DIGEST_BYTES / 2)),
    ("nothing", Vec::clear),
    ("another version of wasmtime", |it| {
        change_version(it);
        fix_digest(it);
    }),
    ("no code at all", |it| {
        it[DIGEST_BYTES..].fill(0x5a);
        fix_digest(it);
    }),
];

#[test]
fn damaged_entries_are_replaced() {
    for (name, new) in EXECUTORS {
        let folder = folder();
        let cache = folder.path().join("cache");
        let (_, expected) = play(new, None);
        assert_eq!(
            play(new, Some(&cache)),
            (CacheUse::Stored, expected.clone()),
            "{name}"
        );
        assert_eq!(
            play(new, Some(&cache)),
            (CacheUse::Hit, expected.clone()),
            "{name}"
        );
        let good = entries(&cache);
        let [(path, content)] = &Vec::from_iter(&good)[..] else {
            panic!("{} entries", good.len());
        };
        let check = |damaged: &[u8], what: &str| {
            fs::write(path, damaged).expect("the entry");
            let found = play(new, Some(&cache));
            assert_eq!(
                found,
                (CacheUse::Stored, expected.clone()),
                "{name}: {what}"
            );
            assert!(entries(&cache) == good, "{name}: {what}: not replaced");
        };
        for (what, damage) in DAMAGES {
            let mut damaged = Vec::clone(content);
            damage(&mut damaged);
            check(&damaged, what);
        }
        // Bits at places that look random and are the same everywhere.
        for round in 1..=10_usize {
            let bit = round * 7_919_999 % (content.len() * 8);
            let mut damaged = Vec::clone(content);
            damaged[bit / 8] ^= 1 << (bit % 8);
            check(&damaged, &format!("bit {bit}"));
        }
    }
}

/// Plays with a cache that cannot store the robot, and returns the reason.
#[track_caller]
fn failure(new: New, cache: &Path) -> String {
    let (cache_use, record) = play(new, Some(cache));
    assert_eq!(record, play(new, None).1);
    match cache_use {
        CacheUse::Failed(reason) => reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_entry_that_is_a_folder_is_reported() {
    for (_, new) in EXECUTORS {
        let folder = folder();
        let cache = folder.path().join("cache");
        play(new, Some(&cache));
        for path in entries(&cache).into_keys() {
            fs::remove_file(&path).expect("a file");
            fs::create_dir(&path).expect("a folder");
        }
        let reason = failure(new, &cache);
        assert!(
            reason.starts_with("failed to use the cache of compiled robots at"),
            "{reason}"
        );
    }
}

#[test]
fn a_cache_that_cannot_be_used_is_reported_and_left_alone() {
    let folder = folder();
    let file = folder.path().join("file");
    fs::write(&file, "mine").expect("a file");
    for path in [file.clone(), file.join("below")] {
        let error = Cache::open(&path).expect_err("not a folder").to_string();
        let expected = format!(
            "failed to use the cache of compiled robots at `{}`: ",
            path.display()
        );
        assert!(error.starts_with(&expected), "{error}");
    }
    assert_eq!(fs::read(&file).expect("a file"), b"mine");
}

#[cfg(unix)]
#[test]
fn a_cache_that_others_may_write_to_is_not_used() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder();
    let cache = folder.path().join("cache");
    Cache::open(&cache).expect("a new folder");
    let metadata = fs::metadata(&cache).expect("the cache");
    let mode = metadata.permissions().mode() & 0o777;
    assert_eq!(mode, 0o700, "the folder is made private");
    for open in [0o777, 0o720, 0o702] {
        fs::set_permissions(&cache, fs::Permissions::from_mode(open)).expect("my folder");
        let error = Cache::open(&cache).expect_err("others may write to it");
        assert!(
            matches!(error, InfrastructureError::Cache { .. }),
            "{error}"
        );
        assert!(
            error.to_string().contains("others may write to it"),
            "{error}"
        );
    }
}

/// The robot is compiled each time, and nothing half written stays.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported_and_changes_nothing() {
    for (name, new) in EXECUTORS {
        let folder = folder();
        let Some(disk) = crate::faults::SmallDisk::new(&folder.path().join("small"), 16) else {
            return;
        };
        let reason = failure(new, disk.path());
        assert!(reason.contains("No space left"), "{name}: {reason}");
        assert_eq!(disk.files(), 0, "{name}: nothing half written stays");
    }
}
