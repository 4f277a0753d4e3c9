//! The prebuilt robots in `example-robots/languages/prebuilt`: small ones, for those without the
//! tools.
//!
//! With `WASMOUSE_WRITE_PREBUILT=1`, the tests of the languages write them again, with their sizes
//! and hashes in the manifest.

use std::env;
use std::fs;
use std::path::PathBuf;
use std::sync::Mutex;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use xtask::sources::sha256;

use crate::binary::{stdout_of, wasmouse};

/// A prebuilt robot has less than that. Unit: bytes.
const SIZE_BYTES_MAX: usize = 100_000;

#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    #[serde(default, rename = "robot")]
    robots: Vec<Entry>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    language: String,
    file: String,
    size_bytes: usize,
    sha256: String,
}

impl Entry {
    fn of(language: &str, component: &[u8]) -> Self {
        Self {
            language: language.to_owned(),
            file: format!("{language}.wasm"),
            size_bytes: component.len(),
            sha256: sha256(component),
        }
    }
}

fn folder() -> PathBuf {
    xtask::repository().join("example-robots/languages/prebuilt")
}

fn manifest() -> Manifest {
    let text = fs::read_to_string(folder().join("manifest.toml")).unwrap_or_default();
    toml::from_str(&text).expect("a manifest")
}

/// Checks that the prebuilt robot is what its sources give.
#[track_caller]
pub fn is_current(language: &str, component: &[u8]) {
    assert!(component.len() < SIZE_BYTES_MAX, "{language}");
    let entry = Entry::of(language, component);
    if env::var_os("WASMOUSE_WRITE_PREBUILT").is_some() {
        write(entry, component);
        return;
    }
    let manifest = manifest();
    let recorded = manifest.robots.iter().find(|it| it.language == language);
    assert_eq!(
        recorded,
        Some(&entry),
        "run the tests of the languages with WASMOUSE_WRITE_PREBUILT=1"
    );
}

fn write(entry: Entry, component: &[u8]) {
    /// Tests of several languages write at the same time.
    static WRITING: Mutex<()> = Mutex::new(());
    let _guard = WRITING.lock().expect("no test panicked while it wrote");
    let mut manifest = manifest();
    manifest.robots.retain(|it| it.language != entry.language);
    fs::create_dir_all(folder()).expect("a folder");
    fs::write(folder().join(&entry.file), component).expect("a file");
    manifest.robots.push(entry);
    manifest.robots.sort_by(|a, b| a.language.cmp(&b.language));
    let text = toml::to_string(&manifest).expect("a manifest");
    fs::write(folder().join("manifest.toml"), text).expect("a file");
}

#[test]
fn prebuilt_robots_are_those_of_the_manifest_and_drive_as_the_bundled_ones() {
    let manifest = manifest();
    assert!(
        manifest.robots.len() >= 5,
        "C, C++, Zig, AssemblyScript, text"
    );
    for entry in &manifest.robots {
        let path = folder().join(&entry.file);
        let component = fs::read(&path).expect("a prebuilt robot");
        assert_eq!(Entry::of(&entry.language, &component), *entry);
        let bundled = if entry.language == "wat" {
            "wall-follower"
        } else {
            "flood"
        };
        let mut command = wasmouse();
        command.arg("run").arg(&path).arg(bundled);
        command.args(["test_maze_01", "gen:braid:16:1..=4", "--json"]);
        let results: Value = serde_json::from_str(&stdout_of(&mut command)).expect("JSON");
        let matches = results["matches"].as_array().expect("matches");
        assert_eq!(matches.len(), 10);
        for one in matches {
            let same = |other: &&Value| other["transcript"] == one["transcript"];
            let twins = matches.iter().filter(same).count();
            assert!(twins >= 2, "{}: {}", entry.language, one["key"]["maze"]);
        }
    }
    let files = fs::read_dir(folder()).expect("a folder").count();
    assert_eq!(files, manifest.robots.len() + 1, "nothing but the robots");
}
