//! The sections of components: counts, names, types, and what is instantiated.

use wasmparser::{
    CanonicalFunction, ComponentExternalKind, ComponentInstance, ComponentType,
    ComponentTypeDeclaration, CoreType, Instance, InstanceTypeDeclaration, ModuleTypeDeclaration,
    Payload, RecGroup, SectionLimited, Validator,
};

use super::super::rejection::Rejection;
use super::declared::{Declared, of_core_type};
use super::expansion::{Expansion, Requirements};
use super::function::arity_of;
use super::gauge::Gauge;
use super::items::each;
use super::measure::Measure;
use super::module::{entry_ns, entry_spills};
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
            Some(requirements) => requirements.check(gauge, byte),
            None => Ok(()),
        }
    }

    /// A core module of the innermost component has ended.
    pub(super) fn module(&mut self, requirements: Requirements) {
        self.expansion.module(requirements);
    }

    /// Checks a section, and validates it if it has items that are checked one by one. Returns
    /// whether it has.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`], and [`Rejection::Invalid`] when it cannot be read or
    /// instantiates what is not known.
    pub(super) fn section(
        &mut self,
        payload: &Payload<'_>,
        file: &[u8],
        validator: &mut Validator,
        gauge: &mut Gauge<'_>,
    ) -> Result<bool, Rejection> {
        let is_outermost = self.expansion.depth() == 1;
        let start = payload.as_section().map_or(0, |(_, range)| range.start);
        self.add_items(items(payload).into(), gauge, start)?;
        match payload {
            Payload::CoreTypeSection(section) => each(section, file, |byte, ty, alone| {
                self.core_type(&ty, gauge, byte)?;
                Ok(validator.core_type_section(&SectionLimited::new(alone)?)?)
            })?,
            Payload::ComponentTypeSection(section) => each(section, file, |byte, ty, alone| {
                self.add_items(declarations(&ty), gauge, byte)?;
                core_types(&ty, gauge, byte)?;
                let work = Declared::work(&ty, validator, &mut self.parts);
                gauge.add(Measure::TypeWork, work, byte)?;
                Ok(validator.component_type_section(&SectionLimited::new(alone)?)?)
            })?,
            Payload::InstanceSection(section) => each(section, file, |byte, instance, alone| {
                self.core_instance(&instance, validator, gauge, byte)?;
                Ok(validator.instance_section(&SectionLimited::new(alone)?)?)
            })?,
            Payload::ComponentInstanceSection(section) => {
                each(section, file, |byte, instance, alone| {
                    self.instance(&instance, validator, gauge, byte)?;
                    Ok(validator.component_instance_section(&SectionLimited::new(alone)?)?)
                })?;
            }
            Payload::ComponentAliasSection(section) => {
                each(section, file, |byte, alias, alone| {
                    gauge.add(Measure::TypeWork, 1, byte)?;
                    self.expansion.alias(&alias);
                    Ok(validator.component_alias_section(&SectionLimited::new(alone)?)?)
                })?
            }
            Payload::ComponentImportSection(section) => {
                each(section, file, |byte, import, alone| {
                    let name = import.name.name;
                    gauge.note(Measure::NameBytes, count(name.len()), byte)?;
                    self.expansion.import(import.ty);
                    let parts = &mut self.parts;
                    let of = |types| parts.of_reference(types, &import.ty);
                    let found = validator.types(0).map_or(1, of);
                    // When it is declared, and when the component ends.
                    gauge.add(Measure::TypeWork, found.saturating_mul(2), byte)?;
                    if is_outermost {
                        self.imports.push(name.to_owned());
                    }
                    Ok(validator.component_import_section(&SectionLimited::new(alone)?)?)
                })?;
            }
            Payload::ComponentExportSection(section) => {
                each(section, file, |byte, export, alone| {
                    let name = export.name.name;
                    gauge.note(Measure::NameBytes, count(name.len()), byte)?;
                    self.expansion.export(export.kind, export.index);
                    let parts = &mut self.parts;
                    let found = validator.types(0).map_or(1, |types| {
                        let item = parts.of_item(types, export.kind, export.index);
                        let of = |ty| parts.of_reference(types, ty);
                        item.saturating_add(export.ty.as_ref().map_or(0, of))
                    });
                    gauge.add(Measure::TypeWork, found.saturating_mul(2), byte)?;
                    if is_outermost {
                        self.exports.push(name.to_owned());
                    }
                    Ok(validator.component_export_section(&SectionLimited::new(alone)?)?)
                })?;
            }
            Payload::ComponentCanonicalSection(section) => {
                each(section, file, |byte, function, alone| {
                    self.canonical(&function, validator, gauge, byte)?;
                    Ok(validator.component_canonical_section(&SectionLimited::new(alone)?)?)
                })?;
            }
            _ => return Ok(false),
        }
        // Whether a section of its kind may stand here is not known from no items.
        Ok(items(payload) > 0)
    }

    fn core_type(
        &mut self,
        ty: &CoreType<'_>,
        gauge: &mut Gauge<'_>,
        byte: u64,
    ) -> Result<(), Rejection> {
        let inner = match ty {
            CoreType::Module(inner) => count(inner.len()),
            CoreType::Rec(_) => 0,
        };
        self.add_items(inner, gauge, byte)?;
        core_type(ty, gauge, byte)?;
        gauge.add(Measure::TypeWork, of_core_type(ty), byte)
    }

    fn core_instance(
        &mut self,
        instance: &Instance<'_>,
        validator: &Validator,
        gauge: &mut Gauge<'_>,
        byte: u64,
    ) -> Result<(), Rejection> {
        self.expansion
            .core_instance(instance)
            .map_err(|unknown| unknown.reject(byte))?;
        let parts = match (instance, validator.types(0)) {
            (Instance::Instantiate { module_index, .. }, Some(types)) => {
                let module = ComponentExternalKind::Module;
                self.parts.of_item(types, module, *module_index)
            }
            _ => 1,
        };
        gauge.add(Measure::TypeWork, parts, byte)
    }

    fn instance(
        &mut self,
        instance: &ComponentInstance<'_>,
        validator: &Validator,
        gauge: &mut Gauge<'_>,
        byte: u64,
    ) -> Result<(), Rejection> {
        self.expansion
            .instance(instance)
            .map_err(|unknown| unknown.reject(byte))?;
        let Some(types) = validator.types(0) else {
            return Ok(());
        };
        let mut items = match instance {
            ComponentInstance::Instantiate {
                component_index,
                args,
            } => {
                let component = ComponentExternalKind::Component;
                let arguments = args.iter().map(|it| (it.kind, it.index));
                Vec::from_iter([(component, *component_index)].into_iter().chain(arguments))
            }
            ComponentInstance::FromExports(exports) => {
                Vec::from_iter(exports.iter().map(|it| (it.kind, it.index)))
            }
        };
        items.drain(..).try_for_each(|(kind, index)| {
            let parts = self.parts.of_item(types, kind, index);
            gauge.add(Measure::TypeWork, parts, byte)
        })
    }

    /// A function that is lifted, lowered, or built in.
    fn canonical(
        &mut self,
        function: &CanonicalFunction,
        validator: &Validator,
        gauge: &mut Gauge<'_>,
        byte: u64,
    ) -> Result<(), Rejection> {
        let Some(types) = validator.types(0) else {
            return Ok(());
        };
        let (parts, bytes) = match function {
            CanonicalFunction::Lift { type_index, .. } => {
                let parts = self.parts.of_function_type(types, *type_index);
                (parts, FUNCTION_BYTES)
            }
            CanonicalFunction::Lower { func_index, .. } => {
                let parts = self.parts.of_function(types, *func_index);
                if let Some(requirements) = self.expansion.requirements() {
                    let add = |sum: &mut u64, more| *sum = sum.saturating_add(more);
                    add(&mut requirements.adapter_values, parts);
                    add(&mut requirements.lowered_functions, 1);
                }
                (parts, ADAPTER_BYTES)
            }
            _ => (0, FUNCTION_BYTES),
        };
        if let Some(requirements) = self.expansion.requirements() {
            let sum = &mut requirements.instance_bytes;
            *sum = sum.saturating_add(bytes);
        }
        gauge.add(Measure::TypeWork, parts, byte)?;
        gauge.note(Measure::TypeParts, parts, byte)
    }

    fn add_items(&mut self, items: u64, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
        if let Some(requirements) = self.expansion.requirements() {
            requirements.items = requirements.items.saturating_add(items);
        }
        gauge.add(Measure::ComponentItems, items, byte)
    }
}

/// State of a function that a component lifts or that is built in, at most, in bytes.
const FUNCTION_BYTES: u64 = 128;

/// State of a lowered function, at most, in bytes: with the module that moves the values from
/// component to component, its imports, and a function for every encoding of strings.
const ADAPTER_BYTES: u64 = 1_600;

/// The number of items in a section of a component.
fn items(payload: &Payload<'_>) -> u32 {
    match payload {
        Payload::CoreTypeSection(section) => section.count(),
        Payload::ComponentTypeSection(section) => section.count(),
        Payload::InstanceSection(section) => section.count(),
        Payload::ComponentInstanceSection(section) => section.count(),
        Payload::ComponentAliasSection(section) => section.count(),
        Payload::ComponentImportSection(section) => section.count(),
        Payload::ComponentExportSection(section) => section.count(),
        Payload::ComponentCanonicalSection(section) => section.count(),
        _ => 0,
    }
}

/// Counts the core types that a type declares.
fn core_types(ty: &ComponentType<'_>, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
    match ty {
        ComponentType::Component(inner) => {
            inner.iter().try_for_each(|declaration| match declaration {
                ComponentTypeDeclaration::CoreType(ty) => core_type(ty, gauge, byte),
                ComponentTypeDeclaration::Type(ty) => core_types(ty, gauge, byte),
                _ => Ok(()),
            })
        }
        ComponentType::Instance(inner) => {
            inner.iter().try_for_each(|declaration| match declaration {
                InstanceTypeDeclaration::CoreType(ty) => core_type(ty, gauge, byte),
                InstanceTypeDeclaration::Type(ty) => core_types(ty, gauge, byte),
                _ => Ok(()),
            })
        }
        _ => Ok(()),
    }
}

fn core_type(ty: &CoreType<'_>, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
    let mut group = |group: &RecGroup| {
        for ty in group.types() {
            let (parameters, results) = arity_of(&ty.composite_type.inner);
            gauge.add(Measure::FileFunctionTypes, 1, byte)?;
            gauge.note(Measure::Values, parameters + results, byte)?;
            gauge.add_work(entry_ns(parameters + results), byte)?;
            gauge.add_spills(entry_spills(parameters + results), byte)?;
        }
        Ok(())
    };
    match ty {
        CoreType::Rec(types) => group(types),
        CoreType::Module(declarations) => {
            declarations
                .iter()
                .try_for_each(|declaration| match declaration {
                    ModuleTypeDeclaration::Type(types) => group(types),
                    _ => Ok(()),
                })
        }
    }
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
