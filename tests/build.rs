//! Says what is there that does not belong to the repository: tests that need something else
//! are reported as ignored.
//!
//! - `cfg(shared_material)`: the shared mazes and recorded matches.
//! - `cfg(html_validator)`: the program `html-validate` of the npm package of that name, in
//!   `WASMOUSE_HTML_VALIDATE` or in `PATH`.

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
    find_html_validator();
}

fn find_html_validator() {
    println!("cargo::rustc-check-cfg=cfg(html_validator)");
    println!("cargo::rerun-if-env-changed=WASMOUSE_HTML_VALIDATE");
    // Not when `PATH` changes: it differs between terminals, and tests take long to build.
    let program = env::var_os("WASMOUSE_HTML_VALIDATE")
        .map(PathBuf::from)
        .or_else(|| {
            let path = env::var_os("PATH")?;
            let programs = env::split_paths(&path).map(|folder| folder.join("html-validate"));
            programs.into_iter().find(|program| program.is_file())
        });
    if let Some(program) = program {
        println!("cargo::rustc-cfg=html_validator");
        println!("cargo::rustc-env=HTML_VALIDATOR={}", program.display());
    }
}
