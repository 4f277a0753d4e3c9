//! Runs the `wasmouse` binary that belongs to these tests.

use std::path::PathBuf;
use std::process::Command;

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
