//! [`check`]: compiles a crate of this repository for WebAssembly.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The target of robots and of the web viewer.
pub const WASM_TARGET: &str = "wasm32-unknown-unknown";

/// The compiler of Debian's package `rustc-web`, for machines on which rustup has no target.
const PACKAGED_RUSTC: &str = "/usr/bin/rustc";

/// A call of the cargo that runs the tests, in the root folder of the repository.
pub fn cargo(arguments: &str) -> Command {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root).args(arguments.split_whitespace());
    command
}

/// A call of `cargo check` for the library of `package` and [`WASM_TARGET`].
///
/// It chooses the compiler like `wasmouse build`: that of cargo if it has the target, else a
/// packaged one, which may have to compile the standard library from source. `target_folder` is
/// for this call alone, so that it does not wait for another cargo's lock.
///
/// # Panics
///
/// If there is no compiler with the target.
pub fn check(package: &str, target_folder: &Path) -> Command {
    let mut command = cargo("check --locked --lib --package");
    command.arg(package).arg("--target").arg(WASM_TARGET);
    command.env("CARGO_TARGET_DIR", target_folder);
    let cargos_rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    if has_target(Path::new(&cargos_rustc)) {
        return command;
    }
    assert!(
        Path::new(PACKAGED_RUSTC).is_file(),
        "no compiler for {WASM_TARGET}: run `rustup target add {WASM_TARGET}`, or install the \
         packages rustc-web and rust-web-src"
    );
    command.env("RUSTC", PACKAGED_RUSTC);
    if !has_target(Path::new(PACKAGED_RUSTC)) {
        // `-Z` needs a nightly compiler or this variable.
        command.env("RUSTC_BOOTSTRAP", "1");
        command.arg("-Zbuild-std=std,panic_abort");
    }
    command
}

/// Whether a compiler has the standard library of [`WASM_TARGET`].
fn has_target(rustc: &Path) -> bool {
    let output = Command::new(rustc)
        .args(["--print", "target-libdir", "--target", WASM_TARGET])
        .output();
    let folder = output.ok().filter(|output| output.status.success());
    let folder = folder.and_then(|output| String::from_utf8(output.stdout).ok());
    folder.is_some_and(|folder| PathBuf::from(folder.trim_end()).is_dir())
}
