//! The same results on other processors: the program runs here and in an emulator of another
//! processor, with bundled robots and much of the hostile corpus.
//!
//! The emulator is QEMU 10 or newer, which `cargo xtask emulators` installs. QEMU 7.2 is not enough:
//! with robots that trap it ends with `qemu: uncaught target signal 11 (Segmentation fault)`. Whether
//! stacks overflow at the same depth is also tested by `recursion`, with figures that have to be the
//! same on every processor.

#![cfg(target_arch = "x86_64")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;
use wasmouse_tests::corpus::{Case, cases};
use xtask::emulators::Emulator;

use crate::binary::{self, ran};

/// The largest file that an emulator compiles in a few seconds, in bytes.
const FILE_BYTES_MAX: usize = 20_000;

/// The oldest processor that has the features of the target.
const NEHALEM: &[&str] = &["-cpu", "Nehalem"];

/// Bundled robots that play in seconds there.
const BUNDLED: [&str; 6] = [
    "dfs",
    "flood",
    "lobato",
    "minnett",
    "random",
    "wall-follower",
];

/// The fuel of a robot that plays in a second there.
const FUEL_MAX: u64 = 20_000_000;

/// Robots that use up their fuel, which takes seconds each there: in a loop, and behind a call.
const OUT_OF_FUEL: [&str; 2] = ["fuel-ends-at-a-call", "loop-in-step"];

/// A folder of hostile robots: the small files of those cases of the corpus, except the ones that
/// use up their fuel, and those that are rejected.
fn folder(is_wanted: impl Fn(&Case) -> bool) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let is_played = |case: &Case| {
        let is_plain = !case.is_long && case.arguments.is_empty() && case.file_name.is_none();
        let is_large = case.name.contains("touching") || case.name.contains("growth");
        is_plain && !is_large && !expects(case, "rejection")
    };
    let hostile = cases()
        .into_iter()
        .filter(|case| is_played(case) && is_wanted(case))
        .filter_map(|case| Some((case.name.clone(), case.files().pop()?)))
        .filter(|(_, file)| file.len() < FILE_BYTES_MAX);
    for (name, file) in hostile {
        fs::write(folder.path().join(format!("{name}.wasm")), file).expect("a file");
    }
    folder
}

/// Whether an outcome that the case may have mentions that word.
fn expects(case: &Case, word: &str) -> bool {
    let mut expected = case.expected.iter();
    expected.any(|outcome| outcome.to_string().contains(word))
}

/// What that program prints of a contest of these robots. Emulators cannot sandbox workers.
fn results(mut program: Command, bundled: &[&str], folder: &Path) -> Vec<u8> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    program
        .args(["run", "test_maze_01", "--json", "--trust", "--no-cache"])
        .args(["--jobs", "1"])
        .args(bundled)
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

/// That program in an emulator, unless the test is skipped.
fn emulated(emulator: Emulator, arguments: &[&str], program: &Path, test: &str) -> Option<Command> {
    let mut command = Command::new(emulator.find(&xtask::repository(), test)?);
    command.args(arguments).arg(program);
    Some(command)
}

/// Compares what this processor and the oldest one with the features of the target print, and
/// returns the outcomes.
fn compare(emulator: Command, bundled: &[&str], folder: &Path) -> BTreeMap<String, Value> {
    let here = results(Command::new(binary::path()), bundled, folder);
    let there = results(emulator, bundled, folder);
    let outcomes_here = outcomes(&here);
    assert!(
        here == there,
        "{:#?}",
        differing(&outcomes_here, &outcomes(&there))
    );
    println!(
        "{} matches are the same, byte for byte",
        outcomes_here.len()
    );
    outcomes_here
}

/// Robots that trap do it with the same fault, after the same fuel, and with the same backtrace:
/// out of bounds, a division by zero, `unreachable`, an overflow of the stack, the end of their
/// fuel, and the others of the corpus.
#[test]
fn an_older_processor_traps_in_the_same_place() {
    let program = binary::path();
    let test = "emulation::an_older_processor_traps_in_the_same_place";
    let Some(emulator) = emulated(Emulator::X86_64, NEHALEM, &program, test) else {
        return;
    };
    let traps = |case: &Case| expects(case, "fault") && !expects(case, "fuel");
    let folder = folder(|case| traps(case) || OUT_OF_FUEL.contains(&case.name.as_str()));
    // What takes long there is not known before it was played here.
    let played = outcomes(&results(Command::new(&program), &[], folder.path()));
    for (name, outcome) in played {
        let fuel: u64 = outcome["fuel"]
            .as_object()
            .into_iter()
            .flat_map(|fuel| fuel.values())
            .filter_map(Value::as_u64)
            .sum();
        if fuel > FUEL_MAX && !OUT_OF_FUEL.contains(&name.as_str()) {
            fs::remove_file(folder.path().join(name).with_extension("wasm")).expect("a file");
        }
    }
    let outcomes = compare(emulator, &[], folder.path());
    let mut kinds: BTreeMap<&str, u32> = BTreeMap::new();
    for outcome in outcomes.values() {
        if let Some(kind) = outcome["verdict"]["fault"]["kind"].as_str() {
            *kinds.entry(kind).or_default() += 1;
        }
    }
    println!("{kinds:?}");
    for kind in [
        "division-by-zero",
        "integer-overflow",
        "bad-indirect-call",
        "out-of-bounds",
        "out-of-step-fuel",
        "stack-overflow",
        "unreachable",
    ] {
        assert!(kinds.contains_key(kind), "no {kind} in {kinds:?}");
    }
}

/// Every byte is the same on the oldest processor that has the features of the target.
#[test]
#[ignore = "emulates another processor, which takes minutes"]
fn an_older_processor_gives_the_same_bytes() {
    let program = binary::path();
    let test = "emulation::an_older_processor_gives_the_same_bytes";
    let Some(emulator) = emulated(Emulator::X86_64, NEHALEM, &program, test) else {
        return;
    };
    let folder = folder(|case| !expects(case, "fuel"));
    let outcomes = compare(emulator, &BUNDLED, folder.path());
    assert!(outcomes.len() > 30, "only {} matches", outcomes.len());
}

/// A processor without the features of the target is an error that says so.
#[test]
fn a_processor_without_the_baseline_is_refused() {
    let program = binary::path();
    let test = "emulation::a_processor_without_the_baseline_is_refused";
    let model = ["-cpu", "core2duo"];
    let Some(mut emulator) = emulated(Emulator::X86_64, &model, &program, test) else {
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
    let test = "emulation::aarch64_plays_the_same_matches";
    let program = Path::new(&program);
    let Some(emulator) = emulated(Emulator::Aarch64, &libraries, program, test) else {
        return;
    };
    let folder = folder(|case| !expects(case, "fuel") && !expects(case, "fault"));
    let here = results(Command::new(binary::path()), &BUNDLED, folder.path());
    let there = results(emulator, &BUNDLED, folder.path());
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
