//! The cache of compiled robots never changes a result: not when it is damaged,
//! unusable or open to others.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::binary::{Ran, ran, stdout_of, wasmouse};

/// A contest with two robots, as JSON, with compiled robots in that folder.
fn contest(cache: &Path) -> Ran {
    ran(wasmouse()
        .args(["run", "flood", "dfs", "test_maze_01", "--json", "--cache"])
        .arg(cache))
}

fn uncached() -> String {
    stdout_of(wasmouse().args([
        "run",
        "flood",
        "dfs",
        "test_maze_01",
        "--json",
        "--no-cache",
    ]))
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

#[test]
fn damaged_entries_are_replaced() {
    let folder = folder();
    let cache = folder.path().join("cache");
    let first = contest(&cache);
    assert_eq!(
        (first.stdout.as_str(), first.stderr.as_str()),
        (&*uncached(), "")
    );
    let good = entries(&cache);
    assert_eq!(good.len(), 2);

    type Damage = fn(&mut Vec<u8>);
    let damages: [(&str, Damage); 8] = [
        ("first byte", |bytes| bytes[0] ^= 1),
        ("first byte of the code", |bytes| bytes[32] ^= 0x80),
        ("a byte in the middle", |bytes| {
            let middle = bytes.len() / 2;
            bytes[middle] ^= 1;
        }),
        ("last byte", |bytes| *bytes.last_mut().expect("bytes") ^= 1),
        ("one byte less", |bytes| {
            bytes.pop();
        }),
        ("one byte more", |bytes| bytes.push(0)),
        ("half a digest", |bytes| bytes.truncate(16)),
        ("nothing", Vec::clear),
    ];
    for (name, damage) in damages {
        for (path, bytes) in &good {
            let mut bytes = bytes.clone();
            damage(&mut bytes);
            fs::write(path, bytes).expect("a file");
        }
        let again = contest(&cache);
        assert_eq!(again.stdout, first.stdout, "{name}");
        assert_eq!(again.stderr, "", "{name}");
        assert!(entries(&cache) == good, "{name}: the entries are as before");
    }
}

/// An entry under the name of another: its own digest fits, so only the name
/// and the digest together could tell. Only the user can put it there.
#[test]
fn an_entry_that_is_a_folder_is_no_obstacle() {
    let folder = folder();
    let cache = folder.path().join("cache");
    contest(&cache);
    for path in entries(&cache).into_keys() {
        fs::remove_file(&path).expect("a file");
        fs::create_dir(&path).expect("a folder");
    }
    let again = contest(&cache);
    assert_eq!(again.stdout, uncached());
    assert!(
        again.stderr.starts_with("warning: failed to use the cache"),
        "{}",
        again.stderr
    );
}

#[test]
fn a_cache_that_cannot_be_used_is_told_and_left_alone() {
    let folder = folder();
    let file = folder.path().join("file");
    fs::write(&file, "mine").expect("a file");
    for cache in [file.clone(), file.join("below")] {
        let ran = contest(&cache);
        assert_eq!(ran.stdout, uncached());
        assert!(ran.status.success());
        let warning = format!(
            "warning: failed to use the cache of compiled robots at `{}`: ",
            cache.display()
        );
        assert!(ran.stderr.starts_with(&warning), "{}", ran.stderr);
    }
    assert_eq!(fs::read(&file).expect("a file"), b"mine");
}

#[cfg(unix)]
#[test]
fn a_cache_that_others_may_write_to_is_not_used() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder();
    let cache = folder.path().join("cache");
    contest(&cache);
    let mode = |path: &Path| {
        let metadata = fs::metadata(path).expect("the cache");
        metadata.permissions().mode() & 0o777
    };
    assert_eq!(mode(&cache), 0o700, "the folder is made private");
    let good = entries(&cache);
    // What somebody else has put there is not loaded, nor is it replaced.
    for path in good.keys() {
        fs::write(path, "trap").expect("a file");
    }
    for open in [0o777, 0o720, 0o702] {
        fs::set_permissions(&cache, fs::Permissions::from_mode(open)).expect("my folder");
        let ran = contest(&cache);
        assert_eq!(ran.stdout, uncached());
        assert!(
            ran.stderr.contains("others may write to it"),
            "{}",
            ran.stderr
        );
        assert!(entries(&cache).values().all(|bytes| bytes == b"trap"));
    }
}

/// `--no-cache` wins, wherever the folder is named.
#[test]
fn no_cache_keeps_nothing() {
    let folder = folder();
    let cache = folder.path().join("cache");
    let mut command = wasmouse();
    command.args(["run", "flood", "test_maze_01", "--no-cache"]);
    stdout_of(command.env("WASMOUSE_CACHE", &cache));
    stdout_of(command.arg("--cache").arg(&cache));
    assert!(!cache.exists());
}
