//! [`cargo_home`]: the folder of cargo.

use std::env;
use std::path::PathBuf;

/// Where cargo keeps the sources of dependencies, and its configuration for all projects.
pub fn cargo_home() -> Option<PathBuf> {
    env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(env::home_dir()?.join(".cargo")))
}
