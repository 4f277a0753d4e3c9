//! Resource limits of the process, by the operating system.

use rustix::process::{Resource, Rlimit, setrlimit};

use super::super::super::role::{
    COMPILE_CPU_SECONDS, COMPILE_MEMORY_BYTES, RUN_MEMORY_BYTES, Role,
};

/// The anonymous file with a robot's initial memory is a file to the kernel. No
/// ruleset gives a robot more memory.
const MEMORY_FILE_BYTES: u64 = 1 << 30;

/// Sets the resource limits of the process. A limit that cannot be set is skipped: each
/// is a second line of defence.
pub fn set_limits(role: Role) {
    // No core may be written, and few descriptors are needed.
    limit(Resource::Core, 0, 0);
    limit(Resource::Nofile, 64, 64);
    // Elsewhere this counts threads, or all processes of the user; workers of Linux have namespaces
    // and filters instead.
    #[cfg(target_os = "macos")]
    limit(Resource::Nproc, 0, 0);
    // What can be written is limited, and not the address space: a pool of instances reserves
    // terabytes of that without using them, and an allocator reserves some for each thread.
    let (file, data) = match role {
        Role::Compile => (0, COMPILE_MEMORY_BYTES),
        Role::Run | Role::Backtrace => (MEMORY_FILE_BYTES, RUN_MEMORY_BYTES),
    };
    limit(Resource::Fsize, file, file);
    limit(Resource::Data, data, data);
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
