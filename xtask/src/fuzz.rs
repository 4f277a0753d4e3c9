//! `cargo xtask fuzz`: runs a fuzz target for longer than the tests do.
//!
//! Under libFuzzer where `cargo-fuzz` is installed, else as a test with random inputs.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::step::{Step, target_folder};

/// The crates with fuzz targets, and their targets.
const TARGETS: [(&str, &[&str]); 3] = [
    (
        "wasmouse-core",
        &["maze", "specification", "transcript", "record"],
    ),
    (
        "wasmouse-engine",
        &[
            "admission",
            "requests",
            "reports",
            "matches",
            "differential",
        ],
    ),
    (SEARCHES, &["compile_cost"]),
];

/// The package whose targets search for themselves: libFuzzer has nothing to guide there.
const SEARCHES: &str = "wasmouse-tests";

/// Runs a target for that many minutes, or lists all targets.
///
/// # Errors
///
/// A line that says what failed.
pub fn run(root: &Path, target: Option<&str>, minutes: u64) -> Result<(), String> {
    let Some(target) = target else {
        for (package, targets) in TARGETS {
            println!("{package}: {}", targets.join(", "));
        }
        return Ok(());
    };
    let mut packages = TARGETS.into_iter();
    let (package, _) = packages
        .find(|(_, targets)| targets.contains(&target))
        .ok_or_else(|| format!("unknown fuzz target `{target}`; `cargo xtask fuzz` lists them"))?;
    // What is compiled in a search is timed, and the compiler checks itself in other profiles.
    let profile = if package == SEARCHES {
        "release"
    } else {
        "dev"
    };
    let as_test = |name: &str| {
        let filter = format!("fuzz::tests::{target}");
        Step::cargo(name, root)
            .args(["test", "--package", package, "--lib"])
            .args(["--profile", profile, "--"])
            .args([&filter, "--nocapture"])
    };
    let seconds = (minutes * 60).to_string();
    if package == SEARCHES {
        return as_test("search")
            .env("WASMOUSE_FUZZ_SECONDS", seconds)
            // As many as compile in the program.
            .env("RAYON_NUM_THREADS", "2")
            .run();
    }
    if !has_cargo_fuzz() {
        eprintln!(
            "cargo-fuzz is not installed, so inputs are random; with `cargo install cargo-fuzz` \
             and a C++ compiler, coverage guides them"
        );
        return as_test("random inputs")
            .env("WASMOUSE_FUZZ_SECONDS", seconds)
            .run();
    }
    let corpus = target_folder(root).join("fuzz-corpus");
    as_test("seeds")
        .env("WASMOUSE_FUZZ_CORPUS", &corpus)
        .run()?;
    Step::cargo("libFuzzer", root)
        .args(["fuzz", "run", "--fuzz-dir", "tests/fuzz"])
        // The sanitizers need a nightly compiler, and the crates have little unsafe code.
        .args(["--sanitizer", "none", target])
        .args([corpus.join(target)])
        .args(["--", &format!("-max_total_time={seconds}")])
        // Instrumentation is an unstable flag of the compiler.
        .env("RUSTC_BOOTSTRAP", "1")
        .run()
}

fn has_cargo_fuzz() -> bool {
    Command::new("cargo-fuzz")
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}
