//! [`InfrastructureError`]: a failure that is not the robot's and never a score.

use std::io;
use std::path::PathBuf;

/// The host could not do its work. A match that ends so has no verdict and has to be played
/// again.
#[derive(Debug, thiserror::Error)]
pub enum InfrastructureError {
    /// wasmtime could not set up its engine.
    #[error("failed to set up the WebAssembly engine: {0}")]
    Engine(String),
    /// This machine's processor cannot run robots as others do.
    #[error("this processor cannot run robots: {0}")]
    Processor(String),
    /// A thread could not be started.
    #[error("failed to start a thread: {0}")]
    Thread(#[source] io::Error),
    /// Compiled code could not be loaded for a reason of the host.
    #[error("failed to load compiled code: {0}")]
    Load(String),
    /// A call into a robot failed for a reason of the host.
    #[error("failed to call the robot: {0}")]
    Call(String),
    /// A match took so long on the wall clock that the host must have stalled.
    #[error("a match did not end within {seconds} s of wall time")]
    Stalled {
        /// The limit.
        seconds: u64,
    },
    /// A match took too much processor time, although it had fuel left.
    #[error("a match did not end within {seconds} s of processor time")]
    Slow {
        /// The limit.
        seconds: u64,
    },
    /// The robot plays no more matches.
    #[error("the robot was withdrawn: {0}")]
    Withdrawn(Withdrawal),
    /// Everything was cancelled.
    #[error("cancelled")]
    Cancelled,
    /// A worker process could not do its work.
    #[error("{role} worker failed: {reason}")]
    Worker {
        /// Such as `compile` or `run`.
        role: &'static str,
        /// Its exit status, or what was wrong with what it sent.
        reason: String,
    },
    /// Compiled code could not be stored.
    #[error("failed to store compiled code: {0}")]
    Store(String),
    /// The operating system cannot sandbox workers completely, and that is required.
    #[error("this system cannot sandbox workers completely: it has no {missing}")]
    IncompleteSandbox {
        /// What it lacks.
        missing: &'static str,
    },
    /// The cache of compiled robots could not be used.
    #[error("failed to use the cache of compiled robots at `{}`: {reason}", path.display())]
    Cache {
        /// The folder or file.
        path: PathBuf,
        /// What went wrong.
        reason: String,
    },
    /// A robot was handed to an executor that did not admit it.
    #[error("the robot was admitted by another executor")]
    ForeignRobot,
}

/// Why a robot plays no more matches of a contest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Withdrawal {
    /// Matches did not end in time.
    #[error("{times} of its matches did not end in time")]
    Stalled {
        /// How many.
        times: u32,
    },
    /// It has no processor time left.
    #[error("it has used up its {seconds} s of processor time")]
    Spent {
        /// Its budget.
        seconds: u64,
    },
}

impl InfrastructureError {
    /// Whether a match did not end in time, which another try may change.
    pub const fn is_stall(&self) -> bool {
        matches!(self, Self::Stalled { .. } | Self::Slow { .. })
    }

    /// Whether trying again at once cannot help.
    pub(crate) const fn is_final(&self) -> bool {
        self.is_stall() || matches!(self, Self::Withdrawn(_) | Self::Cancelled)
    }

    #[expect(
        clippy::needless_pass_by_value,
        reason = "used as a function in map_err"
    )]
    pub(crate) fn engine(error: wasmtime::Error) -> Self {
        Self::Engine(format!("{error:#}"))
    }

    pub(crate) fn call(error: &wasmtime::Error) -> Self {
        Self::Call(format!("{error:#}"))
    }
}
