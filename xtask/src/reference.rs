//! `cargo xtask reference`: plays the bundled robots and writes `docs/REFERENCE.md`.
//!
//! The program is part of the tests; here it is built in the release profile and run.

use std::ffi::OsString;
use std::path::Path;

use crate::step::Step;

/// Builds and runs the program.
///
/// # Errors
///
/// A line when it fails.
pub fn run(root: &Path, arguments: &[OsString]) -> Result<(), String> {
    Step::cargo("reference results", root)
        .args(["run", "--release", "-p", "wasmouse-tests"])
        .args(["--bin", "reference", "--"])
        .args(arguments)
        .run()
}
