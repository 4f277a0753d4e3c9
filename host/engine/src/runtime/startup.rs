//! [`startup_fuel`]: what instantiating a robot costs besides the fuel of the code that runs.
//!
//! wasmtime takes fuel for what a module executes when it is instantiated, and nothing for most of
//! what it prepares: a segment of 100,000 functions in a module that is instantiated 60 times
//! takes a quarter of a second in each match. The price is computed from the component alone, so
//! it is the same on every machine. It counts against the fuel limit of the start and is not part
//! of the fuel that a match reports.
//!
//! Prices are for what a robot makes the host do. An image of a memory or a table ([`Images`]) is
//! a part of the compiled code, costs nothing however large it is, and is what all toolchains make.
//! What is no image is copied, at a price that ends a robot whose start would take about as long as a
//! match: Python robots have up to 18 MB of data, which is affordable even if all is copied.

use wasmparser::{
    ComponentAlias, ComponentExternalKind, ComponentInstance, ComponentOuterAliasKind, ConstExpr,
    DataKind, ElementItems, ElementKind, Encoding, Instance, Parser, Payload, Table, TableInit,
    TypeRef,
};

use crate::admission::constant::Constant;
use crate::admission::images::Images;

/// A core instance.
const INSTANCE: u64 = 10_000;

/// A page of initial memory. Writing all over it takes page faults that stores do not pay for.
const MEMORY_PAGE: u64 = 30_000;

/// An element of a table. Tables are wiped after a match.
const TABLE_ELEMENT: u64 = 10;

/// An element of a segment that is no image: a reference to a function is made.
const ELEMENT: u64 = 400;

/// A byte of a data segment that is no image.
const DATA_BYTE: u64 = 64;

/// A segment, and a global.
const ITEM: u64 = 10;

/// A page of linear memory, in bytes.
const PAGE_BYTES: u64 = 64 << 10;

/// What instantiating that component costs, in fuel. Parts that cannot be read cost nothing:
/// they are for validation to reject.
pub(super) fn startup_fuel(component: &[u8]) -> u64 {
    let mut scopes: Vec<Scope> = Vec::new();
    let mut module = None;
    for payload in Parser::new(0).parse_all(component) {
        let Ok(payload) = payload else { return 0 };
        match &payload {
            Payload::Version {
                encoding: Encoding::Module,
                ..
            } => module = Some(Module::default()),
            Payload::Version { .. } => scopes.push(Scope::default()),
            Payload::End(_) => match module.take() {
                Some(ended) => {
                    let fuel = ended.fuel();
                    match scopes.last_mut() {
                        Some(scope) => scope.modules.push(fuel),
                        None => return fuel,
                    }
                }
                None => {
                    let fuel = scopes.pop().map_or(0, |scope| scope.fuel);
                    match scopes.last_mut() {
                        Some(outer) => outer.components.push(fuel),
                        None => return fuel,
                    }
                }
            },
            _ => match &mut module {
                Some(module) => module.section(&payload),
                None => section(&mut scopes, &payload),
            },
        }
    }
    0
}

/// A component that is open: what its modules and components cost, and it itself.
#[derive(Default)]
struct Scope {
    modules: Vec<u64>,
    components: Vec<u64>,
    fuel: u64,
}

/// A section of the innermost component. Admission has rejected components that instantiate
/// what they import or take out of an instance, so nothing but an index is pushed for that.
fn section(scopes: &mut [Scope], payload: &Payload<'_>) {
    match payload {
        Payload::InstanceSection(section) => {
            for instance in section.clone().into_iter().flatten() {
                if let Instance::Instantiate { module_index, .. } = instance {
                    add(scopes, module_index, |scope| &scope.modules);
                }
            }
        }
        Payload::ComponentInstanceSection(section) => {
            for instance in section.clone().into_iter().flatten() {
                if let ComponentInstance::Instantiate {
                    component_index, ..
                } = instance
                {
                    add(scopes, component_index, |scope| &scope.components);
                }
            }
        }
        Payload::ComponentAliasSection(section) => {
            for alias in section.clone().into_iter().flatten() {
                match alias {
                    ComponentAlias::InstanceExport { kind, .. } => push(scopes, kind, 0),
                    ComponentAlias::CoreInstanceExport { .. } => {}
                    ComponentAlias::Outer { kind, count, index } => {
                        let depth = to_usize(count).saturating_add(1);
                        let scope = scopes.len().checked_sub(depth).map(|at| &scopes[at]);
                        let fuel = |space: fn(&Scope) -> &Vec<u64>| {
                            let fuel = scope.and_then(|scope| space(scope).get(to_usize(index)));
                            fuel.copied().unwrap_or(0)
                        };
                        match kind {
                            ComponentOuterAliasKind::CoreModule => {
                                let fuel = fuel(|scope| &scope.modules);
                                push(scopes, ComponentExternalKind::Module, fuel);
                            }
                            ComponentOuterAliasKind::Component => {
                                let fuel = fuel(|scope| &scope.components);
                                push(scopes, ComponentExternalKind::Component, fuel);
                            }
                            _ => {}
                        }
                    }
                }
            }
        }
        Payload::ComponentImportSection(section) => {
            for import in section.clone().into_iter().flatten() {
                push(scopes, import.ty.kind(), 0);
            }
        }
        Payload::ComponentExportSection(section) => {
            for export in section.clone().into_iter().flatten() {
                let fuel = scopes.last().and_then(|scope| match export.kind {
                    ComponentExternalKind::Module => scope.modules.get(to_usize(export.index)),
                    _ => scope.components.get(to_usize(export.index)),
                });
                let fuel = fuel.copied().unwrap_or(0);
                push(scopes, export.kind, fuel);
            }
        }
        _ => {}
    }
}

/// Something is instantiated.
fn add(scopes: &mut [Scope], index: u32, space: fn(&Scope) -> &Vec<u64>) {
    if let Some(scope) = scopes.last_mut() {
        let fuel = space(scope).get(to_usize(index)).copied().unwrap_or(0);
        scope.fuel = scope.fuel.saturating_add(fuel);
    }
}

/// A module or component gets an index.
fn push(scopes: &mut [Scope], kind: ComponentExternalKind, fuel: u64) {
    match (scopes.last_mut(), kind) {
        (Some(scope), ComponentExternalKind::Module) => scope.modules.push(fuel),
        (Some(scope), ComponentExternalKind::Component) => scope.components.push(fuel),
        _ => {}
    }
}

/// A core module that is being read.
#[derive(Default)]
struct Module {
    images: Images,
    data_bytes: u64,
    fuel: u64,
}

impl Module {
    fn section(&mut self, payload: &Payload<'_>) {
        match payload {
            Payload::ImportSection(section) => {
                for import in section.clone().into_imports().flatten() {
                    match import.ty {
                        TypeRef::Memory(_) => self.images.import_memory(),
                        TypeRef::Table(_) => self.images.import_table(),
                        _ => {}
                    }
                }
            }
            Payload::TableSection(section) => {
                for table in section.clone().into_iter().flatten() {
                    self.table(&table);
                }
            }
            Payload::MemorySection(section) => {
                for memory in section.clone().into_iter().flatten() {
                    self.memory(memory.initial);
                }
            }
            Payload::GlobalSection(section) => self.charge(section.count().into(), ITEM),
            Payload::ElementSection(section) => {
                self.charge(section.count().into(), ITEM);
                for element in section.clone().into_iter().flatten() {
                    self.elements(&element);
                }
            }
            Payload::DataSection(section) => {
                self.charge(section.count().into(), ITEM);
                for data in section.clone().into_iter().flatten() {
                    if let DataKind::Active {
                        memory_index,
                        offset_expr,
                    } = &data.kind
                    {
                        self.data(*memory_index, offset_expr, data.data.len());
                    }
                }
            }
            _ => {}
        }
    }

    fn charge(&mut self, count: u64, price: u64) {
        self.fuel = self.fuel.saturating_add(count.saturating_mul(price));
    }

    fn memory(&mut self, pages: u64) {
        self.charge(pages, MEMORY_PAGE);
        self.images.memory(pages.saturating_mul(PAGE_BYTES));
    }

    fn table(&mut self, table: &Table<'_>) {
        let elements = table.ty.initial;
        self.charge(elements, TABLE_ELEMENT);
        let is_function = match &table.init {
            TableInit::RefNull => None,
            TableInit::Expr(value) => {
                let value = Constant::read(value).unwrap_or_default();
                Some(value.function.is_some())
            }
        };
        if !self.images.table(elements, is_function) {
            self.charge(elements, ELEMENT);
        }
    }

    fn elements(&mut self, element: &wasmparser::Element<'_>) {
        let (count, are_functions) = match &element.items {
            ElementItems::Functions(items) => (u64::from(items.count()), true),
            ElementItems::Expressions(_, items) => (u64::from(items.count()), false),
        };
        match &element.kind {
            // Dropped before the robot runs, and never made.
            ElementKind::Declared => {}
            ElementKind::Passive => self.charge(count, ELEMENT),
            ElementKind::Active {
                table_index,
                offset_expr,
            } => {
                let table = table_index.unwrap_or(0);
                let offset = number(offset_expr);
                let images = &mut self.images;
                if !images.elements(table, offset, count, are_functions) {
                    self.charge(count, ELEMENT);
                }
            }
        }
    }

    fn data(&mut self, memory: u32, offset: &ConstExpr<'_>, bytes: usize) {
        let bytes = u64::try_from(bytes).unwrap_or(u64::MAX);
        self.data_bytes = self.data_bytes.saturating_add(bytes);
        self.images.data(memory, number(offset), bytes);
    }

    /// The price of one instance, when all is read.
    fn fuel(mut self) -> u64 {
        if self.images.is_data_copied() {
            self.charge(self.data_bytes, DATA_BYTE);
        }
        self.fuel.saturating_add(INSTANCE)
    }
}

/// The value of an expression that is one number.
fn number(expression: &ConstExpr<'_>) -> Option<u64> {
    Constant::read(expression).ok()?.number
}

fn to_usize(index: u32) -> usize {
    usize::try_from(index).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The price of these fields of a module, in one instance.
    #[track_caller]
    fn check(fields: &str, expected: u64) {
        let text = format!("(module {fields})");
        let module = wat::parse_str(&text).expect("a module");
        assert_eq!(startup_fuel(&module), INSTANCE + expected, "{fields}");
    }

    #[test]
    fn images_are_free_and_copies_are_not() {
        let page = MEMORY_PAGE;
        check("(memory 1)", page);
        check(r#"(memory 1) (data (i32.const 7) "abc")"#, page + ITEM);
        let copy = ITEM + 3 * DATA_BYTE;
        check(r#"(memory 1) (data (i32.const 65534) "abc")"#, page + copy);
        let imported = r#"(import "a" "m" (memory 1))"#;
        check(&format!(r#"{imported} (data (i32.const 7) "abc")"#), copy);
        let global = r#"(import "a" "g" (global i32)) (memory 1)"#;
        let data = r#"(data (global.get 0) "abc")"#;
        check(&format!("{global} {data}"), page + copy);
        let sparse = r#"(memory 512) (data (i32.const 0) "ab") (data (i32.const 0x1000000) "c")"#;
        check(sparse, 512 * page + copy + ITEM);
        check(r#"(memory 1) (data "abc")"#, page + ITEM);
    }

    #[test]
    fn elements_are_priced_where_references_are_made() {
        let table = 5 * TABLE_ELEMENT;
        let own = "(func $f) (table 5 funcref)";
        check(&format!("{own} (elem (i32.const 3) $f $f)"), table + ITEM);
        let two = ITEM + 2 * ELEMENT;
        check(&format!("{own} (elem func $f $f)"), table + two);
        check(&format!("{own} (elem (i32.const 4) $f $f)"), table + two);
        check(&format!("{own} (elem declare func $f $f)"), table + ITEM);
        // After one that is no image there is no image.
        let both = "(elem (i32.const 4) $f $f) (elem (i32.const 0) $f $f)";
        check(&format!("{own} {both}"), table + 2 * two);
        let imported = r#"(import "a" "t" (table 5 funcref)) (func $f)"#;
        check(&format!("{imported} (elem (i32.const 0) $f $f)"), two);
    }

    #[test]
    fn every_instance_is_counted() {
        let text = r#"(component
            (core module $m (memory 1))
            (core instance (instantiate $m))
            (component $inner
                (alias outer 1 $m (core module $again))
                (core instance (instantiate $again))
                (core instance (instantiate $again)))
            (instance (instantiate $inner))
            (instance (instantiate $inner)))"#;
        let component = wat::parse_str(text).expect("a component");
        assert_eq!(startup_fuel(&component), 5 * (INSTANCE + MEMORY_PAGE));
        assert_eq!(startup_fuel(b"no component"), 0);
    }
}
