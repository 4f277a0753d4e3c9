//! [`Backtraces`]: the code of a large robot for backtrace workers, from the cache if it is there.
//!
//! Code for backtraces is not the code of matches: it has address maps. It takes the same way: a
//! compile worker makes it, the supervisor moves it into the cache without looking into it, and a
//! worker loads it that compares its digest.

use wasmouse_core::Digest;
use wasmtime::Engine;

use super::compiler::{Compiler, Wanted};
use super::pool::Pool;
use crate::error::InfrastructureError;
use crate::runtime::{Cache, CacheEntry, CompiledCode};

/// Files smaller than this are compiled by the backtrace worker itself, which takes a fraction of a
/// second, and are not worth an entry. Interpreters have 1.6 MB and more.
const FILE_BYTES_MIN: usize = 1 << 20;

/// Where the code of a robot is found.
pub(super) struct Backtraces<'a> {
    pool: &'a Pool,
    entry: Option<CacheEntry<'a>>,
}

impl<'a> Backtraces<'a> {
    /// The code of that robot, for an engine for backtraces.
    pub(super) fn new(
        pool: &'a Pool,
        cache: Option<&'a Cache>,
        engine: &'a Engine,
        robot: Digest,
    ) -> Self {
        Self {
            pool,
            entry: cache.map(|it| it.entry(engine, &pool.limits, &robot)),
        }
    }

    /// The code of the file; `None` when there is no cache, the file is small, or the code cannot be
    /// kept or made, which the worker finds out again.
    ///
    /// # Errors
    ///
    /// When everything was cancelled.
    pub(super) fn code(&self, file: &[u8]) -> Result<Option<CompiledCode>, InfrastructureError> {
        let Some(entry) = self.entry.as_ref().filter(|_| file.len() >= FILE_BYTES_MIN) else {
            return Ok(None);
        };
        if let Some(code) = entry.open_code() {
            return Ok(Some(code));
        }
        let compiler = Compiler {
            starter: &self.pool.starter,
            limits: &self.pool.limits,
        };
        let wanted = Wanted {
            code: true,
            description: false,
            backtraces: true,
        };
        match compiler.examine(file, wanted, &|| entry.destination()) {
            Ok(Ok(findings)) => Ok(findings.code),
            Err(InfrastructureError::Cancelled) => Err(InfrastructureError::Cancelled),
            Ok(Err(_)) | Err(_) => Ok(None),
        }
    }

    /// Drops code that a worker could not use.
    pub(super) fn forget(&self) {
        if let Some(entry) = &self.entry {
            entry.forget_code();
        }
    }
}
