//! `cargo xtask corpus`: plays the hostile corpus.
//!
//! The program is a part of the tests; here it is built with the binary that it plays
//! the cases through, and run.

use std::ffi::OsString;
use std::path::Path;

use crate::step::{Step, target_folder};

/// Builds and plays.
///
/// # Errors
///
/// A line that says what failed.
pub fn run(root: &Path, arguments: &[OsString]) -> Result<(), String> {
    Step::cargo("build", root)
        // The same call as in `verify`, for the same reason.
        .args(["build", "--workspace", "--bins", "--tests"])
        .run()?;
    play(root, arguments)
}

/// Plays with programs that are there already.
///
/// # Errors
///
/// A line when a case is not as expected.
pub fn play(root: &Path, arguments: &[OsString]) -> Result<(), String> {
    let name = format!("corpus{}", std::env::consts::EXE_SUFFIX);
    let program = target_folder(root).join("debug").join(name);
    Step::new("hostile corpus", root, program)
        .args(arguments)
        .run()
}
