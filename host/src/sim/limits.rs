//! Every limit on what a robot can use, each with the attack that it stops.
//!
//! Plain numbers: the simulation itself needs none of them, the `robot` stage
//! enforces them all. They are part of the ruleset, because a verdict depends
//! on them.

use serde::{Deserialize, Serialize};

/// The limits of one match, and of the admission to it.
///
/// The defaults are wide enough for interpreted languages (a Python or
/// JavaScript robot takes 20,000 to 100,000 units of fuel for a simple step, a
/// compiled one about 70) and still end an endless loop within seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Limits {
    /// Size of the component file, in bytes. Stops files that exhaust the
    /// host's memory before anything is known about them. Default 32 MiB.
    pub component_bytes_max: u64,
    /// Fuel for instantiation (start functions, data segments), and again for
    /// the call of `start`. Stops endless loops before the first step.
    /// Default 2,000,000,000.
    pub start_fuel_max: u64,
    /// Fuel for one call of `next-move`. Stops endless loops in a step.
    /// Default 2,000,000,000.
    pub step_fuel_max: u64,
    /// Fuel for `start` and all steps of a match together. Stops robots that
    /// stay just under the step limit a thousand times. Default 20,000,000,000.
    pub match_fuel_max: u64,
    /// Linear memory of all instances of a match together, in bytes. Stops
    /// `memory.grow`, and many memories that are each just under a per-memory
    /// cap. Default 256 MiB.
    pub memory_bytes_max: u64,
    /// Table elements of all instances of a match together. Stops
    /// `table.grow`. Default 100,000.
    pub table_elements_max: u64,
    /// Wasm call stack, in bytes. Stops unbounded recursion. Default 512 KiB.
    pub stack_bytes_max: u64,
    /// Core instances in one component. Stops small files that instantiate
    /// exponentially. Default 64.
    pub core_instances_max: u32,
    /// Linear memories in one component. Default 8.
    pub memories_max: u32,
    /// Tables in one component. Default 16.
    pub tables_max: u32,
    /// Journal of a match, in bytes: 16 for each entry plus the length of its
    /// text. Stops robots that fill the host's memory with log lines. Later
    /// entries are dropped and counted. Default 1 MiB.
    pub journal_bytes_max: u64,
    /// Bytes that one call into the host may copy out of the robot. Stops a
    /// log line of gigabytes. Default 64 KiB.
    pub host_call_bytes_max: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            component_bytes_max: 32 << 20,
            start_fuel_max: 2_000_000_000,
            step_fuel_max: 2_000_000_000,
            match_fuel_max: 20_000_000_000,
            memory_bytes_max: 256 << 20,
            table_elements_max: 100_000,
            stack_bytes_max: 512 << 10,
            core_instances_max: 64,
            memories_max: 8,
            tables_max: 16,
            journal_bytes_max: 1 << 20,
            host_call_bytes_max: 64 << 10,
        }
    }
}
