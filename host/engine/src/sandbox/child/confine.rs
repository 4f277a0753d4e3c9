//! Sandbox setup: the privileges that a worker drops before it reads untrusted bytes.
//!
//! The order matters: descriptors and limits first, then whatever needs files or
//! threads (the engine), then landlock, which holds for the calling thread and those
//! it starts, then the threads, then seccomp for all of them.

#[cfg(target_os = "linux")]
pub use linux::{close_inherited, die_with_parent, forbid_files, forbid_system_calls};
#[cfg(unix)]
pub use unix::set_limits;

#[cfg(not(target_os = "linux"))]
mod elsewhere {
    use super::super::super::role::Role;

    /// Descriptors are closed by the standard library where it opened them.
    pub fn close_inherited() {}

    /// The worker notices when its input ends.
    pub fn die_with_parent() {}

    /// There is no landlock here.
    pub fn forbid_files() -> bool {
        false
    }

    /// There is no seccomp here.
    pub fn forbid_system_calls(_role: Role) -> bool {
        false
    }
}

#[cfg(not(target_os = "linux"))]
pub use elsewhere::{close_inherited, die_with_parent, forbid_files, forbid_system_calls};

/// There are no such limits here.
#[cfg(not(unix))]
pub fn set_limits(_role: Role) {}

#[cfg(target_os = "linux")]
#[path = "confine_linux.rs"]
mod linux;

#[cfg(unix)]
mod unix {
    use rustix::process::{Resource, Rlimit, setrlimit};

    /// The anonymous file with a robot's initial memory is a file to the kernel. No
    /// ruleset gives a robot more memory.
    const MEMORY_FILE_BYTES: u64 = 1 << 30;

    /// Memory that a worker with a pool may write, in bytes: a robot's, compiled code,
    /// and what a compiler takes.
    const RUN_MEMORY_BYTES: u64 = 4 << 30;

    use super::super::super::role::{COMPILE_CPU_SECONDS, COMPILE_MEMORY_BYTES, Role};

    /// Sets the resource limits of the process. A limit that cannot be set is skipped: each
    /// is a second line of defence.
    pub fn set_limits(role: Role) {
        // No core may be written, and few descriptors are needed.
        limit(Resource::Core, 0, 0);
        limit(Resource::Nofile, 64, 64);
        if role == Role::Compile {
            limit(Resource::Fsize, 0, 0);
            limit(Resource::As, COMPILE_MEMORY_BYTES, COMPILE_MEMORY_BYTES);
        } else {
            // A pool of instances reserves terabytes of address space without using
            // them, so what can be written is limited instead.
            limit(Resource::Fsize, MEMORY_FILE_BYTES, MEMORY_FILE_BYTES);
            limit(Resource::Data, RUN_MEMORY_BYTES, RUN_MEMORY_BYTES);
        }
        if role != Role::Run {
            // The first limit ends it by a signal of its own, which tells the
            // supervisor why; the second one kills.
            limit(Resource::Cpu, COMPILE_CPU_SECONDS, COMPILE_CPU_SECONDS + 5);
        }
    }

    fn limit(resource: Resource, current: u64, maximum: u64) {
        let limit = Rlimit {
            current: Some(current),
            maximum: Some(maximum),
        };
        // A lower limit that is already there may not be raised, and need not be.
        let _ = setrlimit(resource, limit);
    }
}
