//! [`Limiter`]: memory and tables of one match, added up over all its instances.
//!
//! wasmtime's own `StoreLimits` counts each memory by itself, so a component
//! with many memories passes it; this one keeps one account for the store.
//! Growth beyond the limit traps, so that the verdict names the limit, instead
//! of letting the robot run on with a failed allocation. `memory.grow` and
//! `table.grow` return -1 in one case only: the module's own maximum forbids the
//! growth. Growth that the host cannot provide ends the match as a failure of the
//! host, because a robot that got -1 could play other moves.

use wasmouse_core::game::FaultKind;
use wasmtime::ResourceLimiter;

use crate::limits::Limits;

/// Why a growth was denied; carried through wasmtime as the error of the call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum LimitExceeded {
    /// Linear memory.
    #[error("exceeded the memory limit: requested {}, limit {}", size(*.asked), size(*.max))]
    Memory { asked: u64, max: u64 },
    /// Tables.
    #[error("exceeded the table limit: requested {asked} elements, limit {max}")]
    Table { asked: u64, max: u64 },
}

impl LimitExceeded {
    /// The fault of a robot that exceeds it.
    pub(crate) const fn fault(self) -> FaultKind {
        match self {
            Self::Memory { .. } => FaultKind::OutOfMemory,
            Self::Table { .. } => FaultKind::TableLimit,
        }
    }
}

/// A size for people: bytes below a mebibyte, else mebibytes, rounded up.
fn size(bytes: u64) -> String {
    match bytes {
        0..0x10_0000 => format!("{bytes} bytes"),
        _ => format!("{} MiB", bytes.div_ceil(1 << 20)),
    }
}

/// The account of one store.
#[derive(Debug)]
pub(crate) struct Limiter {
    memory_bytes: u64,
    memory_bytes_max: u64,
    table_elements: u64,
    table_elements_max: u64,
    memories_max: usize,
    tables_max: usize,
    instances_max: usize,
}

impl Limiter {
    pub(crate) fn new(limits: &Limits) -> Self {
        let to_usize = |count: u32| usize::try_from(count).expect("usize has at least 32 bits");
        Self {
            memory_bytes: 0,
            memory_bytes_max: limits.sandbox.memory_bytes_max,
            table_elements: 0,
            table_elements_max: limits.sandbox.table_elements_max,
            memories_max: to_usize(limits.admission.memories_max),
            tables_max: to_usize(limits.admission.tables_max),
            instances_max: to_usize(limits.admission.instances_max()),
        }
    }
}

impl Limiter {
    /// The linear memory of the store, in bytes.
    pub(crate) const fn memory_bytes(&self) -> u64 {
        self.memory_bytes
    }
}

/// The account after a growth, or `None` when the growth fails by the module's
/// own maximum; `Err` holds what was asked for when that passes `max`.
fn charge(
    account: u64,
    max: u64,
    current: usize,
    desired: usize,
    own_maximum: Option<usize>,
) -> Result<Option<u64>, u64> {
    let growth = u64::try_from(desired.saturating_sub(current)).unwrap_or(u64::MAX);
    let asked = account.saturating_add(growth);
    if asked > max {
        return Err(asked);
    }
    let possible = own_maximum.is_none_or(|maximum| desired <= maximum);
    Ok(possible.then_some(asked))
}

impl ResourceLimiter for Limiter {
    fn memory_growing(
        &mut self,
        current: usize,
        desired: usize,
        maximum: Option<usize>,
    ) -> wasmtime::Result<bool> {
        let max = self.memory_bytes_max;
        let charged = charge(self.memory_bytes, max, current, desired, maximum)
            .map_err(|asked| LimitExceeded::Memory { asked, max })?;
        self.memory_bytes = charged.unwrap_or(self.memory_bytes);
        Ok(charged.is_some())
    }

    fn memory_grow_failed(&mut self, error: wasmtime::Error) -> wasmtime::Result<()> {
        // Allowed by `memory_growing`, so by the limit and by the module.
        Err(error.context("failed to grow a linear memory"))
    }

    fn table_growing(
        &mut self,
        current: usize,
        desired: usize,
        maximum: Option<usize>,
    ) -> wasmtime::Result<bool> {
        let max = self.table_elements_max;
        let charged = charge(self.table_elements, max, current, desired, maximum)
            .map_err(|asked| LimitExceeded::Table { asked, max })?;
        self.table_elements = charged.unwrap_or(self.table_elements);
        Ok(charged.is_some())
    }

    fn table_grow_failed(&mut self, error: wasmtime::Error) -> wasmtime::Result<()> {
        // Allowed by `table_growing`.
        Err(error.context("failed to grow a table"))
    }

    fn instances(&self) -> usize {
        self.instances_max
    }

    fn tables(&self) -> usize {
        self.tables_max
    }

    fn memories(&self) -> usize {
        self.memories_max
    }
}

#[cfg(test)]
mod tests {
    use wasmouse_core::game::SandboxLimits;

    use super::*;

    fn limiter() -> Limiter {
        Limiter::new(&Limits::with_sandbox(SandboxLimits {
            memory_bytes_max: 100,
            table_elements_max: 10,
            ..SandboxLimits::default()
        }))
    }

    #[test]
    fn two_memories_share_one_account() {
        let mut limiter = limiter();
        assert!(limiter.memory_growing(0, 60, None).expect("60 of 100"));
        let error = limiter.memory_growing(0, 60, None).expect_err("120 of 100");
        assert_eq!(
            error.downcast_ref(),
            Some(&LimitExceeded::Memory {
                asked: 120,
                max: 100
            })
        );
        assert!(limiter.memory_growing(60, 90, None).expect("90 of 100"));
    }

    #[test]
    fn a_failed_growth_is_not_charged() {
        let mut limiter = limiter();
        assert!(
            !limiter
                .memory_growing(0, 80, Some(70))
                .expect("the module's own maximum")
        );
        assert!(limiter.memory_growing(0, 70, Some(70)).expect("70 of 100"));
        assert!(
            !limiter
                .table_growing(0, 8, Some(7))
                .expect("the module's own maximum")
        );
        assert!(limiter.table_growing(0, 7, Some(7)).expect("7 of 10"));
        assert!(limiter.table_growing(7, 11, None).is_err());
    }

    #[test]
    fn growth_that_was_allowed_and_fails_is_an_error() {
        let mut limiter = limiter();
        assert!(limiter.memory_growing(0, 60, None).expect("60 of 100"));
        let shortage = || wasmtime::Error::from(std::io::Error::from_raw_os_error(12));
        let error = limiter.memory_grow_failed(shortage()).expect_err("no -1");
        assert!(!error.is::<LimitExceeded>(), "{error:#}");
        let error = limiter.table_grow_failed(shortage()).expect_err("no -1");
        assert!(!error.is::<LimitExceeded>(), "{error:#}");
    }
}
