//! [`Expansion`]: what a component becomes when everything in it is instantiated.
//!
//! A component may instantiate another one twice, and that one a third one twice:
//! 1 KB of file asks for 2^30 instances. They are counted here without being made:
//! each component is summed up once, when it ends, and its sum is added wherever it
//! is instantiated. Sums saturate.
//!
//! This works because it is always known which component or module is instantiated:
//! one that is written in the file, in the component itself or in one around it. A
//! component that instantiates what it is handed, or what it takes out of an
//! instance, is rejected; no toolchain makes such robots.

use wasmparser::{
    ComponentAlias, ComponentExternalKind, ComponentInstance, ComponentOuterAliasKind,
    ComponentTypeRef, Instance,
};

use super::super::rejection::Rejection;
use super::gauge::Gauge;
use super::measure::Measure;

/// What instantiating something once takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Requirements {
    /// Items that the compiler goes through.
    pub(super) items: u64,
    pub(super) core_instances: u64,
    pub(super) memories: u64,
    /// Of the largest.
    pub(super) memory_bytes: u64,
    pub(super) tables: u64,
    /// Of the largest.
    pub(super) table_elements: u64,
    /// Values in the types of the functions that are lowered.
    pub(super) adapter_values: u64,
    /// Functions that are lowered.
    pub(super) lowered_functions: u64,
    /// Elements in all element segments.
    pub(super) elements: u64,
    /// Bytes in all data segments.
    pub(super) data_bytes: u64,
    /// State that the engine keeps for the instances, in bytes.
    pub(super) instance_bytes: u64,
}

impl Requirements {
    pub(super) fn add(&mut self, more: &Self) {
        let sum = |a: &mut u64, b: u64| *a = a.saturating_add(b);
        sum(&mut self.items, more.items);
        sum(&mut self.core_instances, more.core_instances);
        sum(&mut self.memories, more.memories);
        sum(&mut self.tables, more.tables);
        sum(&mut self.adapter_values, more.adapter_values);
        sum(&mut self.lowered_functions, more.lowered_functions);
        sum(&mut self.elements, more.elements);
        sum(&mut self.data_bytes, more.data_bytes);
        sum(&mut self.instance_bytes, more.instance_bytes);
        self.memory_bytes = self.memory_bytes.max(more.memory_bytes);
        self.table_elements = self.table_elements.max(more.table_elements);
    }

    /// Compares with the limits what a module takes, whether it is instantiated or not.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`].
    pub(super) fn check_module(&self, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
        for (measure, found) in [
            (Measure::Memories, self.memories),
            (Measure::MemoryBytes, self.memory_bytes),
            (Measure::Tables, self.tables),
            (Measure::TableElements, self.table_elements),
            (Measure::CoreInstanceBytes, self.instance_bytes),
        ] {
            gauge.note(measure, found, byte)?;
        }
        Ok(())
    }

    /// Compares with the limits what a file takes in all.
    ///
    /// # Errors
    ///
    /// [`Rejection::OverLimit`].
    pub(super) fn check(&self, gauge: &mut Gauge<'_>, byte: u64) -> Result<(), Rejection> {
        for (measure, found) in [
            (Measure::CoreInstances, self.core_instances),
            (Measure::Memories, self.memories),
            (Measure::MemoryBytes, self.memory_bytes),
            (Measure::Tables, self.tables),
            (Measure::TableElements, self.table_elements),
            (Measure::ExpandedItems, self.items),
            (Measure::AdapterValues, self.adapter_values),
            (Measure::LoweredFunctions, self.lowered_functions),
            (Measure::Elements, self.elements),
            (Measure::DataBytes, self.data_bytes),
            (Measure::ComponentInstanceBytes, self.instance_bytes),
        ] {
            gauge.note(measure, found, byte)?;
        }
        let adapters = self.lowered_functions.saturating_mul(ADAPTER_NS);
        let values = self.adapter_values.saturating_mul(ADAPTER_VALUE_NS);
        gauge.add_work(adapters.saturating_add(values), byte)
    }
}

/// Time to compile the function that moves values from component to component.
const ADAPTER_NS: u64 = 3_000_000;

/// Time for each of the values; strings take the longest.
const ADAPTER_VALUE_NS: u64 = 1_200_000;

/// State of one instance of a component, without what is in it, in bytes.
const COMPONENT_BYTES: u64 = 16;

/// Why something cannot be instantiated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unknown {
    /// It is handed over, or taken out of an instance.
    Foreign,
    /// There is no such index; validation says so better.
    Missing,
}

impl Unknown {
    /// The rejection of what is instantiated at that byte.
    pub(super) fn reject(self, byte: u64) -> Rejection {
        let what = match self {
            Self::Foreign => "is handed or takes out of an instance",
            Self::Missing => "does not have",
        };
        Rejection::Invalid {
            message: format!("it instantiates a component or module that it {what}"),
            byte: Some(byte),
        }
    }
}

/// The index spaces of one component that is open: `None` for what is foreign.
#[derive(Debug, Default)]
struct Scope {
    modules: Vec<Option<Requirements>>,
    components: Vec<Option<Requirements>>,
    requirements: Requirements,
}

/// The components that are open, the innermost last.
#[derive(Debug, Default)]
pub(super) struct Expansion {
    scopes: Vec<Scope>,
}

impl Expansion {
    /// A component begins. Returns how many are open now.
    pub(super) fn begin(&mut self) -> usize {
        self.scopes.push(Scope::default());
        self.scopes.len()
    }

    /// The innermost component ends. Returns its sum when it is the outermost one.
    pub(super) fn end(&mut self) -> Option<Requirements> {
        let scope = self.scopes.pop()?;
        match self.scopes.last_mut() {
            None => Some(scope.requirements),
            Some(outer) => {
                outer.components.push(Some(scope.requirements));
                None
            }
        }
    }

    /// How many components are open.
    pub(super) const fn depth(&self) -> usize {
        self.scopes.len()
    }

    /// The sum of the innermost component so far.
    pub(super) fn requirements(&mut self) -> Option<&mut Requirements> {
        self.scopes.last_mut().map(|scope| &mut scope.requirements)
    }

    /// A core module of the innermost component has ended.
    pub(super) fn module(&mut self, requirements: Requirements) {
        if let Some(scope) = self.scopes.last_mut() {
            scope.modules.push(Some(requirements));
        }
    }

    /// A core instance.
    pub(super) fn core_instance(&mut self, instance: &Instance<'_>) -> Result<(), Unknown> {
        let Some(scope) = self.scopes.last_mut() else {
            return Ok(());
        };
        match instance {
            Instance::Instantiate { module_index, args } => {
                let mut requirements = *known(&scope.modules, *module_index)?;
                requirements.core_instances = 1;
                requirements.items = requirements.items.saturating_add(count(args.len()));
                scope.requirements.add(&requirements);
            }
            Instance::FromExports(exports) => scope.requirements.items += count(exports.len()),
        }
        Ok(())
    }

    /// An instance of a component.
    pub(super) fn instance(&mut self, instance: &ComponentInstance<'_>) -> Result<(), Unknown> {
        let Some(scope) = self.scopes.last_mut() else {
            return Ok(());
        };
        match instance {
            ComponentInstance::Instantiate {
                component_index,
                args,
            } => {
                let mut requirements = *known(&scope.components, *component_index)?;
                requirements.items = requirements.items.saturating_add(count(args.len()));
                let bytes = &mut requirements.instance_bytes;
                *bytes = bytes.saturating_add(COMPONENT_BYTES);
                scope.requirements.add(&requirements);
            }
            ComponentInstance::FromExports(exports) => {
                scope.requirements.items += count(exports.len())
            }
        }
        Ok(())
    }

    /// An alias gives an index to something of another component or instance.
    pub(super) fn alias(&mut self, alias: &ComponentAlias<'_>) {
        match alias {
            ComponentAlias::InstanceExport { kind, .. } => self.foreign(*kind),
            ComponentAlias::CoreInstanceExport { .. } => {}
            ComponentAlias::Outer { kind, count, index } => self.outer(*kind, *count, *index),
        }
    }

    fn outer(&mut self, kind: ComponentOuterAliasKind, count: u32, index: u32) {
        let position = usize::try_from(count)
            .ok()
            .and_then(|count| self.scopes.len().checked_sub(count.checked_add(1)?));
        let source = position.and_then(|position| self.scopes.get(position));
        let requirements = |space: fn(&Scope) -> &Vec<Option<Requirements>>| {
            let source = source.map(space)?;
            *source.get(usize::try_from(index).ok()?)?
        };
        match kind {
            ComponentOuterAliasKind::CoreModule => {
                let requirements = requirements(|scope| &scope.modules);
                self.push_module(requirements);
            }
            ComponentOuterAliasKind::Component => {
                let requirements = requirements(|scope| &scope.components);
                self.push_component(requirements);
            }
            _ => {}
        }
    }

    /// An import is foreign.
    pub(super) fn import(&mut self, ty: ComponentTypeRef) {
        self.foreign(ty.kind());
    }

    /// An export gives its item another index.
    pub(super) fn export(&mut self, kind: ComponentExternalKind, index: u32) {
        let Some(scope) = self.scopes.last() else {
            return;
        };
        let again = |space: &[Option<Requirements>]| known(space, index).ok().copied();
        match kind {
            ComponentExternalKind::Module => {
                let requirements = again(&scope.modules);
                self.push_module(requirements);
            }
            ComponentExternalKind::Component => {
                let requirements = again(&scope.components);
                self.push_component(requirements);
            }
            _ => {}
        }
    }

    fn foreign(&mut self, kind: ComponentExternalKind) {
        match kind {
            ComponentExternalKind::Module => self.push_module(None),
            ComponentExternalKind::Component => self.push_component(None),
            _ => {}
        }
    }

    fn push_module(&mut self, requirements: Option<Requirements>) {
        if let Some(scope) = self.scopes.last_mut() {
            scope.modules.push(requirements);
        }
    }

    fn push_component(&mut self, requirements: Option<Requirements>) {
        if let Some(scope) = self.scopes.last_mut() {
            scope.components.push(requirements);
        }
    }
}

fn known(space: &[Option<Requirements>], index: u32) -> Result<&Requirements, Unknown> {
    let item = usize::try_from(index)
        .ok()
        .and_then(|index| space.get(index))
        .ok_or(Unknown::Missing)?;
    item.as_ref().ok_or(Unknown::Foreign)
}

fn count(length: usize) -> u64 {
    u64::try_from(length).unwrap_or(u64::MAX)
}
