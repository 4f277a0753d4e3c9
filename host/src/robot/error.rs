//! [`HostError`]: a failure that is not the robot's and never a score.

use std::io;
use std::path::PathBuf;

/// The host failed. A match that ends so has to be run again.
#[derive(Debug, thiserror::Error)]
pub enum HostError {
    /// wasmtime could not set up its engine.
    #[error("failed to set up the WebAssembly engine: {0}")]
    Engine(String),
    /// A thread could not be started.
    #[error("failed to start a thread: {0}")]
    Thread(#[source] io::Error),
    /// A call into a robot failed for a reason of the host.
    #[error("failed to call the robot: {0}")]
    Call(String),
    /// A match took so long on the wall clock that the host must have stood still.
    #[error(
        "a match did not end within {} s on the wall clock",
        super::engine::MATCH_SECONDS_MAX
    )]
    Stalled,
    /// The cache of compiled robots could not be used.
    #[error("failed to use the cache of compiled robots at `{}`: {reason}", path.display())]
    Cache {
        /// The folder or file.
        path: PathBuf,
        /// What went wrong.
        reason: String,
    },
}

impl HostError {
    #[expect(
        clippy::needless_pass_by_value,
        reason = "used as a function in map_err"
    )]
    pub(super) fn engine(error: wasmtime::Error) -> Self {
        Self::Engine(format!("{error:#}"))
    }

    pub(super) const fn thread(error: io::Error) -> Self {
        Self::Thread(error)
    }

    pub(super) fn call(error: &wasmtime::Error) -> Self {
        Self::Call(format!("{error:#}"))
    }
}
