//! Runs the `wasmouse` binary that belongs to these tests.

use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};

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

/// What a call left behind.
pub struct Ran {
    /// How it ended.
    pub status: ExitStatus,
    /// What it printed.
    pub stdout: String,
    /// What it said.
    pub stderr: String,
}

/// Runs a command to its end with nothing on its standard input.
///
/// # Panics
///
/// When it printed something else than text, or panicked.
#[track_caller]
pub fn ran(command: &mut Command) -> Ran {
    let output = command
        .stdin(Stdio::null())
        .output()
        .expect("the program can be run");
    let text = |bytes| String::from_utf8(bytes).expect("programs print text");
    let (stdout, stderr) = (text(output.stdout), text(output.stderr));
    assert!(!stderr.contains("panicked"), "{command:?}:\n{stderr}");
    Ran {
        status: output.status,
        stdout,
        stderr,
    }
}

/// Runs a command that has to succeed and returns its standard output.
#[track_caller]
pub fn stdout_of(command: &mut Command) -> String {
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(command);
    assert!(status.success(), "{command:?}: {status}\n{stderr}");
    stdout
}
