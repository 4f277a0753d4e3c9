//! The sections of one core module, except its code: counts, names, sizes.

use wasmparser::{ConstExpr, DataKind, ElementItems, ElementKind, Payload, TableInit};

use super::super::rejection::Rejection;
use super::expansion::Requirements;
use super::measure::{Gauge, Measure};

/// A page of linear memory, in bytes.
const PAGE_BYTES: u64 = 64 << 10;

/// A core module that is being read.
#[derive(Debug, Default)]
pub(super) struct Module {
    /// What instantiating it takes.
    pub(super) requirements: Requirements,
    elements: u64,
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
        let mut items = |count: u32| gauge.note(Measure::ModuleItems, count.into(), start);
        match payload {
            Payload::TypeSection(section) => {
                gauge.note(Measure::FunctionTypes, section.count().into(), start)?;
                for ty in section.clone().into_iter_err_on_gc_types() {
                    let ty = ty?;
                    let values = ty.params().len() + ty.results().len();
                    gauge.note(Measure::Values, count(values), start)?;
                }
            }
            Payload::ImportSection(section) => {
                items(section.count())?;
                for import in section.clone().into_imports() {
                    let import = import?;
                    let longest = import.module.len().max(import.name.len());
                    gauge.note(Measure::NameBytes, count(longest), start)?;
                }
            }
            Payload::ExportSection(section) => {
                items(section.count())?;
                for export in section.clone() {
                    gauge.note(Measure::NameBytes, count(export?.name.len()), start)?;
                }
            }
            Payload::FunctionSection(section) => {
                gauge.add(Measure::Functions, section.count().into(), start)?;
            }
            Payload::TableSection(section) => {
                items(section.count())?;
                for table in section.clone() {
                    let table = table?;
                    self.requirements.tables += 1;
                    let elements = &mut self.requirements.table_elements;
                    *elements = table.ty.initial.max(*elements);
                    if let TableInit::Expr(expression) = &table.init {
                        check_const(expression, gauge)?;
                    }
                }
            }
            Payload::MemorySection(section) => {
                items(section.count())?;
                for memory in section.clone() {
                    let bytes = memory?.initial.saturating_mul(PAGE_BYTES);
                    self.requirements.memories += 1;
                    self.requirements.memory_bytes = bytes.max(self.requirements.memory_bytes);
                }
            }
            Payload::GlobalSection(section) => {
                items(section.count())?;
                for global in section.clone() {
                    check_const(&global?.init_expr, gauge)?;
                }
            }
            Payload::TagSection(section) => items(section.count())?,
            Payload::ElementSection(section) => {
                items(section.count())?;
                for element in section.clone() {
                    self.element(&element?, gauge)?;
                }
            }
            Payload::DataSection(section) => {
                items(section.count())?;
                for data in section.clone() {
                    if let DataKind::Active { offset_expr, .. } = data?.kind {
                        check_const(&offset_expr, gauge)?;
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn element(
        &mut self,
        element: &wasmparser::Element<'_>,
        gauge: &mut Gauge<'_>,
    ) -> Result<(), Rejection> {
        if let ElementKind::Active { offset_expr, .. } = &element.kind {
            check_const(offset_expr, gauge)?;
        }
        let items = match &element.items {
            ElementItems::Functions(items) => items.count(),
            ElementItems::Expressions(_, items) => {
                for item in items.clone() {
                    check_const(&item?, gauge)?;
                }
                items.count()
            }
        };
        add(&mut self.elements, items.into());
        gauge.note(Measure::ModuleItems, self.elements, element.range.start)
    }
}

fn check_const(expression: &ConstExpr<'_>, gauge: &mut Gauge<'_>) -> Result<(), Rejection> {
    let reader = expression.get_binary_reader();
    let start = reader.original_position();
    let bytes = count(reader.bytes_remaining());
    gauge.note(Measure::ConstBytes, bytes, start)
}

const fn add(sum: &mut u64, more: u64) {
    *sum = sum.saturating_add(more);
}

fn count(length: usize) -> u64 {
    u64::try_from(length).unwrap_or(u64::MAX)
}
