//! Automation for the repository: what `cargo xtask` does.
//!
//! A library, because the tests read the manifest of the prebuilt robots with
//! the code that writes it. Nothing here compiles robots: that is the work of
//! `wasmouse build`, and `xtask` runs it.

use std::path::{Path, PathBuf};

pub mod bindings;
pub mod corpus;
pub mod costs;
pub mod dist;
pub mod emulators;
pub mod fuzz;
pub mod languages;
pub mod manifest;
pub mod packages;
pub mod platforms;
pub mod reference;
pub mod robots;
pub mod sources;
pub mod step;
pub mod validators;
pub mod verify;
pub mod wasi;
pub mod web;

/// The root folder of the repository that this program was compiled in.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("xtask is a folder in the repository")
        .to_owned()
}
