//! [`Role`]: what a worker process is for, and what it may use.

use serde::{Deserialize, Serialize};

/// What a worker is for, which decides what it may still do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Reads and compiles one file; never runs its code.
    Compile,
    /// Runs compiled robots.
    Run,
    /// Compiles one robot and plays one match with it, for the backtrace of its fault.
    Backtrace,
}

impl Role {
    /// All roles.
    pub const ALL: [Self; 3] = [Self::Compile, Self::Run, Self::Backtrace];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Compile => "compile",
            Self::Run => "run",
            Self::Backtrace => "backtrace",
        }
    }
}

/// Address space of a compile worker, in bytes. The largest known robots (Python) take half
/// a gigabyte.
pub const COMPILE_MEMORY_BYTES: u64 = 2 << 30;

/// Processor time of a compile worker, in seconds, all threads together. The largest known
/// robots take 30 s on a slow machine.
pub const COMPILE_CPU_SECONDS: u64 = 120;

/// Which layers of the sandbox the operating system provides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SandboxStatus {
    /// No files, network or signals, by landlock.
    pub landlock: bool,
    /// No system calls but a few, by seccomp.
    pub seccomp: bool,
}

impl SandboxStatus {
    /// Whether every layer is there.
    pub const fn is_complete(self) -> bool {
        self.landlock && self.seccomp
    }

    /// The layers that are missing, for messages.
    pub const fn missing(self) -> &'static str {
        match (self.landlock, self.seccomp) {
            (false, false) => "landlock and no seccomp",
            (false, true) => "landlock",
            (true, false) => "seccomp",
            (true, true) => "missing layer",
        }
    }
}
