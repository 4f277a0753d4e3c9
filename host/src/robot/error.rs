//! [`HostError`]: a failure that is not the robot's and never a score.

use std::io;
use std::path::PathBuf;

use super::worker::Sandbox;

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
    /// A worker process could not do its work.
    #[error("the worker that should {role} failed: {reason}")]
    Worker {
        /// `compile` or `play`.
        role: &'static str,
        /// How it ended, or what was wrong with what it said.
        reason: String,
    },
    /// There is no room for compiled code.
    #[error("failed to keep compiled code: {0}")]
    Room(String),
    /// The operating system cannot confine workers, and that is required.
    #[error("this system cannot confine workers completely: it has no {}", missing(*.0))]
    Unconfined(Sandbox),
    /// The cache of compiled robots could not be used.
    #[error("failed to use the cache of compiled robots at `{}`: {reason}", path.display())]
    Cache {
        /// The folder or file.
        path: PathBuf,
        /// What went wrong.
        reason: String,
    },
}

fn missing(sandbox: Sandbox) -> &'static str {
    match (sandbox.landlock, sandbox.seccomp) {
        (false, false) => "landlock and no seccomp",
        (false, true) => "landlock",
        (true, _) => "seccomp",
    }
}

impl HostError {
    /// A robot is played where it was not admitted.
    pub(super) fn stranger() -> Self {
        Self::Call("it was admitted by another referee".into())
    }

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
