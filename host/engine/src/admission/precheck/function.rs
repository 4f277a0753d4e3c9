//! One function of a core module: validated, and measured by what Cranelift would
//! have to do for it ([`Sizes`]).

use wasmparser::{
    BinaryReader, BlockType, BrTable, CompositeInnerType, FrameKind, FuncToValidate, FuncValidator,
    FuncValidatorAllocations, FunctionBody, Operator, ValType, ValidatorResources,
    WasmModuleResources,
};

use super::super::rejection::Rejection;
use super::cost::Sizes;
use super::depth::Depth;
use super::flow::{Construct, Flow};
use super::gauge::Gauge;
use super::measure::Measure;
use super::pressure::{Loads, Pressure};

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

    /// About the machine instructions that it becomes.
    const fn instructions(&self) -> u32 {
        match self {
            Self::Plain => 1,
            Self::Access => 2,
            Self::Heavy => 6,
            Self::Simd => 10,
        }
    }
}

/// Validating a branch takes time for each value that it carries, and so does each target of a
/// `br_table`, equal or not. Far above that time, because it passes before anything is compiled.
const BRANCH_VALUE_NS: u64 = 200;

/// Parameters and results of a call that its own weight includes.
const PASSED_FREE: u64 = 2;

/// Parameters and results of a call that are in registers, about.
const PASSED_IN_REGISTERS: u64 = 16;

/// The globals that one function accesses.
#[derive(Debug, Default)]
struct Regions {
    /// For each global the last function that accesses it.
    last: Vec<u32>,
    function: u32,
}

impl Regions {
    /// Begins a function.
    const fn begin(&mut self) {
        self.function += 1;
    }

    /// Returns 1 if the function has not accessed the global before, else 0.
    fn access(&mut self, global: u32) -> u64 {
        let Ok(global) = usize::try_from(global) else {
            return 0;
        };
        // What is out of range is rejected by validation, not here.
        if global > GLOBALS_MAX {
            return 0;
        }
        if global >= self.last.len() {
            self.last.resize(global + 1, 0);
        }
        let is_new = self.last[global] != self.function;
        self.last[global] = self.function;
        u64::from(is_new)
    }
}

/// More globals than validation admits.
const GLOBALS_MAX: usize = 1_000_000;

/// What is kept from function to function.
#[derive(Default)]
pub(super) struct Functions {
    allocations: FuncValidatorAllocations,
    flow: Flow,
    depth: Depth,
    targets: Vec<u32>,
    regions: Regions,
    pressures: [Pressure; 2],
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
        let (parameters, results) = function
            .resources
            .sub_type_at(function.ty)
            .map_or((0, 0), |ty| arity_of(&ty.composite_type.inner));
        let allocations = std::mem::take(&mut self.allocations);
        let mut validator = function.into_validator(allocations);
        let mut reader = body.get_binary_reader();
        validator.read_locals(&mut reader)?;
        reader.set_features(*validator.features());
        let locals = validator.len_locals();
        gauge.note(Measure::Locals, locals.into(), range.start)?;
        self.flow.begin(locals, results);
        self.depth.begin();
        self.regions.begin();
        for (pressure, loads) in self.pressures.iter_mut().zip(Loads::ALL) {
            pressure.begin(loads, locals, parameters, |local| {
                validator.get_local_type(local).is_some_and(is_float)
            });
        }
        let mut function = Function {
            validator,
            flow: &mut self.flow,
            depth: &mut self.depth,
            targets: &mut self.targets,
            regions: &mut self.regions,
            pressures: &mut self.pressures,
            code: body.as_bytes(),
            begin: range.start,
            gauge,
            sizes: Sizes {
                bytes,
                locals: locals.into(),
                ..Sizes::default()
            },
        };
        function.operators(&mut reader)?;
        function.finish(range.start)?;
        self.allocations = function.validator.into_allocations();
        Ok(())
    }
}

/// A function while its operators are read.
struct Function<'a, 'l> {
    validator: FuncValidator<ValidatorResources>,
    flow: &'a mut Flow,
    depth: &'a mut Depth,
    targets: &'a mut Vec<u32>,
    regions: &'a mut Regions,
    pressures: &'a mut [Pressure; 2],
    /// The bytes of its body, which begin where it begins in the file.
    code: &'a [u8],
    begin: u64,
    gauge: &'a mut Gauge<'l>,
    sizes: Sizes,
}

impl Function<'_, '_> {
    fn operators(&mut self, reader: &mut BinaryReader<'_>) -> Result<(), Rejection> {
        while !reader.eof() {
            let byte = reader.original_position();
            let weight = Weight::of(reader.clone().read_u8()?);
            match weight {
                Weight::Plain => {}
                Weight::Access => self.sizes.accesses += 1,
                Weight::Heavy => self.sizes.heavy += 1,
                Weight::Simd => self.sizes.simd += 1,
            }
            let operator = reader.peek_operator(&self.validator.visitor(byte))?;
            // Before it is validated, which for some takes long.
            self.operator(&operator, byte)?;
            let height = self.validator.operand_stack_height();
            let arity = operator.operator_arity(&self.validator).unwrap_or((0, 0));
            reader.visit_operator(&mut self.validator.visitor(byte))??;
            let [from, to] = [byte, reader.original_position()].map(|it| it - self.begin);
            let code = self.code.get(index(from)..index(to)).unwrap_or_default();
            let is_constant = match operator {
                Operator::GlobalGet { global_index } => {
                    let global = self.validator.resources().global_at(global_index);
                    global.is_some_and(|global| !global.mutable)
                }
                _ => false,
            };
            let result = self.validator.get_operand_type(0).flatten();
            let is_float = arity.1 > 0 && result.is_some_and(is_float);
            for pressure in &mut *self.pressures {
                pressure.operator(&operator, code, height, arity, weight.instructions());
                if is_constant {
                    pressure.is_constant();
                }
                if is_float {
                    pressure.is_float();
                }
            }
            let bytes = reader.original_position() - byte;
            self.sizes.deep_bytes += bytes * self.depth.now();
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
        self.flow.next();
        match operator {
            Operator::Block { blockty } => self.open(Construct::Block, *blockty, 1, byte)?,
            // A loop checks fuel and epoch.
            Operator::Loop { blockty } => self.open(Construct::Loop, *blockty, 4, byte)?,
            Operator::If { blockty } => self.open(Construct::If, *blockty, 3, byte)?,
            Operator::Else => {
                self.flow.otherwise();
                self.depth.otherwise();
            }
            Operator::End => {
                self.flow.close();
                self.depth.close();
            }
            Operator::Br { relative_depth } => {
                self.branch(*relative_depth, byte)?;
                self.flow.jump(*relative_depth);
                self.depth.leave();
            }
            Operator::BrIf { relative_depth } => {
                self.branch(*relative_depth, byte)?;
                self.flow.fork(*relative_depth);
                self.depth.fork(1);
            }
            Operator::BrTable { targets } => self.table(targets, byte)?,
            Operator::Return | Operator::Unreachable => self.leave(),
            Operator::Call { function_index } => self.call(*function_index),
            Operator::ReturnCall { function_index } => {
                self.call(*function_index);
                self.leave();
            }
            Operator::ReturnCallIndirect { type_index, .. } => {
                self.table_access();
                self.pass(BlockType::FuncType(*type_index));
                self.leave();
            }
            // A table is filled lazily: the entry may have to be made first.
            Operator::CallIndirect { type_index, .. } => {
                self.table_access();
                self.pass(BlockType::FuncType(*type_index));
            }
            Operator::TableGet { .. } | Operator::TableSet { .. } => self.table_access(),
            Operator::GlobalGet { global_index } | Operator::GlobalSet { global_index } => {
                self.sizes.regions += self.regions.access(*global_index);
            }
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
        match construct {
            Construct::Block => self.depth.block(),
            Construct::Loop => {
                self.depth.repeat();
                // Two checks: fuel and epoch.
                self.sizes.heavy += 2;
            }
            Construct::If => self.depth.condition(),
        }
        self.blocks(blocks);
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

    /// That many blocks about here.
    fn blocks(&mut self, number: u64) {
        self.sizes.blocks += number;
        self.sizes.depths += number * self.depth.now();
        for pressure in &mut *self.pressures {
            pressure.blocks(number);
        }
    }

    /// An access to a table, which may call the host. Its values are all new, so it has more of the
    /// dominator tree to go up than its blocks have.
    fn table_access(&mut self) {
        self.blocks(2);
        self.sizes.heavy += 2;
        self.sizes.depths += self.depth.now();
        self.depth.fork(1);
    }

    /// The end of a path.
    fn leave(&mut self) {
        self.flow.leave();
        self.depth.leave();
    }

    /// A branch to a label: the block after it, and one on the edge.
    fn branch(&mut self, label: u32, byte: u64) -> Result<(), Rejection> {
        let values = self.label_values(label);
        self.blocks(2);
        self.depth.branch(label);
        self.sizes.typed += values;
        self.gauge.add_work(values * BRANCH_VALUE_NS, byte)
    }

    /// A direct call.
    fn call(&mut self, function: u32) {
        let resources = self.validator.resources();
        if let Some(ty) = resources.type_index_of_function(function) {
            self.pass(BlockType::FuncType(ty));
        }
    }

    /// A call of that type.
    fn pass(&mut self, ty: BlockType) {
        let (parameters, results) = self.arity(ty);
        let values = parameters + results;
        // Those that are not in registers take longer.
        let on_stack = values.saturating_sub(PASSED_IN_REGISTERS);
        self.sizes.passed += values.saturating_sub(PASSED_FREE) + 2 * on_stack;
    }

    fn table(&mut self, table: &BrTable<'_>, byte: u64) -> Result<(), Rejection> {
        self.gauge
            .note(Measure::BranchTargets, table.len().into(), byte)?;
        let values = self.label_values(table.default());
        let checked = u64::from(table.len() + 1) * values;
        self.gauge.add_work(checked * BRANCH_VALUE_NS, byte)?;
        self.targets.clear();
        self.targets.push(table.default());
        for target in table.targets() {
            self.targets.push(target?);
        }
        // Equal targets share an edge.
        self.targets.sort_unstable();
        self.targets.dedup();
        for &target in &*self.targets {
            self.flow.fork(target);
            self.depth.branch(target);
        }
        let targets = u64::try_from(self.targets.len()).unwrap_or(u64::MAX);
        self.blocks(targets);
        self.sizes.typed += targets * values;
        self.leave();
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

    /// Estimates what compiling the function takes.
    fn finish(&mut self, byte: u64) -> Result<(), Rejection> {
        self.sizes.joins = self.flow.count();
        let [kept, lost] = &mut *self.pressures;
        let meetings = self.flow.meetings();
        self.sizes.pressed = kept.finish(meetings).max(lost.finish(meetings));
        let carried = self.sizes.joins.carried;
        self.gauge.note(Measure::Carried, carried, byte)?;
        self.sizes.note(self.gauge, byte)
    }
}

/// Parameters and results of a function type.
pub(super) fn arity_of(ty: &CompositeInnerType) -> (u64, u64) {
    let count = |types: &[ValType]| u64::try_from(types.len()).unwrap_or(u64::MAX);
    match ty {
        CompositeInnerType::Func(ty) => (count(ty.params()), count(ty.results())),
        _ => (0, 0),
    }
}

/// Whether a value of that type is in a register for floats and vectors.
const fn is_float(ty: ValType) -> bool {
    matches!(ty, ValType::F32 | ValType::F64 | ValType::V128)
}

fn index(byte: u64) -> usize {
    usize::try_from(byte).unwrap_or(usize::MAX)
}
