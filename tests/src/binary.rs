//! Runs the `wasmouse` binary that belongs to these tests.

use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};

/// The binary in the folder of this program, or above it when this is a test:
/// `target/PROFILE/wasmouse`.
///
/// The tests are a package of their own, so cargo neither reports where it is nor
/// builds it for `cargo test -p wasmouse-tests` alone.
///
/// # Panics
///
/// When there is none.
pub fn path() -> PathBuf {
    let program = std::env::current_exe().expect("a running program has a path");
    let name = format!("wasmouse{}", std::env::consts::EXE_SUFFIX);
    let folders = program.ancestors().skip(1).take(2);
    let path = folders
        .map(|folder| folder.join(&name))
        .find(|path| path.is_file());
    path.unwrap_or_else(|| {
        panic!(
            "no `{name}` beside `{}`: build it with `cargo build --workspace --bins`, \
             or run `cargo xtask test`",
            program.display()
        )
    })
}

/// A call of the binary.
pub fn wasmouse() -> Command {
    Command::new(path())
}

/// The result of a call.
pub struct Ran {
    /// How it ended.
    pub status: ExitStatus,
    /// What it wrote to stdout.
    pub stdout: String,
    /// What it wrote to stderr.
    pub stderr: String,
}

/// Runs a command to its end with nothing on its standard input.
///
/// # Panics
///
/// When it cannot be run, printed something else than text, or panicked.
#[track_caller]
pub fn ran(command: &mut Command) -> Ran {
    let output = command
        .stdin(Stdio::null())
        .output()
        .expect("the program can be run");
    let text = |bytes| String::from_utf8(bytes).expect("programs print text");
    let (stdout, stderr) = (text(output.stdout), text(output.stderr));
    // A robot's panic is a verdict, `panicked: ...`, and not one of the program.
    assert!(!stderr.contains("panicked at"), "{command:?}:\n{stderr}");
    Ran {
        status: output.status,
        stdout,
        stderr,
    }
}

/// Runs a command that must succeed and returns its standard output.
///
/// # Panics
///
/// When it fails.
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
