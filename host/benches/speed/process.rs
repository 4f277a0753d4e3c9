//! The whole process: `wasmouse run flood MAZE`, from start to exit code.

use std::path::Path;
use std::process::{Command, Stdio};

/// Runs the binary that cargo built beside the benchmark, with that cache.
pub fn run_flood(cache: &Path) {
    let output = Command::new(env!("CARGO_BIN_EXE_wasmouse"))
        .args(["run", "flood", "test_maze_01", "--cache"])
        .arg(cache)
        .stdin(Stdio::null())
        .output()
        .expect("cargo has built the binary");
    assert!(output.status.success(), "{output:?}");
}
