//! What runs wasmouse elsewhere: release archives, installers, workflows, and the scripts for
//! graders. The services themselves are not there; their files and variables are.

/// The archives of a release.
mod archives;
/// The scripts for GitHub's runner, Gradescope and clusters, run for real.
#[cfg(unix)]
mod graders;
/// `install.sh` against good and bad folders of archives.
#[cfg(unix)]
mod installer;
/// Workflows and other YAML, and the commands in them.
mod workflows;

use std::path::PathBuf;

/// A file of the repository.
fn repository_file(path: &str) -> PathBuf {
    xtask::repository().join(path)
}
