//! `cargo xtask fuzz`: feeds changed inputs to what reads a stranger's bytes.
//!
//! The program is a part of the tests; here it is built and run.

use std::ffi::{OsStr, OsString};
use std::path::Path;

use crate::step::{Step, target_folder};

/// Builds and fuzzes.
///
/// # Errors
///
/// A line that says what failed.
pub fn run(root: &Path, arguments: &[OsString]) -> Result<(), String> {
    Step::cargo("build", root)
        // The same call as in `verify`, for the same reason.
        .args(["build", "--workspace", "--bins", "--tests"])
        .run()?;
    let target = target_folder(root);
    let program = |folder: &Path, name: &str| {
        let name = format!("{name}{}", std::env::consts::EXE_SUFFIX);
        folder.join("debug").join(name)
    };
    let smith_target = target.join("smith");
    Step::cargo("smith", root)
        .args(["build", "--manifest-path", "tests/smith/Cargo.toml"])
        .args([OsStr::new("--target-dir"), smith_target.as_os_str()])
        .run()?;
    Step::new("fuzzing", root, program(&target, "fuzz"))
        .args([
            OsStr::new("--smith"),
            program(&smith_target, "smith").as_os_str(),
        ])
        .args([OsStr::new("--findings"), target.join("fuzz").as_os_str()])
        .args(arguments)
        .run()
}
