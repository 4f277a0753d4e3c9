//! [`Declared`]: how large a type is that a component declares, and what it takes to validate
//! it, known before it is validated.
//!
//! One declaration may contain thousands of others, each of which names the ones before it.
//! They are gone through here once, with the size of each known, so that sizes that grow
//! exponentially do no harm. Like [`Parts`], for types that validation has not seen.

use std::collections::HashMap;
use std::rc::Rc;

use wasmparser::{
    ComponentAlias, ComponentDefinedType, ComponentOuterAliasKind, ComponentType,
    ComponentTypeDeclaration, ComponentTypeRef, ComponentValType, CoreType,
    InstanceTypeDeclaration, ModuleTypeDeclaration, TypeBounds, Validator,
};

use super::parts::{self, Parts};

/// What is known of a type or of an instance.
#[derive(Clone, Debug)]
struct Known<'a> {
    parts: u64,
    /// Parts of its exports, where it is an instance.
    exports: Option<Rc<HashMap<&'a str, u64>>>,
}

impl Known<'_> {
    const fn of(parts: u64) -> Self {
        Self {
            parts,
            exports: None,
        }
    }
}

/// The index spaces of one declaration that is open.
#[derive(Debug, Default)]
struct Scope<'a> {
    types: Vec<Known<'a>>,
    core_types: Vec<u64>,
    instances: Vec<Known<'a>>,
    /// Parts of its imports and exports.
    items: u64,
    exports: HashMap<&'a str, u64>,
}

/// The declaration of one type of the innermost component.
pub(super) struct Declared<'a, 'v> {
    validator: &'v Validator,
    parts: &'v mut Parts,
    /// The declarations that are open, the innermost last.
    scopes: Vec<Scope<'a>>,
    work: u64,
}

impl<'a, 'v> Declared<'a, 'v> {
    /// Parts that are gone through to validate the declaration.
    pub(super) fn work(
        ty: &ComponentType<'a>,
        validator: &'v Validator,
        parts: &'v mut Parts,
    ) -> u64 {
        let mut declared = Self {
            validator,
            parts,
            scopes: Vec::new(),
            work: 0,
        };
        declared.ty(ty);
        declared.work
    }

    fn ty(&mut self, ty: &ComponentType<'a>) -> Known<'a> {
        let known = match ty {
            ComponentType::Defined(ty) => Known::of(self.defined(ty)),
            ComponentType::Func(ty) => {
                let parameters = ty.params.iter().map(|(_, ty)| *ty);
                Known::of(self.sum(parameters.chain(ty.result)))
            }
            ComponentType::Resource { .. } => Known::of(1),
            ComponentType::Instance(declarations) => {
                self.scopes.push(Scope::default());
                for declaration in declarations {
                    match declaration {
                        InstanceTypeDeclaration::CoreType(ty) => self.core_type(ty),
                        InstanceTypeDeclaration::Type(ty) => self.declare(ty),
                        InstanceTypeDeclaration::Alias(alias) => self.alias(alias),
                        InstanceTypeDeclaration::Export { name, ty } => self.export(name.name, *ty),
                    }
                }
                let scope = self.scopes.pop().unwrap_or_default();
                Known {
                    parts: scope.items.saturating_add(1),
                    exports: Some(Rc::new(scope.exports)),
                }
            }
            ComponentType::Component(declarations) => {
                self.scopes.push(Scope::default());
                for declaration in declarations {
                    match declaration {
                        ComponentTypeDeclaration::CoreType(ty) => self.core_type(ty),
                        ComponentTypeDeclaration::Type(ty) => self.declare(ty),
                        ComponentTypeDeclaration::Alias(alias) => self.alias(alias),
                        ComponentTypeDeclaration::Export { name, ty } => {
                            self.export(name.name, *ty);
                        }
                        ComponentTypeDeclaration::Import(import) => {
                            self.item(import.name.name, import.ty);
                        }
                    }
                }
                let scope = self.scopes.pop().unwrap_or_default();
                Known::of(parts::of_component(scope.items))
            }
        };
        self.work = self.work.saturating_add(known.parts);
        known
    }

    fn declare(&mut self, ty: &ComponentType<'a>) {
        let known = self.ty(ty);
        if let Some(scope) = self.scopes.last_mut() {
            scope.types.push(known);
        }
    }

    fn core_type(&mut self, ty: &CoreType<'a>) {
        let parts = of_core_type(ty);
        self.work = self.work.saturating_add(parts);
        if let Some(scope) = self.scopes.last_mut() {
            scope.core_types.push(parts);
        }
    }

    fn export(&mut self, name: &'a str, ty: ComponentTypeRef) {
        let parts = self.item(name, ty);
        if let Some(scope) = self.scopes.last_mut() {
            scope.exports.insert(name, parts);
        }
    }

    /// An import or export. Returns the parts of its type.
    fn item(&mut self, name: &'a str, ty: ComponentTypeRef) -> u64 {
        let known = match ty {
            ComponentTypeRef::Module(index) => Known::of(self.core_type_at(0, index)),
            ComponentTypeRef::Func(index)
            | ComponentTypeRef::Instance(index)
            | ComponentTypeRef::Component(index)
            | ComponentTypeRef::Type(TypeBounds::Eq(index)) => self.type_at(0, index),
            ComponentTypeRef::Value(ty) => Known::of(self.value(ty)),
            ComponentTypeRef::Type(TypeBounds::SubResource) => Known::of(1),
        };
        let parts = known.parts;
        self.work = self.work.saturating_add(parts::of_named(name, parts));
        if let Some(scope) = self.scopes.last_mut() {
            scope.items = scope.items.saturating_add(parts::of_named(name, parts));
            match ty {
                ComponentTypeRef::Type(_) => scope.types.push(known),
                ComponentTypeRef::Instance(_) => scope.instances.push(known),
                _ => {}
            }
        }
        parts
    }

    fn alias(&mut self, alias: &ComponentAlias<'a>) {
        self.work = self.work.saturating_add(1);
        match *alias {
            ComponentAlias::Outer { kind, count, index } => match kind {
                ComponentOuterAliasKind::Type => {
                    let known = self.type_at(count, index);
                    if let Some(scope) = self.scopes.last_mut() {
                        scope.types.push(known);
                    }
                }
                ComponentOuterAliasKind::CoreType => {
                    let parts = self.core_type_at(count, index);
                    if let Some(scope) = self.scopes.last_mut() {
                        scope.core_types.push(parts);
                    }
                }
                ComponentOuterAliasKind::CoreModule | ComponentOuterAliasKind::Component => {}
            },
            ComponentAlias::InstanceExport {
                kind,
                instance_index,
                name,
            } => {
                let Some(scope) = self.scopes.last_mut() else {
                    return;
                };
                let instance = usize::try_from(instance_index).ok();
                let instance = instance.and_then(|index| scope.instances.get(index));
                // An export is at most as large as the instance.
                let parts = instance.map_or(1, |instance| {
                    let exports = instance.exports.as_ref();
                    let export = exports.and_then(|exports| exports.get(name));
                    *export.unwrap_or(&instance.parts)
                });
                match kind {
                    wasmparser::ComponentExternalKind::Type => scope.types.push(Known::of(parts)),
                    wasmparser::ComponentExternalKind::Instance => {
                        scope.instances.push(Known::of(parts));
                    }
                    _ => {}
                }
            }
            ComponentAlias::CoreInstanceExport { .. } => {}
        }
    }

    fn sum(&mut self, values: impl Iterator<Item = ComponentValType>) -> u64 {
        values.fold(1, |sum, ty| sum.saturating_add(self.value(ty)))
    }

    fn value(&mut self, ty: ComponentValType) -> u64 {
        match ty {
            ComponentValType::Primitive(_) => 1,
            ComponentValType::Type(index) => self.type_at(0, index).parts,
        }
    }

    fn defined(&mut self, ty: &ComponentDefinedType<'a>) -> u64 {
        use ComponentDefinedType as Type;
        match ty {
            Type::Record(fields) => self.sum(fields.iter().map(|(_, ty)| *ty)),
            Type::Variant(cases) => {
                let payloads = self.sum(cases.iter().filter_map(|case| case.ty));
                payloads.saturating_add(count(cases.len()))
            }
            Type::Tuple(types) => self.sum(types.iter().copied()),
            // Validation rejects lists of a fixed length.
            Type::List(ty) | Type::Option(ty) | Type::FixedLengthList(ty, _) => {
                self.sum([*ty].into_iter())
            }
            Type::Map(key, value) => self.sum([*key, *value].into_iter()),
            Type::Flags(names) | Type::Enum(names) => count(names.len()),
            Type::Result { ok, err } => self.sum([*ok, *err].into_iter().flatten()),
            Type::Future(ty) | Type::Stream(ty) => self.sum((*ty).into_iter()),
            Type::Primitive(_) | Type::Own(_) | Type::Borrow(_) => 1,
        }
    }

    /// The type with that index, that many declarations and components outwards.
    fn type_at(&mut self, outwards: u32, index: u32) -> Known<'a> {
        match self.scope_at(outwards) {
            Ok(scope) => {
                let known = usize::try_from(index).ok();
                let known = known.and_then(|index| self.scopes[scope].types.get(index));
                known.cloned().unwrap_or(Known::of(1))
            }
            Err(level) => Known::of(
                self.validator
                    .types(level)
                    .map_or(1, |types| self.parts.of_type(types, index)),
            ),
        }
    }

    /// Parts of the core type with that index, that many declarations and components outwards.
    fn core_type_at(&mut self, outwards: u32, index: u32) -> u64 {
        match self.scope_at(outwards) {
            Ok(scope) => {
                let parts = usize::try_from(index).ok();
                let parts = parts.and_then(|index| self.scopes[scope].core_types.get(index));
                parts.copied().unwrap_or(1)
            }
            Err(level) => self
                .validator
                .types(level)
                .map_or(1, |types| self.parts.of_core_type(types, index)),
        }
    }

    /// Which of the scopes that is; or, beyond all of them, which of the components.
    fn scope_at(&self, outwards: u32) -> Result<usize, usize> {
        let outwards = usize::try_from(outwards).unwrap_or(usize::MAX);
        match self.scopes.len().checked_sub(outwards.saturating_add(1)) {
            Some(scope) => Ok(scope),
            None => Err(outwards - self.scopes.len()),
        }
    }
}

/// Parts of a core type, and of a module type with all that it declares.
pub(super) fn of_core_type(ty: &CoreType<'_>) -> u64 {
    match ty {
        CoreType::Rec(_) => 1,
        CoreType::Module(declarations) => declarations.iter().fold(1, |sum, declaration| {
            let parts = match declaration {
                ModuleTypeDeclaration::Import(import) => {
                    parts::of_named(import.module, parts::of_named(import.name, 0))
                }
                ModuleTypeDeclaration::Export { name, .. } => parts::of_named(name, 0),
                ModuleTypeDeclaration::Type(_) | ModuleTypeDeclaration::OuterAlias { .. } => 1,
            };
            parts.saturating_add(sum)
        }),
    }
}

fn count(length: usize) -> u64 {
    u64::try_from(length).unwrap_or(u64::MAX)
}
