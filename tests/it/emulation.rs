//! The same results on other processors: the program runs here and in an emulator of another
//! processor, with bundled robots and much of the hostile corpus.
//!
//! Robots that trap are left out: the emulator (qemu-user 7.2) ends a program in whose code a
//! signal is handled as wasmtime does. Whether stacks overflow at the same depth is tested by
//! `recursion`, with figures that have to be the same on every processor.

#![cfg(target_arch = "x86_64")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;
use wasmouse_tests::corpus::cases;

use crate::binary::{self, ran};

/// The largest file that an emulator compiles in a few seconds, in bytes.
const FILE_BYTES_MAX: usize = 20_000;

/// Bundled robots that play in seconds there.
const BUNDLED: [&str; 6] = [
    "dfs",
    "flood",
    "lobato",
    "minnett",
    "random",
    "wall-follower",
];

/// A folder of hostile robots: all small files of the corpus, except those that use up their
/// fuel, which takes minutes each in an emulator, and those that fail.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let is_left_out = |expected: &Value| {
        let text = expected.to_string();
        text.contains("fuel") || text.contains("rejection") || text.contains("fault")
    };
    let hostile = cases()
        .into_iter()
        .filter(|case| !case.is_long && case.arguments.is_empty() && case.file_name.is_none())
        .filter(|case| !case.expected.iter().any(is_left_out))
        .filter(|case| !case.name.contains("touching") && !case.name.contains("growth"))
        .filter_map(|case| Some((case.name.clone(), case.files().pop()?)))
        .filter(|(_, file)| file.len() < FILE_BYTES_MAX);
    for (name, file) in hostile {
        fs::write(folder.path().join(format!("{name}.wasm")), file).expect("a file");
    }
    folder
}

/// What that program prints of a contest of all of them. Emulators cannot sandbox workers.
fn results(mut program: Command, folder: &Path) -> Vec<u8> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    program
        .args(["run", "test_maze_01", "--json", "--trust", "--no-cache"])
        .args(["--jobs", "1"])
        .args(BUNDLED)
        .args(files);
    let ran = ran(&mut program);
    assert!(!ran.stdout.is_empty(), "{}", ran.stderr);
    ran.stdout.into_bytes()
}

/// What came of each match, by the name of the robot, without what names the engine.
fn outcomes(results: &[u8]) -> BTreeMap<String, Value> {
    let document: Value = serde_json::from_slice(results).expect("JSON");
    let robots = document["contest"]["robots"].as_array().expect("robots");
    let names: BTreeMap<String, &str> = robots
        .iter()
        .map(|it| {
            (
                it["digest"].to_string(),
                it["name"].as_str().expect("a name"),
            )
        })
        .collect();
    let matches = document["matches"].as_array().expect("matches");
    let outcomes = matches.iter().map(|it| {
        let mut it = it.clone();
        let key = it.as_object_mut().and_then(|it| it.remove("key"));
        let robot = key.expect("a key")["robot"].to_string();
        (names[&robot].to_owned(), it)
    });
    outcomes.collect()
}

/// An emulator, if it is installed.
fn emulator(name: &str, arguments: &[&str], program: &Path) -> Option<Command> {
    if Command::new(name).arg("--version").output().is_err() {
        println!("skipped: there is no `{name}` (Debian: qemu-user)");
        return None;
    }
    let mut command = Command::new(name);
    command.args(arguments).arg(program);
    Some(command)
}

/// Every byte is the same on the oldest processor that has the features of the target.
#[test]
#[ignore = "emulates another processor with qemu-x86_64, which takes minutes"]
fn an_older_processor_gives_the_same_bytes() {
    let folder = folder();
    let program = binary::path();
    let Some(emulator) = emulator("qemu-x86_64", &["-cpu", "Nehalem"], &program) else {
        return;
    };
    let here = results(Command::new(&program), folder.path());
    let there = results(emulator, folder.path());
    let matches = outcomes(&here).len();
    assert!(matches > 30, "only {matches} matches");
    assert!(
        here == there,
        "{:#?}",
        differing(&outcomes(&here), &outcomes(&there))
    );
    println!("{matches} matches are the same, byte for byte");
}

/// A processor without the features of the target is an error that says so.
#[test]
#[ignore = "emulates another processor with qemu-x86_64"]
fn a_processor_without_the_baseline_is_refused() {
    let program = binary::path();
    let Some(mut emulator) = emulator("qemu-x86_64", &["-cpu", "core2duo"], &program) else {
        return;
    };
    let refused = ran(emulator.args(["run", "flood", "test_maze_01", "--trust"]));
    assert_eq!(refused.status.code(), Some(5), "{}", refused.stderr);
    let reason = "this processor cannot run robots: it has no ";
    assert!(refused.stderr.contains(reason), "{}", refused.stderr);
    assert!(refused.stdout.is_empty(), "{}", refused.stdout);
}

/// Robots that do not fail play the same matches on the other architecture, with the same fuel;
/// only the engine id differs.
///
/// Needs the program for it: `cargo build --target aarch64-unknown-linux-gnu` with
/// `CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc`, and its path in
/// `WASMOUSE_AARCH64`.
#[test]
#[ignore = "emulates aarch64, which takes minutes: set WASMOUSE_AARCH64 to a program for it"]
fn aarch64_plays_the_same_matches() {
    let Some(program) = std::env::var_os("WASMOUSE_AARCH64") else {
        println!("skipped: WASMOUSE_AARCH64 is not set");
        return;
    };
    let libraries = ["-L", "/usr/aarch64-linux-gnu"];
    let Some(emulator) = emulator("qemu-aarch64", &libraries, Path::new(&program)) else {
        return;
    };
    let folder = folder();
    let here = results(Command::new(binary::path()), folder.path());
    let there = results(emulator, folder.path());
    assert_ne!(here, there, "the engine id has the architecture");
    let differing = differing(&outcomes(&here), &outcomes(&there));
    assert!(differing.is_empty(), "{differing:#?}");
}

/// The matches that differ, with the fuel of both.
fn differing(
    here: &BTreeMap<String, Value>,
    there: &BTreeMap<String, Value>,
) -> BTreeMap<String, [Value; 2]> {
    let both = here.iter().filter_map(|(name, here)| {
        let there = there.get(name).unwrap_or(&Value::Null);
        (here != there).then(|| (name.clone(), [here, there].map(|it| it["fuel"].clone())))
    });
    both.collect()
}
