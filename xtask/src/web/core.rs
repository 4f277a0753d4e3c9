//! Compiles the core of web pages to WebAssembly.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Step, target_folder};

const TARGET: &str = "wasm32-unknown-unknown";

/// The profile in the workspace's manifest.
const PROFILE: &str = "web";

/// Compiles the core into a file. The bytes depend on the sources and the compiler alone.
///
/// # Errors
///
/// A line that says what failed.
pub fn build(root: &Path, output: &Path) -> Result<(), String> {
    let folder = target_folder(root).join("web/target");
    Step::cargo("core of web pages", root)
        .args(["build", "--locked", "--package", "wasmouse-web", "--lib"])
        .args(["--profile", PROFILE, "--target", TARGET])
        .args(["--target-dir".as_ref(), folder.as_os_str()])
        // In place of all other flags, for the same bytes everywhere.
        .env("CARGO_ENCODED_RUSTFLAGS", path_names(root).join("\x1f"))
        .run()?;
    let built = folder.join(TARGET).join(PROFILE).join("wasmouse_web.wasm");
    let bytes = fs::read(&built).map_err(|error| format!("`{}`: {error}", built.display()))?;
    fs::write(output, bytes).map_err(|error| format!("`{}`: {error}", output.display()))
}

/// The compiler that builds the core here.
///
/// # Errors
///
/// When there is none for WebAssembly.
pub fn toolchain() -> Result<String, String> {
    let run = |arguments: &[&str]| {
        let output = Command::new("rustc").args(arguments).output();
        let output = output.map_err(|error| format!("`rustc` cannot run: {error}"))?;
        Ok::<_, String>(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let library = run(&["--print", "target-libdir", "--target", TARGET])?;
    if !Path::new(&library).is_dir() {
        return Err(format!("rustc has no target {TARGET}"));
    }
    run(&["--version"])
}

/// Names for the folders that messages of panics quote, the more particular ones last.
fn path_names(root: &Path) -> Vec<String> {
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(env::home_dir()?.join(".cargo")));
    let mut names = vec![
        (home.clone(), "/cargo"),
        (Some(root.to_owned()), "/wasmouse"),
    ];
    // The name of a registry's folder has its host and a hash.
    let registries = home.and_then(|home| fs::read_dir(home.join("registry/src")).ok());
    let registries = registries.into_iter().flatten().flatten();
    names.extend(registries.map(|it| (Some(it.path()), "/crates")));
    names
        .into_iter()
        .filter_map(|(from, to)| Some(format!("--remap-path-prefix={}={to}", from?.to_str()?)))
        .collect()
}
