//! Compile time: small files that are a lot of work for a compiler, or large ones.
//!
//! Each is a harmless robot with one more core module, which nobody instantiates and
//! which has to be compiled all the same.

use super::binary::section;
use super::case::{Case, harmless, rejected};
use crate::bombs;
use crate::composite::Composite;
use crate::module::wasm;

/// The cases 70 to 78, and siblings that were found later.
pub fn cases() -> Vec<Case> {
    [listed(), unloadable(), siblings()]
        .into_iter()
        .flatten()
        .collect()
}

/// Modules that nobody instantiates and that the engine would refuse to load all the same.
fn unloadable() -> Vec<Case> {
    let unloadable = |name: &str, what: &str, make: fn() -> String| {
        let expected = rejected("over-limit", &format!("the file has ... {what} (...)"));
        let module = move || wasm(&format!("(module {})", make()));
        Case::new(&[], name, expected, move || beside(&module()))
    };
    vec![
        unloadable(
            "unused-9-memories",
            "linear memories, and the limit is 8",
            || "(memory 1)".repeat(9),
        ),
        unloadable("unused-17-tables", "tables, and the limit is 16", || {
            "(table 1 funcref)".repeat(17)
        }),
        unloadable(
            "unused-table-of-10-million",
            "elements of one table at the start, and the limit is 100000",
            || "(table 10000000 funcref)".to_owned(),
        ),
        unloadable(
            "unused-memory-of-4-gib",
            "bytes of one linear memory at the start, and the limit is 268435456",
            || "(memory 65536)".to_owned(),
        ),
        unloadable(
            "unused-66000-globals",
            "bytes of state of one core instance, and the limit is 1048576",
            || "(global i32 (i32.const 0))".repeat(66_000),
        ),
        unloadable(
            "unused-33000-exports",
            "bytes of state of one core instance, and the limit is 1048576",
            || {
                let exports = (0..33_000).map(|at| format!("(func (export \"{at}\"))"));
                exports.collect()
            },
        ),
        unloadable(
            "unused-30000-imports",
            "bytes of state of one core instance, and the limit is 1048576",
            || {
                let imports = (0..30_000).map(|at| format!("(import \"a\" \"{at}\" (func))"));
                imports.collect()
            },
        ),
    ]
}

/// Files whose cost is in something else than their functions.
fn siblings() -> Vec<Case> {
    let over = |name: &str, make: fn() -> Vec<u8>| {
        Case::new(&[], name, rejected("over-limit", "the file has ..."), make)
    };
    vec![
        over("40000-globals-of-functions", || {
            beside(&bombs::reference_globals(40_000))
        }),
        over("60000-globals-written", || {
            beside(&bombs::written_globals(60_000, 0))
        }),
        over("60-segments-of-90000-elements", || {
            beside(&bombs::passive_elements(60, 90_000))
        }),
        over("sparse-memories", || bombs::sparse_memories(150, 8)),
        over("sparse-tables", || bombs::sparse_tables(150, 16, 100_000)),
        over("function-types-of-many-modules", || {
            bombs::function_types(30, 4000, 100)
        }),
        over("a-function-that-slows-480-others-down", || {
            let first = bombs::stacked_values(20, 5000);
            bombs::followed_by(&first, &bombs::stacked_values(43, 100), 480)
        }),
        over("values-that-are-loaded-again", || {
            let module = bombs::reused_loads(3000, 9);
            let repeated = bombs::with_repeated_functions(&module, 12);
            beside(&repeated.expect("a core module"))
        }),
        over("instance-types-that-are-compared", || {
            bombs::compared_instances(100, 10, 10)
        }),
        over("component-types-that-double", || {
            bombs::doubled_instances(30)
        }),
        // Its branches are counted, and there are not too many.
        Case::new(&[], "br-tables-with-values", harmless(), || {
            beside(&bombs::equal_targets(100, 1000, 100))
        }),
    ]
}

fn listed() -> Vec<Case> {
    let bomb = |numbers, name: &str, what: &str, make: fn() -> Vec<u8>| {
        let reason = format!("the file has ... {what} (...)");
        let expected = rejected("over-limit", &reason);
        Case::new(numbers, name, expected, move || beside(&make()))
    };
    let items = "items of one kind in a core module, and the limit is 100000";
    let loops = "nested loops, and the limit is 64";
    let bytes = "bytes in a function, and the limit is 1048576";
    let too_many_locals = "the component is not valid: too many locals: ... at byte ...";
    vec![
        bomb(&[70], "1000-nested-loops", loops, || {
            bombs::nested_loops(1000)
        }),
        bomb(&[70], "10000-nested-loops", loops, || {
            bombs::nested_loops(10_000)
        }),
        bomb(
            &[71],
            "10000-locals-with-branches",
            "variables times blocks in a function, and the limit is 64000000",
            || bombs::locals_and_branches(10_000, 10_000),
        ),
        Case::new(
            &[71],
            "50000-locals-in-a-function",
            rejected("invalid", too_many_locals),
            || beside(&bombs::locals_and_branches(50_000, 0)),
        ),
        bomb(&[72], "a-wall-of-br-tables", bytes, || {
            bombs::branch_tables(1000, 1000)
        }),
        bomb(
            &[73],
            "a-million-functions",
            "functions, and the limit is 60000",
            || bombs::empty_functions(1_000_000),
        ),
        bomb(&[74], "a-function-of-7-mb", bytes, || {
            bombs::long_function(7_600_000)
        }),
        bomb(
            &[75],
            "calls-with-1000-parameters",
            "parameters and results of one function or block, and the limit is 200",
            || bombs::wide_calls(1000, 1000),
        ),
        bomb(
            &[76],
            "a-constant-expression-of-a-megabyte",
            "bytes in a constant expression, and the limit is 200",
            || bombs::constant(350_000),
        ),
        bomb(&[77], "a-million-globals", items, || {
            bombs::globals(1_000_000)
        }),
        bomb(&[77], "a-million-exports", items, || {
            bombs::exports(1_000_000)
        }),
        bomb(
            &[77],
            "a-million-types",
            "function types in a core module, and the limit is 5000",
            || bombs::types(1_000_000),
        ),
        bomb(&[78], "a-block-of-simd", bytes, || bombs::simd(1_000_000)),
        // Large, but not a bomb.
        Case::new(&[74], "a-function-of-100-kb", harmless(), || {
            beside(&bombs::long_function(100_000))
        }),
    ]
}

/// A harmless robot with one more module.
fn beside(module: &[u8]) -> Vec<u8> {
    const CORE_MODULE_SECTION: u8 = 1;
    let robot = Composite::default().component();
    [robot, section(CORE_MODULE_SECTION, module)].concat()
}
