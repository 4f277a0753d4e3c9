//! `cargo xtask test`: everything that has to hold before a change is merged.
//!
//! Cheap steps come first, and the first failure ends it. Every cargo call is
//! for the whole workspace, so that features are unified in one way and the
//! heavy dependencies are compiled once for checking and once for running.

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::step::{Step, target_folder};
use crate::{corpus, emulators, languages, robots, validators, web};

/// Where the tests find robots that were built from source just now.
pub const BUILT_ROBOTS_VARIABLE: &str = "WASMOUSE_BUILT_ROBOTS";

/// Runs all steps; with `long`, also the tests and cases that take minutes each.
///
/// # Errors
///
/// A line that names the step that failed.
pub fn run(root: &Path, long: bool) -> Result<(), String> {
    if long && !has_shared_material(root) {
        return Err("--long needs shared material: set WASMOUSE_SHARED".to_owned());
    }
    Step::cargo("format", root)
        .args(["fmt", "--all", "--check"])
        .run()?;
    Step::cargo("lints", root)
        .args(["clippy", "--workspace", "--all-targets"])
        .args(["--", "-D", "warnings"])
        .run()?;
    Step::cargo("documentation", root)
        .args(["doc", "--workspace", "--no-deps"])
        .env("RUSTDOCFLAGS", "-D warnings")
        .run()?;
    licences(root)?;
    // With the tests, because their dependencies turn on features of shared
    // crates: without them wasmtime would be compiled once more for the tests.
    Step::cargo("build", root)
        .args(["build", "--workspace", "--bins", "--tests"])
        .run()?;
    web::verify(root)?;
    let missing = validators::install(root);
    let without_tools = languages::install(root);
    let without_emulators = emulators::install(root);
    let built = target_folder(root).join("robots");
    robots::build_all(root, &built)?;
    let (ignored, cases): (&[&str], &[OsString]) = if long {
        (&["--", "--include-ignored"], &["--long".into()])
    } else {
        (&[], &[])
    };
    Step::cargo("tests", root)
        .args(["test", "--workspace"])
        .args(ignored)
        .env(BUILT_ROBOTS_VARIABLE, &built)
        .run()?;
    web::test(root)?;
    corpus::play(root, cases)?;
    if !has_shared_material(root) {
        eprintln!(
            "note: the tests that need shared material were ignored, and are counted as ignored \
             above; set WASMOUSE_SHARED to run them"
        );
    }
    if !missing.is_empty() {
        eprintln!(
            "note: {} validators could not be installed, and the tests that need them were \
             skipped; each is named above",
            missing.len()
        );
    }
    if !without_tools.is_empty() {
        eprintln!(
            "note: the tools of {} languages could not be installed, and their tests were skipped; \
             each is named above",
            without_tools.len()
        );
    }
    if !without_emulators.is_empty() {
        eprintln!(
            "note: {} emulators could not be installed, and the tests that need them were skipped; \
             each is named above",
            without_emulators.len()
        );
    }
    eprintln!("all checks passed");
    Ok(())
}

/// Whether the mazes and recorded matches are there that do not belong to the repository;
/// `tests/build.rs` looks in the same places.
fn has_shared_material(root: &Path) -> bool {
    let folder = env::var_os("WASMOUSE_SHARED").map(PathBuf::from);
    folder.unwrap_or_else(|| root.join("../shared")).is_dir()
}

/// The check of licences and advisories is a program of its own and not a part
/// of Rust, so a machine without it skips the step; CI has it.
fn licences(root: &Path) -> Result<(), String> {
    let installed = Command::new("cargo-deny")
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success());
    if !installed {
        eprintln!("==> licences: skipped, cargo-deny is not installed");
        eprintln!("    to have it: cargo install --locked cargo-deny");
        return Ok(());
    }
    // Advisories need a download and change from day to day; CI looks at them in
    // a job of its own, so that they never make a good change fail here.
    Step::cargo("licences", root)
        .args(["deny", "check", "bans", "licenses", "sources"])
        .run()
}
