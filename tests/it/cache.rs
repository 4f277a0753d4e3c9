//! The cache of compiled robots never changes a result: not when it is damaged, exchanged,
//! unusable, full or somebody else's. In this process as in workers.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use wasmouse_core::Digest;
use wasmouse_core::game::SandboxLimits;
use wasmouse_core::record::MatchRecord;
#[cfg(unix)]
use wasmouse_engine::InfrastructureError;
use wasmouse_engine::bundled::find;
use wasmouse_engine::{Cache, CacheUse, Executor, InProcess, Limits, WASMTIME_VERSION};

#[cfg(target_os = "linux")]
use crate::hostile::wasm;
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
    play_robot("dfs", new, cache)
}

fn play_robot(name: &str, new: New, cache: Option<&Path>) -> (CacheUse, MatchRecord) {
    let executor = new(cache.map(|folder| Cache::open(folder).expect("a cache")));
    let component = find(name).expect("a bundled robot").component;
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

/// Bytes of an entry before its code: what it is about, and the digest of that.
const HEADER_BYTES: usize = SEALED_BYTES + 32;

/// Bytes that the header's own digest covers; the last of them are the digest of the code.
const SEALED_BYTES: usize = 128;

/// Changes the version of wasmtime in the code: its first number, behind the version of the
/// format and a length.
fn change_version(entry: &mut [u8]) {
    let (major, _) = WASMTIME_VERSION.split_once('.').expect("three numbers");
    let length = u8::try_from(major.len()).expect("a short number");
    let marker = [&[0, length], major.as_bytes()].concat();
    let found = entry.windows(marker.len()).position(|it| it == marker);
    entry[found.expect("the code has a version") + 2] ^= 1;
}

/// Makes the digests those of the damaged code: then only wasmtime can tell.
fn fix_digest(entry: &mut [u8]) {
    let (header, code) = entry.split_at_mut(HEADER_BYTES);
    let (sealed, seal) = header.split_at_mut(SEALED_BYTES);
    sealed[SEALED_BYTES - 32..].copy_from_slice(Digest::of(code).as_bytes());
    seal.copy_from_slice(Digest::of(sealed).as_bytes());
}

type Damage = fn(&mut Vec<u8>);

const DAMAGES: [(&str, Damage); 10] = [
    ("first byte", |it| it[0] ^= 1),
    ("first byte of the code", |it| it[HEADER_BYTES] ^= 0x80),
    ("last byte", |it| *it.last_mut().expect("bytes") ^= 1),
    ("one byte less", |it| it.truncate(it.len() - 1)),
    ("one byte more", |it| it.push(0)),
    ("half of it", |it| it.truncate(it.len() / 2)),
    ("half a header", |it| it.truncate(HEADER_BYTES / 2)),
    ("nothing", Vec::clear),
    ("another version of wasmtime", |it| {
        change_version(it);
        fix_digest(it);
    }),
    ("no code at all", |it| {
        it[HEADER_BYTES..].fill(0x5a);
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

/// Who exchanges two entries gets neither robot to play under the name of the other.
#[test]
fn exchanged_entries_are_replaced() {
    for (name, new) in EXECUTORS {
        let folder = folder();
        let cache = folder.path().join("cache");
        let cached = |robot| play_robot(robot, new, Some(&cache));
        let (_, dfs) = cached("dfs");
        let (_, flood) = cached("flood");
        assert_ne!(
            dfs.verdict, flood.verdict,
            "two robots that can be told apart"
        );
        let good = entries(&cache);
        let [first, second] = &Vec::from_iter(&good)[..] else {
            panic!("{} entries", good.len());
        };
        fs::write(first.0, second.1).expect("an entry");
        fs::write(second.0, first.1).expect("an entry");
        assert_eq!(cached("dfs"), (CacheUse::Stored, dfs), "{name}");
        assert_eq!(cached("flood"), (CacheUse::Stored, flood), "{name}");
        assert!(entries(&cache) == good, "{name}: not replaced");
    }
}

/// Nothing is read but a regular file of the size that its header says.
#[cfg(target_os = "linux")]
#[test]
fn an_entry_that_is_no_file_is_replaced() {
    for (name, new) in EXECUTORS {
        let folder = folder();
        let cache = folder.path().join("cache");
        let (_, expected) = play(new, Some(&cache));
        let good = entries(&cache);
        let [(path, content)] = &Vec::from_iter(&good)[..] else {
            panic!("{} entries", good.len());
        };
        let elsewhere = folder.path().join("elsewhere");
        fs::write(&elsewhere, content).expect("a file");
        let replace: [(&str, &dyn Fn()); 5] = [
            ("a FIFO", &|| {
                rustix::fs::mknodat(
                    rustix::fs::CWD,
                    path.as_path(),
                    rustix::fs::FileType::Fifo,
                    rustix::fs::Mode::RWXU,
                    0,
                )
                .expect("a FIFO");
            }),
            ("a link to a good entry", &|| {
                std::os::unix::fs::symlink(&elsewhere, path).expect("a link");
            }),
            ("a sparse file of 100 GB", &|| {
                let file = fs::File::create(path).expect("a file");
                file.set_len(100_000_000_000).expect("a sparse file");
            }),
            ("a good entry, and a hole of 100 GB", &|| {
                fs::copy(&elsewhere, path).expect("a file");
                let file = fs::File::options().write(true).open(path);
                let file = file.expect("a file");
                file.set_len(100_000_000_000).expect("a sparse file");
            }),
            ("one that others may change", &|| {
                use std::os::unix::fs::PermissionsExt as _;
                fs::copy(&elsewhere, path).expect("a file");
                fs::set_permissions(path, fs::Permissions::from_mode(0o666)).expect("my file");
            }),
        ];
        for (what, replace) in replace {
            fs::remove_file(path).expect("the entry");
            replace();
            let found = play(new, Some(&cache));
            assert_eq!(
                found,
                (CacheUse::Stored, expected.clone()),
                "{name}: {what}"
            );
            let kind = fs::symlink_metadata(path).expect("an entry").file_type();
            assert!(kind.is_file(), "{name}: {what}: not replaced");
            assert!(entries(&cache) == good, "{name}: {what}: not replaced");
        }
    }
}

#[test]
fn a_cache_has_a_largest_size() {
    for (name, new) in EXECUTORS {
        let folder = folder();
        let path = folder.path().join("cache");
        play_robot("dfs", new, Some(&path));
        play_robot("flood", new, Some(&path));
        let size: usize = entries(&path).values().map(Vec::len).sum();
        // Room for one of them, and then for none.
        for (room, left) in [(size - 1, 1), (0, 0)] {
            let cache = Cache::open(&path).expect("a cache");
            let executor = new(Some(cache.with_size_max(room as u64)));
            let component = find("wall-follower").expect("a bundled robot").component;
            let robot = executor.admit(component).expect("the host works");
            robot.expect("a bundled robot");
            let kept: usize = entries(&path).values().map(Vec::len).sum();
            assert!(kept <= room, "{name}: {kept} of {room} bytes");
            assert!(entries(&path).len() >= left, "{name}: all of it is gone");
            fs::remove_dir_all(&path).expect("a folder");
        }
    }
}

/// What the compiler gives up on is not given to it again.
#[cfg(target_os = "linux")]
#[test]
fn rejections_are_kept() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder();
    let (log, worker) = (folder.path().join("log"), folder.path().join("worker"));
    let script = format!(
        "#!/bin/sh\necho \"$2\" >> '{}'\nexec '{WORKER}' \"$@\"\n",
        log.display()
    );
    fs::write(&worker, script).expect("a file");
    fs::set_permissions(&worker, fs::Permissions::from_mode(0o700)).expect("my file");
    let bad = wasm("(component)");
    let reject = |cache: Cache| {
        fs::write(&log, "").expect("a file");
        let executor = sandboxed(&worker, Some(cache)).expect("a worker starts");
        let admission = executor.admit(&bad).expect("the host works");
        let rejection = admission.err().expect("it exports nothing");
        let text = format!(
            "{}: {rejection} ({})",
            rejection.name().escaped(),
            rejection.hint().escaped()
        );
        let log = fs::read_to_string(&log).expect("a log");
        (text, log.lines().filter(|role| *role == "compile").count())
    };
    let path = folder.path().join("cache");
    let open = || Cache::open(&path).expect("a cache");
    let (text, compiled) = reject(open());
    assert!(text.starts_with("no-controller: "), "{text}");
    assert_eq!(compiled, 1);
    assert_eq!(reject(open()), (text.clone(), 0));
    // One that is damaged is not believed.
    for (path, mut content) in entries(&path) {
        *content.last_mut().expect("a hint") ^= 1;
        fs::write(path, content).expect("my file");
    }
    assert_eq!(reject(open()), (text.clone(), 1));
    assert_eq!(reject(open()), (text, 0));
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

#[cfg(unix)]
#[test]
fn a_cache_of_another_user_is_not_used() {
    let folder = folder();
    let own = folder.path().join("cache");
    Cache::open(&own).expect("a new folder");
    // Only root can give a folder away; everybody else is not the owner of this one.
    let path = match std::os::unix::fs::chown(&own, Some(65534), None) {
        Ok(()) => own,
        Err(_) => PathBuf::from("/usr"),
    };
    let error = Cache::open(&path).expect_err("somebody else's");
    assert!(
        error.to_string().contains("it belongs to another user"),
        "{error}"
    );
}

#[cfg(unix)]
#[test]
fn a_cache_that_others_may_replace_is_not_used() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder();
    let above = folder.path().join("above");
    fs::create_dir(&above).expect("a folder");
    let open = |mode| {
        fs::set_permissions(&above, fs::Permissions::from_mode(mode)).expect("my folder");
        Cache::open(above.join("cache"))
    };
    let error = open(0o777).expect_err("everyone may rename it");
    assert!(error.to_string().contains("a folder above it"), "{error}");
    open(0o1777).expect("only I may rename it");
    open(0o755).expect("only I may rename it");
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
