//! Bombs outside of functions: what a module initialises, and modules that are each small.

use std::fmt::Write as _;

/// Globals that are references to a function, set in one generated function. 40,000: 200 KB,
/// 6.5 s; its time grows with the square of them.
pub fn reference_globals(globals: u32) -> Vec<u8> {
    let global = "(global funcref (ref.func $f))";
    parse(&format!(
        "(module (func $f) {})",
        global.repeat(count(globals))
    ))
}

/// Globals that are all written in one function, and divisions after that. 40,000 globals: 420 KB,
/// 4.2 s.
pub fn written_globals(globals: u32, divisions: u32) -> Vec<u8> {
    let sets: String = (0..globals)
        .map(|global| format!("i32.const 0 global.set {global} "))
        .collect();
    let division = "local.get 0 local.get 0 i32.div_s drop ";
    parse(&format!(
        "(module {} (func (param i32) {sets} {}))",
        "(global (mut i32) i32.const 0)".repeat(count(globals)),
        division.repeat(count(divisions)),
    ))
}

/// Passive element segments of that many elements each.
pub fn passive_elements(segments: u32, elements: u32) -> Vec<u8> {
    let segment = format!("(elem func {})", "$f ".repeat(count(elements)));
    parse(&format!(
        "(module (func $f) {})",
        segment.repeat(count(segments))
    ))
}

/// Element segments whose places are not known before the module is instantiated.
pub fn placed_elements(segments: u32, elements: u32) -> Vec<u8> {
    let segment = format!(
        "(elem (global.get $at) func {})",
        "$f ".repeat(count(elements))
    );
    parse(&format!(
        r#"(module (import "m" "at" (global $at i32)) (func $f) (table 100000 funcref) {})"#,
        segment.repeat(count(segments))
    ))
}

/// Data segments of a memory that is imported. 8,000: 48 KB, 5 s.
pub fn placed_data(segments: u32) -> Vec<u8> {
    parse(&format!(
        r#"(module (import "m" "memory" (memory 1)) {})"#,
        r#"(data (i32.const 0) "x")"#.repeat(count(segments))
    ))
}

/// Functions with that many parameters that the host could call. 5,000 with 200: 30 KB, 9 s.
pub fn escaped_functions(functions: u32, parameters: u32) -> Vec<u8> {
    let names: String = (0..functions).map(|at| format!("{at} ")).collect();
    let function = format!("(func (param {}))", "i32 ".repeat(count(parameters)));
    parse(&format!(
        "(module (table {functions} funcref) (elem (i32.const 0) func {names}) {})",
        function.repeat(count(functions))
    ))
}

/// Modules of function types, each type another one. 5 modules of 5,000 types with 200 values:
/// 5 MB, 30 s and 900 MB.
pub fn function_types(modules: u32, types: u32, values: u32) -> Vec<u8> {
    let mut text = String::new();
    for module in 0..modules {
        text += "(core module ";
        for at in 0..types {
            text += "(type (func (param ";
            // The number of the type in binary, with two types as digits.
            let number = u64::from(module * types + at);
            for value in 0..values.max(1) {
                text += if value < 64 && number & (1 << value) != 0 {
                    "i64 "
                } else {
                    "i32 "
                };
            }
            text += ")))";
        }
        text += ")";
    }
    parse(&format!("(component {text})"))
}

/// Modules with memories of which only two bytes are initialised, 15 MiB apart.
pub fn sparse_memories(modules: u32, memories: u32) -> Vec<u8> {
    let mut module = String::from("(core module ");
    for memory in 0..memories {
        write!(
            module,
            r#"(memory 256) (data (memory {memory}) (i32.const 0) "x")
               (data (memory {memory}) (i32.const 0xf00000) "x")"#
        )
        .expect("a string takes everything");
    }
    module += ")";
    parse(&format!("(component {})", module.repeat(count(modules))))
}

/// Modules with tables of which only the last element is initialised. 50 of 33: 99 KB, 669 MB.
pub fn sparse_tables(modules: u32, tables: u32, elements: u32) -> Vec<u8> {
    let mut module = String::from("(core module (func $f) ");
    for table in 0..tables {
        write!(
            module,
            "(table {elements} funcref) (elem (table {table}) (i32.const {}) func $f)",
            elements.saturating_sub(1)
        )
        .expect("a string takes everything");
    }
    module += ")";
    parse(&format!("(component {})", module.repeat(count(modules))))
}

/// Modules with exports of one memory.
pub fn many_exports(modules: u32, exports: u32) -> Vec<u8> {
    let mut module = String::from("(core module (memory 0) ");
    for export in 0..exports {
        write!(module, r#"(export "{export}" (memory 0))"#).expect("a string takes everything");
    }
    module += ")";
    parse(&format!("(component {})", module.repeat(count(modules))))
}

/// Modules with one function each.
pub fn many_modules(modules: u32) -> Vec<u8> {
    parse(&format!(
        "(component {})",
        "(core module (func))".repeat(count(modules))
    ))
}

/// A module with passive elements that is instantiated again and again. 62 times 100,000:
/// 232 ms a match.
pub fn elements_of_instances(instances: u32, elements: u32) -> Vec<u8> {
    parse(&format!(
        "(component (core module $m (func $f) (elem func {})) {})",
        "$f ".repeat(count(elements)),
        "(core instance (instantiate $m))".repeat(count(instances))
    ))
}

/// A module with data that is instantiated again and again.
pub fn data_of_instances(instances: u32, bytes: u32) -> Vec<u8> {
    parse(&format!(
        r#"(component (core module $m (memory 256) (data (i32.const 0) "{}")) {})"#,
        "x".repeat(count(bytes)),
        "(core instance (instantiate $m))".repeat(count(instances))
    ))
}

/// Functions of a `br_table` each, whose targets are equal and take values. 200 tables of 20,000 with
/// 200 values: 4 MB, 31 s to validate.
pub fn equal_targets(tables: u32, targets: u32, values: u32) -> Vec<u8> {
    let value = "i32.const 0 ".repeat(count(values));
    let table = format!(
        "(func (block (type $t) {value} i32.const 0 br_table {}) {})",
        "0 ".repeat(count(targets)),
        "drop ".repeat(count(values))
    );
    let results = "i32 ".repeat(count(values));
    parse(&format!(
        "(module (type $t (func (result {results}))) {})",
        table.repeat(count(tables))
    ))
}

pub(super) fn parse(text: &str) -> Vec<u8> {
    wat::parse_str(text).expect("written here")
}

pub(super) fn count(number: u32) -> usize {
    usize::try_from(number).expect("usize has at least 32 bits")
}

/// Modules, the second one with each of its functions that many times: what the compiler keeps of the
/// first one makes those of the second take longer. A function with 800 KB of values on the operand
/// stack and 480 with 30 KB: 2 minutes, where they take 30 s by themselves.
pub fn followed_by(first: &[u8], second: &[u8], times: u32) -> Vec<u8> {
    let mut component = wasm_encoder::Component::new();
    let second = super::with_repeated_functions(second, times).expect("a core module");
    for data in [first, &second] {
        // A core module.
        component.section(&wasm_encoder::RawSection { id: 1, data });
    }
    component.finish()
}
