//! [`Sizes`]: what one function that is compiled costs, estimated.
//!
//! The estimate ([`Sizes::work_ns`]) is a sum of terms with coefficients that were
//! measured with a release build of wasmtime 48 on one thread of a 2-core machine. Generators of
//! bad cases pushed one term at a time, every function of large robots was timed by itself, and the
//! coefficients are the least ones with which no generator by itself takes more than 0.85 of its
//! estimate. A build with debug assertions takes more: it checks what the compiler did, again with
//! time that grows with the square of a function. The terms that are products are the ones that make
//! small files dangerous; each names where in Cranelift it comes from.
//!
//! What one function leaves behind for the others is in `spills`.

use super::super::rejection::Rejection;
use super::flow::Joins;
use super::gauge::Gauge;
use super::measure::{Measure, NS_IN_MS};
use super::spills::Spills;
use super::values::Pressed;

/// What one function costs.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sizes {
    pub(super) bytes: u64,
    pub(super) locals: u64,
    pub(super) operands: u64,
    pub(super) blocks: u64,
    /// The depths of all blocks in the dominator tree together.
    pub(super) depths: u64,
    /// The depths of the blocks of all bytes together.
    pub(super) deep_bytes: u64,
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
    pub(super) pressed: Pressed,
}

/// The time to go past one argument, in ns. The loop is one of few instructions, and a release build of
/// the program takes 1.4 to 3.6 for it on both threads: that differs from build to build.
const SCAN: u64 = 5;

impl Sizes {
    /// Cells of Cranelift's table of the value of each variable in each block
    /// (`cranelift_frontend::ssa`): 4 bytes each, allocated up to the last block
    /// in which the variable is written. Measured: up to 15 bytes for each cell of a local, and up to
    /// 2 for other variables.
    pub(super) const fn cells(&self) -> u64 {
        (self.locals + self.typed).saturating_mul(self.blocks)
    }

    /// The estimated time to compile the function, in ns.
    pub(super) const fn work_ns(&self) -> u64 {
        let live = self.locals + self.operands;
        let spilled = if live < 400 { live } else { 400 };
        let joins = self.joins;
        let linear = 150_000
            + self.bytes * 400
            + self.simd * 40_000
            + self.accesses * 5_000
            + self.heavy * 15_000
            + self.blocks * 6_000
            + self.passed * 3_500
            + joins.joined * 3_000
            + joins.carried * 500;
        linear
            .saturating_add(self.cells().saturating_mul(4))
            // Walks up the dominator tree: from every edge to a join, and for every new value.
            .saturating_add(self.depths.saturating_mul(30))
            .saturating_add(self.deep_bytes / 4)
            // Every store, call and trap goes through the last stores to all regions, and
            // every block has a copy of them (`alias_analysis::LastStores`).
            .saturating_add(self.regions.saturating_mul(self.bytes) * 2)
            .saturating_add(self.regions.saturating_mul(self.blocks) * 4)
            // Live ranges that overlap (`regalloc2::ion`), and those of them that are
            // spilled.
            .saturating_add(
                max(self.bytes.saturating_mul(live), self.alive_bytes()).saturating_mul(10),
            )
            .saturating_add(self.bytes.saturating_mul(self.bytes) / 2_100 * spilled)
            .saturating_add(self.pressed.scans.saturating_mul(SCAN))
    }

    /// The values that are alive at each byte, together.
    const fn alive_bytes(&self) -> u64 {
        let Pressed {
            operators, alive, ..
        } = self.pressed;
        let operators = if operators > 0 { operators } else { 1 };
        alive.saturating_mul(self.bytes) / operators
    }

    /// What the allocator of registers does for it. Measured: 11 to 19 tries for each instruction that
    /// is made while registers are short, else about one; and as many conflicts as instructions where
    /// all registers but one are taken, a quarter where they are not. Values that are reused in all of a
    /// function have up to a third more of them than this.
    const fn spills(&self) -> Spills {
        let Pressed {
            pressed,
            made,
            passed_by,
            ..
        } = self.pressed;
        Spills {
            tries: pressed * 10 + made + self.passed * 5,
            conflicts: min(passed_by, pressed + passed_by / 4) * 7 / 10,
        }
    }

    /// The estimated memory to compile the function, in bytes. The coefficients are about 1.3 times the
    /// least ones with which no generator takes more.
    pub(super) const fn memory_bytes(&self) -> u64 {
        let linear = self.bytes * 150
            + self.simd * 8_000
            + self.heavy * 4_500
            + self.blocks * 4_000
            + self.accesses * 500
            + self.passed * 100
            + self.regions * 500
            + self.joins.joined * 5_000
            + self.joins.carried * 500
            + self.pressed.pressed * 600;
        linear
            // The rows of locals grow by turns, and what one grows out of is too small for the next.
            .saturating_add(self.locals.saturating_mul(self.blocks).saturating_mul(16))
            .saturating_add(self.typed.saturating_mul(self.blocks).saturating_mul(4))
            .saturating_add(self.regions.saturating_mul(self.blocks) * 16)
    }

    /// The estimated memory for the compiled function until the file is compiled, in bytes.
    const fn kept_bytes(&self) -> u64 {
        7_500
            + self.bytes * 20
            + self.heavy * 280
            + self.simd * 200
            + self.passed * 40
            + self.pressed.pressed * 120
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
        gauge.add_work(work_ns, byte)?;
        gauge.add_spills(self.spills(), byte)
    }
}

const fn min(a: u64, b: u64) -> u64 {
    if a < b { a } else { b }
}

const fn max(a: u64, b: u64) -> u64 {
    if a > b { a } else { b }
}
