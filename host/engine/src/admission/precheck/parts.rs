//! [`Parts`]: how large types of components are when everything that they name is
//! written out.
//!
//! A tuple of two tuples of two tuples names a million values in a few bytes. What
//! moves values from one component to another is generated for each of them, and whatever
//! compares two types, or makes a copy of one, goes through all of them.

use std::collections::HashMap;

use wasmparser::component_types::{
    ComponentAnyTypeId, ComponentCoreModuleTypeId, ComponentCoreTypeId, ComponentDefinedType,
    ComponentEntityType, ComponentFuncTypeId, ComponentInstanceTypeId, ComponentItem,
    ComponentTypeId, ComponentValType,
};
use wasmparser::types::TypesRef;
use wasmparser::{ComponentExternalKind, ComponentTypeRef, TypeBounds};

/// Comparing or copying that many bytes of a name takes about as long as a part.
const NAME_BYTES: u64 = 32;

/// A component type is gone through twice, because its imports and exports are compared in
/// different directions, and each component type inside of it again.
const COMPONENT_FACTOR: u64 = 2;

/// Sizes of types, each computed once.
#[derive(Default)]
pub(super) struct Parts {
    known: HashMap<ComponentAnyTypeId, u64>,
    modules: HashMap<ComponentCoreModuleTypeId, u64>,
}

/// Parts of an import or export with that name and that many parts in its type.
pub(super) fn of_named(name: &str, parts: u64) -> u64 {
    (1 + count(name.len()) / NAME_BYTES).saturating_add(parts)
}

/// Parts of a component type, by those of its imports and exports.
pub(super) const fn of_component(items: u64) -> u64 {
    items.saturating_add(1).saturating_mul(COMPONENT_FACTOR)
}

impl Parts {
    /// Of the type with that index, when it is one of functions.
    pub(super) fn of_function_type(&mut self, types: TypesRef<'_>, index: u32) -> u64 {
        if index >= types.component_type_count() {
            return 0;
        }
        match types.component_any_type_at(index) {
            ComponentAnyTypeId::Func(id) => self.of_signature(types, id),
            _ => 0,
        }
    }

    /// Of the type of the function with that index, which validation has seen.
    pub(super) fn of_function(&mut self, types: TypesRef<'_>, index: u32) -> u64 {
        if index >= types.component_function_count() {
            return 0;
        }
        self.of_signature(types, types.component_function_at(index))
    }

    /// Of what has that index in the index space of its kind.
    pub(super) fn of_item(
        &mut self,
        types: TypesRef<'_>,
        kind: ComponentExternalKind,
        index: u32,
    ) -> u64 {
        match kind {
            ComponentExternalKind::Module if index < types.module_count() => {
                self.of_module(types, types.module_at(index))
            }
            ComponentExternalKind::Func => self.of_function(types, index),
            ComponentExternalKind::Type => self.of_type(types, index),
            ComponentExternalKind::Instance if index < types.component_instance_count() => {
                self.of_instance(types, types.component_instance_at(index))
            }
            ComponentExternalKind::Component if index < types.component_count() => {
                self.of_component(types, types.component_at(index))
            }
            _ => 1,
        }
    }

    /// Of what an import or export is said to be.
    pub(super) fn of_reference(&mut self, types: TypesRef<'_>, ty: &ComponentTypeRef) -> u64 {
        match *ty {
            ComponentTypeRef::Module(index) => self.of_core_type(types, index),
            ComponentTypeRef::Func(index)
            | ComponentTypeRef::Instance(index)
            | ComponentTypeRef::Component(index)
            | ComponentTypeRef::Type(TypeBounds::Eq(index)) => self.of_type(types, index),
            ComponentTypeRef::Value(wasmparser::ComponentValType::Type(index)) => {
                self.of_type(types, index)
            }
            ComponentTypeRef::Value(_) | ComponentTypeRef::Type(TypeBounds::SubResource) => 1,
        }
    }

    /// Of the type with that index.
    pub(super) fn of_type(&mut self, types: TypesRef<'_>, index: u32) -> u64 {
        if index >= types.component_type_count() {
            return 1;
        }
        self.of_any(types, types.component_any_type_at(index))
    }

    /// Of the core type with that index.
    pub(super) fn of_core_type(&mut self, types: TypesRef<'_>, index: u32) -> u64 {
        if index >= types.core_type_count_in_component() {
            return 1;
        }
        match types.core_type_at_in_component(index) {
            ComponentCoreTypeId::Module(id) => self.of_module(types, id),
            ComponentCoreTypeId::Sub(_) => 1,
        }
    }

    fn of_any(&mut self, types: TypesRef<'_>, id: ComponentAnyTypeId) -> u64 {
        match id {
            ComponentAnyTypeId::Resource(_) => 1,
            ComponentAnyTypeId::Defined(id) => self.of_value(types, ComponentValType::Type(id)),
            ComponentAnyTypeId::Func(id) => self.of_signature(types, id),
            ComponentAnyTypeId::Instance(id) => self.of_instance(types, id),
            ComponentAnyTypeId::Component(id) => self.of_component(types, id),
        }
    }

    fn of_instance(&mut self, types: TypesRef<'_>, id: ComponentInstanceTypeId) -> u64 {
        if let Some(&parts) = self.known.get(&id.into()) {
            return parts;
        }
        let parts = self.of_items(types, types[id].exports.iter());
        self.known.insert(id.into(), parts);
        parts
    }

    fn of_component(&mut self, types: TypesRef<'_>, id: ComponentTypeId) -> u64 {
        if let Some(&parts) = self.known.get(&id.into()) {
            return parts;
        }
        let ty = &types[id];
        let parts = of_component(self.of_items(types, ty.imports.iter().chain(&ty.exports)));
        self.known.insert(id.into(), parts);
        parts
    }

    fn of_items<'a>(
        &mut self,
        types: TypesRef<'_>,
        items: impl Iterator<Item = (&'a String, &'a ComponentItem)>,
    ) -> u64 {
        items.fold(1, |sum, (name, item)| {
            let parts = match item.ty {
                ComponentEntityType::Module(id) => self.of_module(types, id),
                ComponentEntityType::Func(id) => self.of_signature(types, id),
                ComponentEntityType::Value(ty) => self.of_value(types, ty),
                ComponentEntityType::Type { referenced, .. } => self.of_any(types, referenced),
                ComponentEntityType::Instance(id) => self.of_instance(types, id),
                ComponentEntityType::Component(id) => self.of_component(types, id),
            };
            sum.saturating_add(of_named(name, parts))
        })
    }

    fn of_module(&mut self, types: TypesRef<'_>, id: ComponentCoreModuleTypeId) -> u64 {
        if let Some(&parts) = self.modules.get(&id) {
            return parts;
        }
        let ty = &types[id];
        let imports = ty
            .imports
            .keys()
            .map(|(module, name)| module.len() + name.len());
        let exports = ty.exports.keys().map(String::len);
        let parts = imports
            .chain(exports)
            .fold(1, |sum: u64, bytes| sum + 1 + count(bytes) / NAME_BYTES);
        self.modules.insert(id, parts);
        parts
    }

    fn of_signature(&mut self, types: TypesRef<'_>, id: ComponentFuncTypeId) -> u64 {
        let signature = &types[id];
        let parameters = signature.params.iter().map(|(_, ty)| *ty);
        self.sum(types, parameters.chain(signature.result))
    }

    fn sum(&mut self, types: TypesRef<'_>, parts: impl Iterator<Item = ComponentValType>) -> u64 {
        parts.fold(1, |sum, ty| sum.saturating_add(self.of_value(types, ty)))
    }

    fn of_value(&mut self, types: TypesRef<'_>, ty: ComponentValType) -> u64 {
        let ComponentValType::Type(id) = ty else {
            return 1;
        };
        if let Some(&size) = self.known.get(&id.into()) {
            return size;
        }
        // Validation has rejected types that are nested deeper than 100.
        let size = self.of_defined(types, &types[id]);
        self.known.insert(id.into(), size);
        size
    }

    fn of_defined(&mut self, types: TypesRef<'_>, ty: &ComponentDefinedType) -> u64 {
        use ComponentDefinedType as Type;
        match ty {
            Type::Record(record) => self.sum(types, record.fields.values().copied()),
            Type::Variant(variant) => {
                let cases = count(variant.cases.len());
                let payloads = variant.cases.values().filter_map(|case| case.ty);
                cases.saturating_add(self.sum(types, payloads))
            }
            Type::Tuple(tuple) => self.sum(types, tuple.types.iter().copied()),
            Type::List { element, .. } => self.sum(types, [*element].into_iter()),
            Type::Map { key, value, .. } => self.sum(types, [*key, *value].into_iter()),
            Type::FixedLengthList {
                element, length, ..
            } => self
                .of_value(types, *element)
                .saturating_mul((*length).into()),
            Type::Flags(names) | Type::Enum(names) => count(names.len()),
            Type::Option { ty, .. } => self.sum(types, [*ty].into_iter()),
            Type::Result { ok, err, .. } => self.sum(types, [*ok, *err].into_iter().flatten()),
            Type::Primitive(_)
            | Type::Own(_)
            | Type::Borrow(_)
            | Type::Future { .. }
            | Type::Stream { .. } => 1,
        }
    }
}

fn count(length: usize) -> u64 {
    u64::try_from(length).unwrap_or(u64::MAX)
}
