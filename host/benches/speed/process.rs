//! The whole process: `wasmouse run ROBOT MAZE`, from start to exit code.

use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Stdio};

/// Runs the binary that cargo built beside the benchmark, with that cache.
pub fn run_flood(cache: &Path) {
    run_file(Path::new("flood"), cache, &[]);
}

/// The same with a robot in a file and more arguments.
pub fn run_file(robot: &Path, cache: &Path, more: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_wasmouse"))
        .args([OsStr::new("run"), robot.as_os_str()])
        .args(["test_maze_01", "--cache"])
        .arg(cache)
        .args(more)
        .stdin(Stdio::null())
        .output()
        .expect("cargo has built the binary");
    assert!(output.status.success(), "{output:?}");
}
