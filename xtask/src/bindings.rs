//! `cargo xtask bindings`: generates from `wit/robot.wit` the SDK's bindings, the C header, and the
//! page of the binary interface.
//!
//! The generator is a program of the tests, because it has dependencies that this crate must
//! not have.

use std::path::Path;

use crate::step::Step;

/// Builds the generator and runs it.
///
/// # Errors
///
/// A line that says what failed.
pub fn generate(root: &Path) -> Result<(), String> {
    Step::cargo("bindings", root)
        .args(["run", "--package", "wasmouse-tests", "--bin", "bindings"])
        .run()
}
