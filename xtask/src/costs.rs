//! `cargo xtask costs`: builds a robot in every language and writes what it costs into
//! `docs/LANGUAGES.md`.
//!
//! The program is part of the tests; here it and wasmouse are built in the release profile and
//! run.

use std::ffi::OsString;
use std::path::Path;

use crate::languages;
use crate::step::Step;

/// Builds and runs the program.
///
/// # Errors
///
/// A line when it fails.
pub fn run(root: &Path, arguments: &[OsString]) -> Result<(), String> {
    languages::install(root);
    Step::cargo("build", root)
        // Only what is needed: linking in the release profile takes long.
        .args(["build", "--release", "--workspace"])
        .args(["--bin", "wasmouse", "--bin", "costs"])
        .run()?;
    Step::cargo("costs of languages", root)
        .args(["run", "--release", "--workspace", "--bin", "costs", "--"])
        .args(arguments)
        .run()
}
