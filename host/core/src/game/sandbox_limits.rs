//! [`SandboxLimits`]: all limits on the resources of a running robot, each with the attack
//! that it stops.
//!
//! The engine enforces them. They are part of the ruleset because each can change a verdict.

use serde::{Deserialize, Serialize};

/// The limits of one match. Serialises as an object with these fields.
///
/// The defaults are the limits of compiled robots: high enough for a robot that computes a lot, and
/// they still end an endless loop within seconds. Interpreted languages have a
/// [class](super::FuelClass) of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SandboxLimits {
    /// Fuel for instantiation (start functions, data segments), and again for the call of
    /// `start`. Stops endless loops before the first step. Default 2,000,000,000.
    pub start_fuel_max: u64,
    /// Fuel for one call of `next-move`. Stops endless loops in a step. Default
    /// 2,000,000,000.
    pub step_fuel_max: u64,
    /// Fuel for `start` and all steps of a match together. Stops robots that stay just under
    /// the limit in each of a thousand steps. Default 20,000,000,000.
    pub match_fuel_max: u64,
    /// Linear memory of all instances of a match together, in bytes. Stops `memory.grow`, and
    /// many memories that are each just under a limit per memory. Default 256 MiB.
    pub memory_bytes_max: u64,
    /// Table elements of all instances of a match together. Stops `table.grow`. Default
    /// 100,000.
    pub table_elements_max: u64,
    /// Wasm call stack, in bytes. Stops unbounded recursion. Default 512 KiB.
    pub stack_bytes_max: u64,
    /// Journal of a match, in bytes: [`ENTRY_BYTES`](crate::journal::ENTRY_BYTES) for each
    /// entry plus the length of its text. Stops robots that fill the host's memory with log
    /// lines. Entries beyond it are dropped and counted. Default 1 MiB.
    pub journal_bytes_max: u64,
    /// Bytes that a single call into the host may copy from the robot. Stops log lines of
    /// gigabytes. Default 64 KiB.
    pub host_call_bytes_max: u64,
}

impl SandboxLimits {
    /// The limits for a canonical encoding, in the order of the fields.
    pub(super) const fn numbers(&self) -> [u64; 8] {
        let Self {
            start_fuel_max,
            step_fuel_max,
            match_fuel_max,
            memory_bytes_max,
            table_elements_max,
            stack_bytes_max,
            journal_bytes_max,
            host_call_bytes_max,
        } = *self;
        [
            start_fuel_max,
            step_fuel_max,
            match_fuel_max,
            memory_bytes_max,
            table_elements_max,
            stack_bytes_max,
            journal_bytes_max,
            host_call_bytes_max,
        ]
    }
}

impl Default for SandboxLimits {
    fn default() -> Self {
        Self {
            start_fuel_max: 2_000_000_000,
            step_fuel_max: 2_000_000_000,
            match_fuel_max: 20_000_000_000,
            memory_bytes_max: 256 << 20,
            table_elements_max: 100_000,
            stack_bytes_max: 512 << 10,
            journal_bytes_max: 1 << 20,
            host_call_bytes_max: 64 << 10,
        }
    }
}
