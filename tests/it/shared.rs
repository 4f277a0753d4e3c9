//! Mazes, reports and vectors that do not belong to the repository.

use std::env;
use std::path::{Path, PathBuf};

/// The folder with the shared material: the environment variable
/// `WASMOUSE_SHARED`, or `shared` beside the repository. `None`, with a line
/// on standard error, where there is none.
pub fn shared() -> Option<PathBuf> {
    let folder = match env::var_os("WASMOUSE_SHARED") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"),
    };
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no shared material at {}", folder.display());
    None
}
