//! [`Sizes`]: what one function that is compiled costs, estimated.
//!
//! The estimate ([`Sizes::work_ns`]) is a sum of terms with coefficients that were
//! measured with wasmtime 48 on a 2-core machine: generators of bad cases pushed one
//! term at a time, and every coefficient was at or above what was found there. On a slower
//! machine the worst known file takes 1.2 times its estimate. The terms
//! that are products are the ones that make small files dangerous; each names where
//! in Cranelift it comes from.

use super::super::rejection::Rejection;
use super::flow::Joins;
use super::measure::{Gauge, Measure, NS_IN_MS};

/// What one function costs.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sizes {
    pub(super) bytes: u64,
    pub(super) locals: u64,
    pub(super) operands: u64,
    pub(super) blocks: u64,
    /// Values that blocks and branches are typed with: each becomes a variable.
    pub(super) typed: u64,
    /// SIMD operators, some of which become dozens of machine instructions.
    pub(super) simd: u64,
    /// Loads and stores, each with its check of bounds.
    pub(super) accesses: u64,
    /// Other operators that become many machine instructions.
    pub(super) heavy: u64,
    pub(super) joins: Joins,
    /// Globals that the function accesses, each a region of memory of its own.
    pub(super) regions: u64,
    /// Parameters and results of calls, beyond a few each; more for those on the stack.
    pub(super) passed: u64,
}

impl Sizes {
    /// Cells of Cranelift's table of the value of each variable in each block
    /// (`cranelift_frontend::ssa`): 4 to 8 bytes each, allocated up to the last block
    /// in which the variable is written.
    pub(super) const fn cells(&self) -> u64 {
        (self.locals + self.typed).saturating_mul(self.blocks)
    }

    /// The estimated time to compile the function, in ns.
    pub(super) const fn work_ns(&self) -> u64 {
        let live = self.locals + self.operands;
        let spilled = if live < 400 { live } else { 400 };
        let joins = self.joins;
        let linear = 160_000
            + self.bytes * 550
            + self.simd * 40_000
            + self.accesses * 6_000
            + self.heavy * 15_000
            + self.blocks * 10_000
            + self.passed * 3_500
            + joins.joined * 4_000
            + joins.carried * 500;
        linear
            .saturating_add(self.cells().saturating_mul(6))
            // Walks up the dominator tree, for every instruction of a deep one
            // (`regalloc2::domtree::dominates`, `EgraphPass::depth_of_block_in_gvn_map`).
            .saturating_add(self.blocks.saturating_mul(self.blocks) * 11)
            .saturating_add(self.blocks.saturating_mul(self.bytes) / 10)
            // Every store, call and trap goes through the last stores to all regions, and
            // every block has a copy of them (`alias_analysis::LastStores`).
            .saturating_add(self.regions.saturating_mul(self.bytes) * 4)
            .saturating_add(self.regions.saturating_mul(self.blocks) * 8)
            // Live ranges that overlap (`regalloc2::ion`), and those of them that are
            // spilled.
            .saturating_add(self.bytes.saturating_mul(live) * 16)
            .saturating_add(self.bytes.saturating_mul(self.bytes) / 7_000 * spilled)
            // `blockparam_ins` is scanned from its beginning for every live range
            // (`regalloc2::ion::moves`).
            .saturating_add(joins.carried.saturating_mul(joins.carried) * 2)
    }

    /// The estimated memory to compile the function, in bytes.
    pub(super) const fn memory_bytes(&self) -> u64 {
        let linear = self.bytes * 200
            + self.simd * 8_000
            + self.heavy * 3_000
            + self.blocks * 10_000
            + self.joins.joined * 1_000
            + self.joins.carried * 500;
        linear
            .saturating_add(self.cells().saturating_mul(4))
            .saturating_add(self.regions.saturating_mul(self.blocks) * 16)
    }

    /// The estimated memory for the compiled function until the file is compiled, in bytes.
    const fn kept_bytes(&self) -> u64 {
        5_500 + self.bytes * 20 + self.heavy * 100 + self.simd * 200 + self.passed * 40
    }

    /// Compares the estimates with the limits, and adds them to those of the file.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`].
    pub(super) fn note(&self, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
        let memory_bytes = self.memory_bytes();
        gauge.note(Measure::FunctionMemory, memory_bytes >> 20, byte)?;
        gauge.add_memory(self.kept_bytes(), memory_bytes, byte)?;
        let work_ns = self.work_ns();
        gauge.note(Measure::FunctionWork, work_ns / NS_IN_MS, byte)?;
        gauge.add_work(work_ns, byte)
    }
}
