//! Systems without resource limits.

use super::super::super::role::Role;

/// There are no such limits here.
pub fn set_limits(_role: Role) {}
