//! Sets `cfg(shared_material)` where the shared mazes and recorded matches are available, which do
//! not belong to the repository. Tests that need them are reported as ignored elsewhere.

use std::env;
use std::path::PathBuf;

fn main() {
    println!("cargo::rustc-check-cfg=cfg(shared_material)");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=WASMOUSE_SHARED");
    let folder = match env::var_os("WASMOUSE_SHARED") {
        Some(folder) => PathBuf::from(folder),
        None => [env!("CARGO_MANIFEST_DIR"), "../../shared"]
            .iter()
            .collect(),
    };
    if folder.is_dir() {
        println!("cargo::rustc-cfg=shared_material");
        println!("cargo::rustc-env=SHARED_MATERIAL={}", folder.display());
    }
}
