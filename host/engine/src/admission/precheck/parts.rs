//! [`Parts`]: how large the types of component functions are when everything that
//! they name is written out.
//!
//! A tuple of two tuples of two tuples names a million values in a few bytes. What
//! moves values from one component to another is generated for each of them.

use std::collections::HashMap;

use wasmparser::component_types::{
    ComponentAnyTypeId, ComponentDefinedType, ComponentDefinedTypeId, ComponentFuncTypeId,
    ComponentValType,
};
use wasmparser::types::TypesRef;

/// Sizes of types, each computed once.
#[derive(Default)]
pub(super) struct Parts {
    known: HashMap<ComponentDefinedTypeId, u64>,
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
        if let Some(&size) = self.known.get(&id) {
            return size;
        }
        // Validation has rejected types that are nested deeper than 100.
        let size = self.of_defined(types, &types[id]);
        self.known.insert(id, size);
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
