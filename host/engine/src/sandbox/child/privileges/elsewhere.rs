//! Systems without landlock and seccomp: nothing is forbidden, and the supervisor reports it.

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
