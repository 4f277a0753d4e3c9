//! Zig: a project is a `build.zig`, whose install step writes the module.

use std::fs;
use std::path::Path;

use super::zig_compiler::ZIG;
use crate::cli::failure::Failure;
use crate::cli::project::language::{Language, Project};
use crate::report::text::text;

/// Zig.
pub static LANGUAGE: Language = Language {
    name: "zig",
    title: "Zig",
    markers: &[BUILD_FILE],
    is_in: |folder| folder.join(BUILD_FILE).is_file(),
    open: Project::named_after_folder,
    compile: |project, _| compile(project),
    sources: &["src", "wasmouse", BUILD_FILE, "build.zig.zon"],
    tools: &[&ZIG],
    check: None,
    setup: &[],
};

const BUILD_FILE: &str = "build.zig";

/// What `zig build` installs, below the prefix that it is given.
const MODULE: &str = "bin/robot.wasm";

/// Runs `zig build`; its diagnostics go to stderr as they come.
fn compile(project: &Project) -> Result<Vec<u8>, Failure> {
    let zig = ZIG.find(Some(&project.folder))?;
    let scratch = tempfile::tempdir()
        .map_err(|error| Failure::internal(text!("no temporary folder: {}", error)))?;
    let prefix = scratch.path();
    let mut command = zig.command();
    command
        .args(["build", "install", "--summary", "none", "--prefix"])
        .arg(prefix)
        .current_dir(&project.folder);
    zig.run(command, &text!("compile `{}`", project.name))?;
    let module: &Path = &prefix.join(MODULE);
    fs::read(module).map_err(|error| {
        Failure::input(text!("`zig build` installed no {}: {}", MODULE, error)).hint(
            "the executable in build.zig has to be named `robot`, for the target \
             wasm32-freestanding, and `b.installArtifact` has to install it",
        )
    })
}
