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

/// Memory that a compile worker may use, in bytes. The largest known robots (Python) take half
/// a gigabyte.
pub const COMPILE_MEMORY_BYTES: u64 = 2 << 30;

/// Memory that a worker that runs robots may use, in bytes: a robot's, compiled code, and, for a
/// backtrace, what a compiler takes.
pub const RUN_MEMORY_BYTES: u64 = 4 << 30;

/// Processor time of a compile worker, in seconds, all threads together. The largest known
/// robots take 30 s on a slow machine.
pub const COMPILE_CPU_SECONDS: u64 = 120;

/// Which layers of the sandbox a worker has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SandboxStatus {
    /// No files, network or signals, by landlock.
    pub landlock: bool,
    /// No system calls but a few, by seccomp.
    pub seccomp: bool,
    /// Namespaces of its own for processes, networks, IPC, mounts, host names and control groups;
    /// also for users, unless root had to do without.
    pub namespaces: bool,
    /// An empty root folder.
    pub empty_root: bool,
    /// No capabilities in any set.
    pub no_capabilities: bool,
    /// A control group of its own, or on Windows a job object, which limits memory and processes.
    pub control_group: bool,
}

impl SandboxStatus {
    /// What limits a worker as a whole on this system.
    const GROUP: &str = if cfg!(windows) {
        "job object"
    } else {
        "control group"
    };

    /// Whether the two layers are there that every supported kernel gives to every user. The
    /// others depend on how the system is set up (in containers, most are not to be had), and
    /// what they forbid, these two forbid as well.
    pub const fn is_complete(self) -> bool {
        self.landlock && self.seccomp
    }

    /// Of these two, those that are missing, for messages.
    pub const fn missing(self) -> &'static str {
        match (self.landlock, self.seccomp) {
            (false, false) => "landlock and no seccomp",
            (false, true) => "landlock",
            (true, false) => "seccomp",
            (true, true) => "missing layer",
        }
    }

    /// All layers by name, with whether they are there.
    pub const fn layers(self) -> [(&'static str, bool); 6] {
        [
            ("landlock", self.landlock),
            ("seccomp", self.seccomp),
            ("namespaces", self.namespaces),
            ("empty root", self.empty_root),
            ("no capabilities", self.no_capabilities),
            (Self::GROUP, self.control_group),
        ]
    }
}
