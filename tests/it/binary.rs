//! Runs the `wasmouse` binary that belongs to these tests.

use std::path::PathBuf;
use std::process::{Command, Output};

/// The binary beside the folder of this test program: `target/PROFILE/wasmouse`.
///
/// The tests are a package of their own, so cargo does not say where it is, nor
/// does it build it for `cargo test -p wasmouse-tests` alone.
pub fn path() -> PathBuf {
    let test = std::env::current_exe().expect("a running program has a path");
    let name = format!("wasmouse{}", std::env::consts::EXE_SUFFIX);
    let path: PathBuf = test
        .ancestors()
        .nth(2)
        .expect("tests are in target/PROFILE/deps")
        .join(name);
    assert!(
        path.is_file(),
        "no `{}`: build it with `cargo build --workspace --bins`, or run `cargo xtask test`",
        path.display()
    );
    path
}

/// A call of the binary.
pub fn wasmouse() -> Command {
    Command::new(path())
}

/// Runs a command that has to succeed and returns its standard output.
#[track_caller]
pub fn stdout_of(command: &mut Command) -> String {
    let output: Output = command.output().expect("the program can be run");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{command:?} ended with {}:\n{stderr}",
        output.status
    );
    String::from_utf8(output.stdout).expect("standard output is text")
}
