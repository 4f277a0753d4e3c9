//! Projects in Rust for the targets that have WASI, with the bundled flood robot.

use std::fs;
use std::io;
use std::path::Path;

/// The prefix of the kits: `rust-wasip1` is the kit of the target `wasm32-wasip1`.
const KIT_PREFIX: &str = "rust-";

/// The target of a kit with that name; `None` when it is another language.
pub fn target_of(kit: &str) -> Option<String> {
    let target = kit.strip_prefix(KIT_PREFIX)?;
    Some(format!("wasm32-{target}"))
}

/// The source of the flood robot for a project in a crate of its own, without tests.
///
/// # Panics
///
/// When it cannot be read.
pub fn flood() -> String {
    let path = xtask::repository().join("example-robots/flood/src/lib.rs");
    let source = fs::read_to_string(path).expect("the bundled robot");
    let robot = source.split("#[cfg(test)]").next().expect("the robot");
    robot.to_owned()
}

/// Chooses the target of a project in its manifest, for wasmouse alone.
///
/// # Errors
///
/// When the manifest cannot be written.
pub fn choose(target: &str, project: &Path) -> io::Result<()> {
    let manifest = project.join("Cargo.toml");
    let text = fs::read_to_string(&manifest)?;
    let table = format!("\n[package.metadata.wasmouse]\ntarget = \"{target}\"\n");
    fs::write(manifest, text + &table)
}

/// Chooses the target of a project as cargo has it, for all its commands.
///
/// # Errors
///
/// When the configuration cannot be written.
pub fn configure(target: &str, project: &Path) -> io::Result<()> {
    fs::create_dir(project.join(".cargo"))?;
    let configuration = format!("[build]\ntarget = \"{target}\"\n");
    fs::write(project.join(".cargo/config.toml"), configuration)
}
