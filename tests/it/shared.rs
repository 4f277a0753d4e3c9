//! Mazes and recorded matches that do not belong to the repository.
//!
//! A test that needs them begins with
//! `#[cfg_attr(not(shared_material), ignore = "needs shared material: set WASMOUSE_SHARED")]`.

use std::fs;
use std::path::PathBuf;

/// The folder with the shared material: `$WASMOUSE_SHARED`, or `shared` beside the repository.
///
/// # Panics
///
/// When there was none when the tests were built (`build.rs`).
pub fn shared() -> PathBuf {
    let folder = option_env!("SHARED_MATERIAL");
    folder.expect("shared material: set WASMOUSE_SHARED").into()
}

/// A text file of the shared material.
pub fn shared_text(file: &str) -> String {
    let path = shared().join(file);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
