//! The sections of one core module, except its code: counts, names, sizes, and what instances
//! of it take.

use wasmparser::{ConstExpr, DataKind, ElementItems, ElementKind, Payload, TableInit, TypeRef};

use super::super::constant::Constant;
use super::super::rejection::Rejection;
use super::context::Context;
use super::expansion::Requirements;
use super::gauge::Gauge;
use super::measure::Measure;
use super::spills::Spills;
use super::startup::Startup;

/// A page of linear memory, in bytes.
const PAGE_BYTES: u64 = 64 << 10;

/// A core module that is being read.
#[derive(Debug, Default)]
pub(super) struct Module {
    /// What instantiating it takes.
    requirements: Requirements,
    context: Context,
    startup: Startup,
    /// Parameters and results of each type.
    values: Vec<u64>,
    /// The same of each function that the module defines.
    signatures: Vec<u64>,
}

impl Module {
    /// Checks a section before it is validated.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`], and [`Rejection::Invalid`] when it cannot be read.
    pub(super) fn section(
        &mut self,
        payload: &Payload<'_>,
        gauge: &mut Gauge<'_>,
    ) -> Result<(), Rejection> {
        let start = payload.as_section().map_or(0, |(_, range)| range.start);
        match payload {
            Payload::TypeSection(section) => {
                gauge.note(Measure::FunctionTypes, section.count().into(), start)?;
                gauge.add(Measure::FileFunctionTypes, section.count().into(), start)?;
                for ty in section.clone().into_iter_err_on_gc_types() {
                    let ty = ty?;
                    let values = count(ty.params().len() + ty.results().len());
                    gauge.note(Measure::Values, values, start)?;
                    gauge.add_work(entry_ns(values), start)?;
                    gauge.add_spills(entry_spills(values), start)?;
                    gauge.add_memory(entry_bytes(values), 0, start)?;
                    self.values.push(values);
                }
            }
            Payload::ImportSection(section) => {
                items(section.count(), gauge, start)?;
                for import in section.clone().into_imports() {
                    let import = import?;
                    let longest = import.module.len().max(import.name.len());
                    gauge.note(Measure::NameBytes, count(longest), start)?;
                    self.context.import(&import.ty);
                    match import.ty {
                        TypeRef::Table(_) => self.startup.import_table(),
                        TypeRef::Memory(_) => self.startup.import_memory(),
                        _ => {}
                    }
                }
            }
            Payload::ExportSection(section) => {
                items(section.count(), gauge, start)?;
                for export in section.clone() {
                    let export = export?;
                    gauge.note(Measure::NameBytes, count(export.name.len()), start)?;
                    if export.kind == wasmparser::ExternalKind::Func {
                        self.context.escape(export.index);
                    }
                }
            }
            Payload::FunctionSection(section) => {
                gauge.add(Measure::Functions, section.count().into(), start)?;
                self.context.functions = section.count().into();
                for ty in section.clone() {
                    let ty = usize::try_from(ty?).ok();
                    let values = ty.and_then(|ty| self.values.get(ty));
                    let values = values.copied().unwrap_or_default();
                    self.signatures.push(values);
                    gauge.add_work(values.saturating_mul(PARAMETER_NS), start)?;
                }
            }
            Payload::TableSection(section) => {
                items(section.count(), gauge, start)?;
                for table in section.clone() {
                    let table = table?;
                    self.requirements.tables += 1;
                    let elements = &mut self.requirements.table_elements;
                    *elements = table.ty.initial.max(*elements);
                    self.context.tables += 1;
                    let initial = match &table.init {
                        TableInit::Expr(expression) => Some(self.constant(expression, gauge)?),
                        TableInit::RefNull => None,
                    };
                    self.startup.table(table.ty.initial, initial.as_ref());
                }
            }
            Payload::MemorySection(section) => {
                items(section.count(), gauge, start)?;
                for memory in section.clone() {
                    let bytes = memory?.initial.saturating_mul(PAGE_BYTES);
                    self.requirements.memories += 1;
                    self.requirements.memory_bytes = bytes.max(self.requirements.memory_bytes);
                    self.context.memories += 1;
                    self.startup.memory(bytes);
                }
            }
            Payload::GlobalSection(section) => {
                items(section.count(), gauge, start)?;
                for global in section.clone() {
                    let value = self.constant(&global?.init_expr, gauge)?;
                    self.context.globals += 1;
                    self.startup.global(&value);
                }
            }
            Payload::TagSection(section) => items(section.count(), gauge, start)?,
            Payload::ElementSection(section) => {
                items(section.count(), gauge, start)?;
                for element in section.clone() {
                    self.element(&element?, gauge)?;
                }
            }
            Payload::DataSection(section) => {
                items(section.count(), gauge, start)?;
                for data in section.clone() {
                    self.data(&data?, gauge)?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// The module ends. Checks what the engine would refuse to load even when nothing
    /// instantiates it, and what the compiler makes of it besides its functions. Returns what
    /// instantiating it takes.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`].
    pub(super) fn end(
        &mut self,
        gauge: &mut Gauge<'_>,
        byte: u64,
    ) -> Result<Requirements, Rejection> {
        let initialisation = self.startup.finish();
        self.context.data += initialisation.data;
        let mut requirements = self.requirements;
        requirements.instance_bytes = self.context.bytes();
        requirements.check_module(gauge, byte)?;
        let image_bytes = initialisation.image_bytes;
        gauge.add(Measure::ImageBytes, image_bytes, byte)?;
        gauge.add_work(image_bytes.saturating_mul(IMAGE_BYTE_NS), byte)?;
        gauge.add_memory(image_bytes.saturating_mul(IMAGE_COPIES), 0, byte)?;
        initialisation.code.note(gauge, byte)?;
        for function in self.context.escaped() {
            let values = self.signatures.get(function).copied().unwrap_or_default();
            gauge.add_work(entry_ns(values), byte)?;
            gauge.add_spills(entry_spills(values), byte)?;
            gauge.add_memory(entry_bytes(values), 0, byte)?;
        }
        Ok(requirements)
    }

    fn element(
        &mut self,
        element: &wasmparser::Element<'_>,
        gauge: &mut Gauge<'_>,
    ) -> Result<(), Rejection> {
        let start = element.range.start;
        let offset = match &element.kind {
            ElementKind::Active { offset_expr, .. } => Some(self.constant(offset_expr, gauge)?),
            ElementKind::Passive | ElementKind::Declared => None,
        };
        let elements = u64::from(match &element.items {
            ElementItems::Functions(items) => items.count(),
            ElementItems::Expressions(_, items) => items.count(),
        });
        add(&mut self.requirements.elements, elements);
        gauge.note(Measure::ModuleItems, self.requirements.elements, start)?;
        gauge.add(Measure::Elements, elements, start)?;
        let operators = match &element.items {
            ElementItems::Functions(items) => {
                for function in items.clone() {
                    self.context.escape(function?);
                }
                None
            }
            ElementItems::Expressions(_, items) => {
                let mut operators = 0;
                for item in items.clone() {
                    operators += self.constant(&item?, gauge)?.operators;
                }
                Some(operators)
            }
        };
        match (&element.kind, offset) {
            (ElementKind::Active { table_index, .. }, Some(offset)) => {
                let table = table_index.unwrap_or(0);
                self.startup.elements(table, &offset, elements, operators);
            }
            (ElementKind::Passive, _) => {
                self.startup
                    .passive_elements(elements, operators.unwrap_or(elements));
            }
            _ => {}
        }
        Ok(())
    }

    fn data(
        &mut self,
        data: &wasmparser::Data<'_>,
        gauge: &mut Gauge<'_>,
    ) -> Result<(), Rejection> {
        let bytes = count(data.data.len());
        add(&mut self.requirements.data_bytes, bytes);
        match &data.kind {
            DataKind::Active {
                memory_index,
                offset_expr,
            } => {
                let offset = self.constant(offset_expr, gauge)?;
                self.startup.data(*memory_index, &offset, bytes);
            }
            DataKind::Passive => self.context.data += 1,
        }
        Ok(())
    }

    /// Reads a constant expression, once its length is known to be small.
    fn constant(
        &mut self,
        expression: &ConstExpr<'_>,
        gauge: &mut Gauge<'_>,
    ) -> Result<Constant, Rejection> {
        let reader = expression.get_binary_reader();
        let start = reader.original_position();
        let bytes = count(reader.bytes_remaining());
        gauge.note(Measure::ConstBytes, bytes, start)?;
        let constant = Constant::read(expression)?;
        for &function in &constant.functions {
            self.context.escape(function);
        }
        Ok(constant)
    }
}

/// Time to read and write an item of a module.
const ITEM_NS: u64 = 2_000;

/// Memory for an item of a module until the file is compiled.
const ITEM_BYTES: u64 = 1_000;

/// How often an image is in memory at the same time, about.
const IMAGE_COPIES: u64 = 4;

/// Time to make and write a byte of an image.
const IMAGE_BYTE_NS: u64 = 4;

/// Time to compile an entry: the function by which the host calls one that escapes, and the one
/// by which functions of a type call the host.
const ENTRY_NS: u64 = 150_000;

/// The same for each parameter and result.
const VALUE_NS: u64 = 20_000;

/// Parameters and results that find a register, about.
const IN_REGISTERS: u64 = 14;

/// Time for each of the others, besides what other functions make it take (`spills`).
const SPILLED_NS: u64 = 10_000;

/// Tries to find a register for each of the others.
const SPILLED_TRIES: u64 = 34;

/// Memory for a compiled entry of a type with that many parameters and results.
const fn entry_bytes(values: u64) -> u64 {
    5_500 + values * 100
}

/// Time for each parameter and result of a function itself.
const PARAMETER_NS: u64 = 2_000;

/// What the allocator of registers does for an entry of a type with that many parameters and results.
pub(super) const fn entry_spills(values: u64) -> Spills {
    Spills {
        tries: values * 5 + values.saturating_sub(IN_REGISTERS) * SPILLED_TRIES,
        conflicts: values * 2,
    }
}

/// Time to compile an entry of a type with that many parameters and results.
pub(super) const fn entry_ns(values: u64) -> u64 {
    ENTRY_NS + values * VALUE_NS + values.saturating_sub(IN_REGISTERS) * SPILLED_NS
}

fn items(count: u32, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
    gauge.note(Measure::ModuleItems, count.into(), byte)?;
    gauge.add_work(u64::from(count) * ITEM_NS, byte)?;
    gauge.add_memory(u64::from(count) * ITEM_BYTES, 0, byte)?;
    gauge.add(Measure::FileItems, count.into(), byte)
}

const fn add(sum: &mut u64, more: u64) {
    *sum = sum.saturating_add(more);
}

fn count(length: usize) -> u64 {
    u64::try_from(length).unwrap_or(u64::MAX)
}
