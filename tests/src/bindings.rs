//! [`generate`]: the Rust bindings of `wit/robot.wit`, which the SDK has in its sources.
//!
//! The SDK must not have dependencies, so that a robot builds in seconds and offline.
//! Therefore the bindings are generated ahead of time, by the generator behind the macro
//! `wit_bindgen::generate!`, and committed.

use std::path::{Path, PathBuf};

use wit_bindgen_core::wit_parser::Resolve;
use wit_bindgen_core::{Files, WorldGenerator as _};

/// The generated file, relative to the root of the repository.
pub const FILE: &str = "guest-sdk/src/bindings/generated.rs";

/// The command that writes [`FILE`].
pub const COMMAND: &str = "cargo xtask bindings";

/// The root folder of the repository that this program was compiled in.
///
/// # Panics
///
/// Never: the folder of this crate has a parent.
pub fn repository() -> PathBuf {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = tests.parent();
    root.expect("tests is a folder in the repository")
        .to_owned()
}

/// The bindings as a Rust source file.
///
/// # Errors
///
/// The reason why `wit`, the text of a WIT package, is not valid or has no world `robot`.
pub fn generate(wit: &str) -> Result<String, String> {
    let mut resolve = Resolve::default();
    let package = resolve
        .push_str("robot.wit", wit)
        .map_err(|error| format!("{error:#}"))?;
    let world = resolve
        .select_world(&[package], Some("robot"))
        .map_err(|error| format!("{error:#}"))?;
    let options = wit_bindgen_rust::Opts {
        format: true,
        runtime_path: Some("crate::bindings::runtime".into()),
        additional_derive_attributes: ["PartialEq", "Eq", "Hash", "PartialOrd", "Ord"]
            .map(str::to_owned)
            .into(),
        default_bindings_module: Some("wasmouse_sdk::bindings".into()),
        export_macro_name: Some("export".into()),
        pub_export_macro: true,
        ..wit_bindgen_rust::Opts::default()
    };
    let mut files = Files::default();
    options
        .build()
        .generate(&mut resolve, world, &mut files)
        .map_err(|error| format!("{error:#}"))?;
    let (_, source) = files.iter().next().ok_or("the generator wrote no file")?;
    let source = std::str::from_utf8(source).map_err(|error| error.to_string())?;
    Ok(format!(
        "//! Generated from `wit/robot.wit` by `{COMMAND}`. Do not edit.\n\n{source}"
    ))
}
