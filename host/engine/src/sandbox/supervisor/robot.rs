//! [`SandboxedRobot`]: a robot that runs in workers.

use std::sync::Arc;

use wasmouse_core::Digest;

use crate::admission::ResourceRequirements;
use crate::runtime::{CacheUse, CompiledCode};
use crate::time::Account;

/// A robot that was admitted to run in workers. This process holds a file with its compiled
/// code, and never loads it.
pub struct SandboxedRobot {
    pub(super) digest: Digest,
    pub(super) code: Arc<CompiledCode>,
    pub(super) cache: CacheUse,
    pub(super) requirements: Option<ResourceRequirements>,
    pub(super) account: Arc<Account>,
}

impl SandboxedRobot {
    /// The digest of the file that was admitted.
    pub const fn digest(&self) -> &Digest {
        &self.digest
    }

    /// Where its compiled code came from.
    pub const fn cache_use(&self) -> &CacheUse {
        &self.cache
    }

    /// What it requires before it does anything.
    pub const fn requirements(&self) -> Option<ResourceRequirements> {
        self.requirements
    }

    /// The processor time that it has used.
    pub const fn account(&self) -> &Arc<Account> {
        &self.account
    }
}
