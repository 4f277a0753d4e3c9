//! One function of a core module: validated, and measured by what Cranelift would
//! have to do for it.
//!
//! The estimate ([`Sizes::work_ns`]) is a sum of terms with coefficients that were
//! measured with wasmtime 48 on a 2-core machine: generators of bad cases pushed one
//! term at a time, and every coefficient is at or above what was found. The terms
//! that are products are the ones that make small files dangerous; each names where
//! in Cranelift it comes from.

use wasmparser::{
    BinaryReader, BlockType, BrTable, CompositeInnerType, FrameKind, FuncToValidate, FuncValidator,
    FuncValidatorAllocations, FunctionBody, Operator, ValidatorResources, WasmModuleResources,
};

use super::super::rejection::Rejection;
use super::flow::{Construct, Flow, Joins};
use super::measure::{Gauge, Measure};

const NS_IN_MS: u64 = 1_000_000;

/// What one function costs.
#[derive(Clone, Copy, Debug, Default)]
struct Sizes {
    bytes: u64,
    locals: u64,
    operands: u64,
    blocks: u64,
    /// Values that blocks and branches are typed with: each becomes a variable.
    typed: u64,
    /// SIMD operators, some of which become dozens of machine instructions.
    simd: u64,
    /// Loads and stores, each with its check of bounds.
    accesses: u64,
    /// Other operators that become many machine instructions.
    heavy: u64,
    joins: Joins,
}

/// What an operator becomes, by its first byte.
enum Weight {
    Plain,
    Access,
    /// Calls, floating point (NaN is made canonical after every operator),
    /// conversions, growth, bulk memory and tables.
    Heavy,
    Simd,
}

impl Weight {
    const fn of(first_byte: u8) -> Self {
        match first_byte {
            0xfd => Self::Simd,
            0x28..=0x3e => Self::Access,
            0x10..=0x15 | 0x25 | 0x26 | 0x3f | 0x40 | 0x8b..=0xbf | 0xfc => Self::Heavy,
            _ => Self::Plain,
        }
    }
}

impl Sizes {
    /// Cells of Cranelift's table of the value of each variable in each block
    /// (`cranelift_frontend::ssa`): 4 to 8 bytes each, allocated up to the last block
    /// in which the variable is written.
    const fn cells(&self) -> u64 {
        (self.locals + self.typed).saturating_mul(self.blocks)
    }

    /// The estimated time to compile the function, in ns.
    const fn work_ns(&self) -> u64 {
        let live = self.locals + self.operands;
        let spilled = if live < 400 { live } else { 400 };
        let joins = self.joins;
        let linear = 180_000
            + self.bytes * 500
            + self.simd * 40_000
            + self.accesses * 6_000
            + self.heavy * 15_000
            + self.blocks * 10_000
            + joins.joined * 4_000
            + joins.carried * 500;
        linear
            .saturating_add(self.cells().saturating_mul(6))
            // Walks up the dominator tree, for every instruction of a deep one
            // (`regalloc2::domtree::dominates`, `EgraphPass::depth_of_block_in_gvn_map`).
            .saturating_add(self.blocks.saturating_mul(self.blocks) * 9)
            .saturating_add(self.blocks.saturating_mul(self.bytes) / 10)
            // Live ranges that overlap (`regalloc2::ion`), and those of them that are
            // spilled.
            .saturating_add(self.bytes.saturating_mul(live) * 4)
            .saturating_add(self.bytes.saturating_mul(self.bytes) / 10_000 * spilled)
            // `blockparam_ins` is scanned from its beginning for every live range
            // (`regalloc2::ion::moves`).
            .saturating_add(joins.carried.saturating_mul(joins.carried) * 2)
    }

    /// The estimated memory to compile the function, in bytes.
    const fn memory_bytes(&self) -> u64 {
        let linear = self.bytes * 200
            + self.simd * 8_000
            + self.heavy * 3_000
            + self.blocks * 10_000
            + self.joins.joined * 1_000
            + self.joins.carried * 500;
        linear.saturating_add(self.cells().saturating_mul(4))
    }
}

/// What is kept from function to function.
#[derive(Default)]
pub(super) struct Functions {
    allocations: FuncValidatorAllocations,
    flow: Flow,
    targets: Vec<u32>,
    /// The estimate for all functions so far.
    work_ns: u64,
}

impl Functions {
    /// Validates and measures one function; its estimate is added to that of the
    /// file.
    ///
    /// # Errors
    ///
    /// [`Rejection::Invalid`] and [`Rejection::OverLimit`].
    pub(super) fn check(
        &mut self,
        function: FuncToValidate<ValidatorResources>,
        body: &FunctionBody<'_>,
        gauge: &mut Gauge<'_>,
    ) -> Result<(), Rejection> {
        let range = body.range();
        let bytes = range.end - range.start;
        gauge.note(Measure::FunctionBytes, bytes, range.start)?;
        let results = function
            .resources
            .sub_type_at(function.ty)
            .map_or(0, |ty| arity_of(&ty.composite_type.inner).1);
        let allocations = std::mem::take(&mut self.allocations);
        let mut validator = function.into_validator(allocations);
        let mut reader = body.get_binary_reader();
        validator.read_locals(&mut reader)?;
        reader.set_features(*validator.features());
        let locals = validator.len_locals();
        gauge.note(Measure::Locals, locals.into(), range.start)?;
        self.flow.begin(locals, results);
        let mut function = Function {
            validator,
            flow: &mut self.flow,
            targets: &mut self.targets,
            gauge,
            sizes: Sizes {
                bytes,
                locals: locals.into(),
                ..Sizes::default()
            },
        };
        function.operators(&mut reader)?;
        let work_ns = function.finish(range.start)?;
        self.allocations = function.validator.into_allocations();
        self.work_ns = self.work_ns.saturating_add(work_ns);
        gauge.note(Measure::Work, self.work_ns / NS_IN_MS, range.start)
    }
}

/// A function while its operators are read.
struct Function<'a, 'l> {
    validator: FuncValidator<ValidatorResources>,
    flow: &'a mut Flow,
    targets: &'a mut Vec<u32>,
    gauge: &'a mut Gauge<'l>,
    sizes: Sizes,
}

impl Function<'_, '_> {
    fn operators(&mut self, reader: &mut BinaryReader<'_>) -> Result<(), Rejection> {
        while !reader.eof() {
            let byte = reader.original_position();
            match Weight::of(reader.clone().read_u8()?) {
                Weight::Plain => {}
                Weight::Access => self.sizes.accesses += 1,
                Weight::Heavy => self.sizes.heavy += 1,
                Weight::Simd => self.sizes.simd += 1,
            }
            let operator = reader.peek_operator(&self.validator.visitor(byte))?;
            // Before it is validated, which for some takes long.
            self.operator(&operator, byte)?;
            reader.visit_operator(&mut self.validator.visitor(byte))??;
            let operands = u64::from(self.validator.operand_stack_height());
            if operands > self.sizes.operands {
                self.sizes.operands = operands;
                self.gauge.note(Measure::Operands, operands, byte)?;
            }
        }
        let end = reader.original_position();
        reader.finish_expression(&self.validator.visitor(end))?;
        Ok(())
    }

    fn operator(&mut self, operator: &Operator<'_>, byte: u64) -> Result<(), Rejection> {
        match operator {
            Operator::Block { blockty } => self.open(Construct::Block, *blockty, 1, byte)?,
            // A loop checks fuel and epoch.
            Operator::Loop { blockty } => self.open(Construct::Loop, *blockty, 4, byte)?,
            Operator::If { blockty } => self.open(Construct::If, *blockty, 3, byte)?,
            Operator::Else => self.flow.otherwise(),
            Operator::End => self.flow.close(),
            Operator::Br { relative_depth } => {
                self.branch(*relative_depth);
                self.flow.jump(*relative_depth);
            }
            Operator::BrIf { relative_depth } => {
                self.branch(*relative_depth);
                self.flow.fork(*relative_depth);
            }
            Operator::BrTable { targets } => self.table(targets, byte)?,
            Operator::Return | Operator::Unreachable | Operator::ReturnCall { .. } => {
                self.flow.leave();
            }
            Operator::ReturnCallIndirect { .. } => {
                self.sizes.blocks += 2;
                self.flow.leave();
            }
            // A table is filled lazily: the entry may have to be made first.
            Operator::CallIndirect { .. }
            | Operator::TableGet { .. }
            | Operator::TableSet { .. } => self.sizes.blocks += 2,
            Operator::LocalGet { local_index } => self.flow.read(*local_index),
            Operator::LocalSet { local_index } | Operator::LocalTee { local_index } => {
                self.flow.write(*local_index);
            }
            _ => {}
        }
        // Now, because the record of the function grows with it.
        self.gauge.note(Measure::Cells, self.sizes.cells(), byte)?;
        self.gauge.note(Measure::Blocks, self.sizes.blocks, byte)
    }

    fn open(
        &mut self,
        construct: Construct,
        ty: BlockType,
        blocks: u64,
        byte: u64,
    ) -> Result<(), Rejection> {
        let (parameters, results) = self.arity(ty);
        self.sizes.blocks += blocks;
        self.sizes.typed += parameters + results;
        let label = match construct {
            Construct::Loop => parameters,
            Construct::Block | Construct::If => results,
        };
        self.flow.open(construct, label);
        let nesting = u64::from(self.validator.control_stack_height());
        self.gauge.note(Measure::Nesting, nesting, byte)?;
        self.gauge
            .note(Measure::LoopNesting, self.flow.loops().into(), byte)
    }

    /// A branch to a label: the block after it, and one on the edge.
    fn branch(&mut self, label: u32) {
        self.sizes.blocks += 2;
        self.sizes.typed += self.label_values(label);
    }

    fn table(&mut self, table: &BrTable<'_>, byte: u64) -> Result<(), Rejection> {
        self.gauge
            .note(Measure::BranchTargets, table.len().into(), byte)?;
        self.targets.clear();
        self.targets.push(table.default());
        for target in table.targets() {
            self.targets.push(target?);
        }
        // Equal targets share an edge.
        self.targets.sort_unstable();
        self.targets.dedup();
        self.flow.leave();
        let values = self.label_values(table.default());
        for &target in &*self.targets {
            self.sizes.blocks += 1;
            self.sizes.typed += values;
            self.flow.fork(target);
        }
        Ok(())
    }

    /// Parameters and results.
    fn arity(&self, ty: BlockType) -> (u64, u64) {
        match ty {
            BlockType::Empty => (0, 0),
            BlockType::Type(_) => (0, 1),
            BlockType::FuncType(index) => self
                .validator
                .resources()
                .sub_type_at(index)
                .map_or((0, 0), |ty| arity_of(&ty.composite_type.inner)),
        }
    }

    /// Values that a branch to the label takes along.
    fn label_values(&self, label: u32) -> u64 {
        let Ok(label) = usize::try_from(label) else {
            return 0;
        };
        self.validator.get_control_frame(label).map_or(0, |frame| {
            let (parameters, results) = self.arity(frame.block_type);
            match frame.kind {
                FrameKind::Loop => parameters,
                _ => results,
            }
        })
    }

    /// The estimated time to compile the function, in ns.
    fn finish(&mut self, byte: u64) -> Result<u64, Rejection> {
        self.sizes.joins = self.flow.count();
        let carried = self.sizes.joins.carried;
        self.gauge.note(Measure::Carried, carried, byte)?;
        let memory_mib = self.sizes.memory_bytes() >> 20;
        self.gauge.note(Measure::FunctionMemory, memory_mib, byte)?;
        let work_ns = self.sizes.work_ns();
        self.gauge
            .note(Measure::FunctionWork, work_ns / NS_IN_MS, byte)?;
        Ok(work_ns)
    }
}

/// Parameters and results of a function type.
pub(super) fn arity_of(ty: &CompositeInnerType) -> (u64, u64) {
    let count = |types: &[wasmparser::ValType]| u64::try_from(types.len()).unwrap_or(u64::MAX);
    match ty {
        CompositeInnerType::Func(ty) => (count(ty.params()), count(ty.results())),
        _ => (0, 0),
    }
}
