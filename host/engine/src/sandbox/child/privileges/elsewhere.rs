//! Systems without landlock, seccomp and namespaces: nothing is forbidden, and the supervisor
//! reports it.

use std::io;

use super::super::super::role::{Role, SandboxStatus};

/// Whether this process has namespaces of its own: never.
#[derive(Clone, Copy, Debug)]
pub struct Isolation;

/// Descriptors are closed by the standard library where it opened them.
pub fn close_inherited() {}

/// The worker notices when its input ends.
pub fn die_with_parent() {}

/// There are no namespaces here.
///
/// # Errors
///
/// None.
pub fn isolate() -> io::Result<Isolation> {
    Ok(Isolation)
}

/// There is no landlock here, and there are no capabilities.
pub fn confine(_isolation: Isolation) -> SandboxStatus {
    SandboxStatus::default()
}

/// There is no seccomp here.
pub fn forbid_system_calls(_role: Role) -> bool {
    false
}
