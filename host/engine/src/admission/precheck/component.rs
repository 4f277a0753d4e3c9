//! The sections of components: counts, names, types, and what is instantiated.

use wasmparser::types::TypesRef;
use wasmparser::{
    CanonicalFunction, ComponentType, ComponentTypeDeclaration, CoreType, InstanceTypeDeclaration,
    Payload,
};

use super::super::rejection::Rejection;
use super::expansion::{Expansion, Requirements, Unknown};
use super::measure::{Gauge, Measure};
use super::parts::Parts;

/// The components that are being read.
#[derive(Default)]
pub(super) struct Components {
    expansion: Expansion,
    parts: Parts,
    /// Names of imports and exports of the outermost component.
    pub(super) imports: Vec<String>,
    pub(super) exports: Vec<String>,
}

impl Components {
    /// A component begins.
    pub(super) fn begin(&mut self, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
        let depth = self.expansion.begin();
        gauge.note(Measure::ComponentDepth, count(depth), byte)
    }

    /// A component ends.
    pub(super) fn end(&mut self, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
        match self.expansion.end() {
            Some(requirements) => check_requirements(&requirements, gauge, byte),
            None => Ok(()),
        }
    }

    /// A core module of the innermost component has ended.
    pub(super) fn module(&mut self, requirements: Requirements) {
        self.expansion.module(requirements);
    }

    /// Checks a section before it is validated.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`], and [`Rejection::Invalid`] when it cannot be read or
    /// instantiates what is not known.
    pub(super) fn section(
        &mut self,
        payload: &Payload<'_>,
        gauge: &mut Gauge<'_>,
    ) -> Result<(), Rejection> {
        let start = payload.as_section().map_or(0, |(_, range)| range.start);
        let unknown = |unknown: Unknown| match unknown {
            Unknown::Foreign => Rejection::Invalid(format!(
                "it instantiates a component or module that it is handed or takes out of an \
                 instance, at byte {start}"
            )),
            Unknown::Missing => Rejection::Invalid(format!(
                "it instantiates a component or module that does not exist, at byte {start}"
            )),
        };
        let is_outermost = self.expansion.depth() == 1;
        match payload {
            Payload::ComponentTypeSection(section) => {
                self.items(section.count(), gauge, start)?;
                for ty in section.clone() {
                    let inner = declarations(&ty?);
                    self.add_items(inner, gauge, start)?;
                }
            }
            Payload::CoreTypeSection(section) => {
                self.items(section.count(), gauge, start)?;
                for ty in section.clone() {
                    if let CoreType::Module(inner) = ty? {
                        self.add_items(count(inner.len()), gauge, start)?;
                    }
                }
            }
            Payload::InstanceSection(section) => {
                self.items(section.count(), gauge, start)?;
                for instance in section.clone() {
                    self.expansion.core_instance(&instance?).map_err(unknown)?;
                }
            }
            Payload::ComponentInstanceSection(section) => {
                self.items(section.count(), gauge, start)?;
                for instance in section.clone() {
                    self.expansion.instance(&instance?).map_err(unknown)?;
                }
            }
            Payload::ComponentAliasSection(section) => {
                self.items(section.count(), gauge, start)?;
                for alias in section.clone() {
                    self.expansion.alias(&alias?);
                }
            }
            Payload::ComponentImportSection(section) => {
                self.items(section.count(), gauge, start)?;
                for import in section.clone() {
                    let import = import?;
                    let name = import.name.name;
                    gauge.note(Measure::NameBytes, count(name.len()), start)?;
                    self.expansion.import(import.ty);
                    if is_outermost {
                        self.imports.push(name.to_owned());
                    }
                }
            }
            Payload::ComponentExportSection(section) => {
                self.items(section.count(), gauge, start)?;
                for export in section.clone() {
                    let export = export?;
                    let name = export.name.name;
                    gauge.note(Measure::NameBytes, count(name.len()), start)?;
                    self.expansion.export(export.kind, export.index);
                    if is_outermost {
                        self.exports.push(name.to_owned());
                    }
                }
            }
            Payload::ComponentCanonicalSection(section) => {
                self.items(section.count(), gauge, start)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Checks what can only be known of a section that has been validated: the
    /// types of functions that are lifted and lowered.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`].
    pub(super) fn validated(
        &mut self,
        payload: &Payload<'_>,
        types: Option<TypesRef<'_>>,
        gauge: &mut Gauge<'_>,
    ) -> Result<(), Rejection> {
        let (Payload::ComponentCanonicalSection(section), Some(types)) = (payload, types) else {
            return Ok(());
        };
        for function in section.clone().into_iter_with_offsets() {
            let (byte, function) = function?;
            let parts = match function {
                CanonicalFunction::Lift { type_index, .. } => {
                    self.parts.of_function_type(types, type_index)
                }
                CanonicalFunction::Lower { func_index, .. } => {
                    let parts = self.parts.of_function(types, func_index);
                    if let Some(requirements) = self.expansion.requirements() {
                        requirements.adapter_values =
                            requirements.adapter_values.saturating_add(parts);
                    }
                    parts
                }
                _ => 0,
            };
            gauge.note(Measure::TypeParts, parts, byte)?;
        }
        Ok(())
    }

    fn items(&mut self, items: u32, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
        self.add_items(items.into(), gauge, byte)
    }

    fn add_items(&mut self, items: u64, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
        if let Some(requirements) = self.expansion.requirements() {
            requirements.items = requirements.items.saturating_add(items);
        }
        gauge.add(Measure::ComponentItems, items, byte)
    }
}

/// Compares what instantiation takes with the limits.
pub(super) fn check_requirements(
    requirements: &Requirements,
    gauge: &mut Gauge<'_>,
    byte: u64,
) -> Result<(), Rejection> {
    for (measure, found) in [
        (Measure::CoreInstances, requirements.core_instances),
        (Measure::Memories, requirements.memories),
        (Measure::MemoryBytes, requirements.memory_bytes),
        (Measure::Tables, requirements.tables),
        (Measure::TableElements, requirements.table_elements),
        (Measure::ExpandedItems, requirements.items),
        (Measure::AdapterValues, requirements.adapter_values),
    ] {
        gauge.note(measure, found, byte)?;
    }
    Ok(())
}

/// Items inside a type.
fn declarations(ty: &ComponentType<'_>) -> u64 {
    match ty {
        ComponentType::Component(inner) => inner
            .iter()
            .map(|declaration| match declaration {
                ComponentTypeDeclaration::Type(ty) => 1 + declarations(ty),
                _ => 1,
            })
            .sum(),
        ComponentType::Instance(inner) => inner
            .iter()
            .map(|declaration| match declaration {
                InstanceTypeDeclaration::Type(ty) => 1 + declarations(ty),
                _ => 1,
            })
            .sum(),
        ComponentType::Func(function) => count(function.params.len()),
        ComponentType::Defined(_) | ComponentType::Resource { .. } => 0,
    }
}

fn count(length: usize) -> u64 {
    u64::try_from(length).unwrap_or(u64::MAX)
}
