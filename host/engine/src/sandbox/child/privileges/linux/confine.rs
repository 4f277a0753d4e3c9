//! [`confine`]: the layers that threads inherit, in their order.

use rustix::fs::Mode;
use rustix::process::{DumpableBehavior, chdir, set_dumpable_behavior, umask};

use super::super::super::super::role::SandboxStatus;
use super::namespaces::Isolation;
use super::{capabilities, files, root};

/// Forbids files, sockets and signals to other processes, and drops all capabilities, for this
/// thread and those it starts. The process must have no other threads yet.
pub fn confine(isolation: Isolation) -> SandboxStatus {
    let empty_root = isolation.0 && root::replace();
    // Where the root stays as it is, at least no folder of the user's stays in use.
    let _ = chdir("/");
    umask(Mode::RWXU | Mode::RWXG | Mode::RWXO);
    let landlock = files::forbid();
    let no_capabilities = capabilities::drop_all();
    // Processes of the same user may not read its memory either.
    let _ = set_dumpable_behavior(DumpableBehavior::NotDumpable);
    SandboxStatus {
        landlock,
        seccomp: false,
        namespaces: isolation.0,
        empty_root,
        no_capabilities,
        control_group: false,
    }
}
