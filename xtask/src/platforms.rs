//! `cargo xtask check-platforms`: the workspace and its tests compile without warnings for the
//! systems that this machine is not.
//!
//! Nothing is linked or run. The C code of dependencies is compiled for Windows where there is a
//! compiler for that (Debian's `gcc-mingw-w64-x86-64`); elsewhere a program that does nothing
//! takes its place, which is enough to check the Rust code.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::step::Step;

/// A platform, and its C compiler and archiver on a Linux machine, if there are any.
const PLATFORMS: [(&str, Option<[&str; 2]>); 2] = [
    (
        "x86_64-pc-windows-gnu",
        Some(["x86_64-w64-mingw32-gcc", "x86_64-w64-mingw32-ar"]),
    ),
    ("aarch64-apple-darwin", None),
];

/// Checks every platform whose standard library can be installed, and says which one could not.
///
/// # Errors
///
/// A line that names the platform with a warning or an error.
pub fn run(root: &Path) -> Result<(), String> {
    if !cfg!(target_os = "linux") {
        eprintln!("==> platforms: skipped, they are checked on Linux");
        return Ok(());
    }
    for (target, tools) in PLATFORMS {
        if !succeeds(Command::new("rustup").args(["target", "add", target])) {
            eprintln!("==> {target}: skipped, rustup cannot install its standard library");
            continue;
        }
        let tools = tools.filter(|tools| {
            let mut tools = tools.iter();
            tools.all(|tool| succeeds(Command::new(tool).arg("--version")))
        });
        let [compiler, archiver] = tools.unwrap_or_else(|| {
            eprintln!("    {target}: there is no C compiler, so only Rust code is checked");
            ["true", "true"]
        });
        let variable = target.replace('-', "_");
        Step::cargo(target, root)
            .args(["clippy", "--workspace", "--all-targets", "--target", target])
            .args(["--", "-D", "warnings"])
            .env(&format!("CC_{variable}"), compiler)
            .env(&format!("AR_{variable}"), archiver)
            .run()?;
    }
    Ok(())
}

fn succeeds(command: &mut Command) -> bool {
    let quiet = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}
