//! What admission admits, the engine loads: also modules that nothing instantiates. A component
//! that the engine refuses to load would be compiled in vain, and found out too late.

use proptest::prelude::*;
use wasmouse_engine::admission::precheck::precheck;
use wasmouse_engine::{AdmissionLimits, Limits, engine_config};
use wasmouse_tests::bombs;
use wasmtime::Engine;
use wasmtime::component::Component;

/// Small limits, so that what is at a limit compiles soon.
fn limits() -> Limits {
    let mut limits = Limits {
        admission: AdmissionLimits {
            core_instances_max: 8,
            memories_max: 3,
            tables_max: 4,
            core_instance_bytes_max: 24 << 10,
            component_instance_bytes_max: 40 << 10,
            ..AdmissionLimits::DEFAULT
        },
        ..Limits::default()
    };
    limits.sandbox.memory_bytes_max = 4 << 20;
    limits.sandbox.table_elements_max = 1000;
    limits
}

fn engine(limits: &Limits) -> Engine {
    Engine::new(&engine_config(limits, 1)).expect("address space for one match")
}

/// A component with a module that has those fields, instantiated that often.
fn component(fields: &str, instances: usize) -> Vec<u8> {
    let instance = "(core instance (instantiate $m))".repeat(instances);
    let text = format!("(component (core module $m (func $f) {fields}) {instance})");
    wat::parse_str(text).expect("written here")
}

/// Requires that the most that is admitted loads, and that the engine refuses hardly more.
#[track_caller]
fn check(what: &str, instances: usize, fields: impl Fn(u32) -> String) {
    let limits = limits();
    let engine = engine(&limits);
    let file = |number| component(&fields(number), instances);
    let is_admitted = |number| precheck(&file(number), &limits).is_ok();
    let (mut admitted, mut rejected) = (0, 1 << 12);
    assert!(is_admitted(admitted) && !is_admitted(rejected), "{what}");
    while rejected - admitted > 1 {
        let middle = u32::midpoint(admitted, rejected);
        if is_admitted(middle) {
            admitted = middle;
        } else {
            rejected = middle;
        }
    }
    let loaded = Component::from_binary(&engine, &file(admitted));
    if let Err(error) = loaded {
        panic!("{admitted} {what} are admitted and not loaded: {error:#}");
    }
    // What every instance has is rounded up.
    let instances = u32::try_from(instances).expect("a small number");
    let above = rejected + rejected * (instances + 1) / 16;
    let refused = Component::from_binary(&engine, &file(above)).err();
    let refused = refused.unwrap_or_else(|| panic!("{rejected} {what} are rejected for nothing"));
    assert!(format!("{refused:#}").contains("exceed"), "{refused:#}");
}

#[test]
fn the_limits_of_a_module_are_those_of_the_engine() {
    let many = |what: &'static str| move |number| what.repeat(usize::try_from(number).unwrap());
    for instances in [0, 1] {
        check("memories", instances, many("(memory 0)"));
        check("tables", instances, many("(table 0 funcref)"));
        check("elements", instances, |number| {
            format!("(table {number} funcref)")
        });
        check("pages", instances, |number| format!("(memory {number})"));
    }
    check("globals", 0, many("(global i32 (i32.const 0))"));
    check(
        "mutable vectors",
        0,
        many("(global (mut v128) (v128.const i64x2 0 0))"),
    );
    check("passive data segments", 0, many(r#"(data "x")"#));
    check("exported functions", 0, |number| {
        let export = |at| format!(r#"(func (export "{at}"))"#);
        (0..number).map(export).collect()
    });
    check("functions in a table", 0, |number| {
        let names: String = (0..number).map(|at| format!("$f{at} ")).collect();
        let functions: String = (0..number).map(|at| format!("(func $f{at})")).collect();
        format!("{functions} (elem declare func {names})")
    });
}

#[test]
fn the_limits_on_imports_are_those_of_the_engine() {
    for (what, import) in [
        ("imported functions", "(func)"),
        ("imported globals", "(global i32)"),
        ("imported memories", "(memory 0)"),
        ("imported tables", "(table 0 funcref)"),
    ] {
        let limits = limits();
        let engine = engine(&limits);
        let file = |number: u32| {
            let import = |at| format!(r#"(import "m" "{at}" {import})"#);
            let imports: String = (0..number).map(import).collect();
            wat::parse_str(format!("(component (core module {imports}))")).expect("written here")
        };
        let is_admitted = |number| precheck(&file(number), &limits).is_ok();
        // Validation has a limit of its own on memories.
        let admitted = (0..4000)
            .rev()
            .step_by(7)
            .find(|&number| is_admitted(number));
        let admitted = admitted.expect("some imports are admitted");
        let loaded = Component::from_binary(&engine, &file(admitted));
        // The compiler has an older limit on imported tables.
        let refused = loaded.err().map(|error| format!("{error:#}"));
        let refused = refused.filter(|error| error.contains("pool"));
        assert_eq!(refused, None, "{admitted} {what} are admitted");
    }
}

#[test]
fn the_limit_of_all_instances_is_that_of_the_engine() {
    let global = "(global i32 (i32.const 0))";
    for instances in [2, 7] {
        check("globals of instances", instances, |number| {
            global.repeat(usize::try_from(number).expect("a small number"))
        });
    }
}

/// Adapters are modules that the compiler adds.
#[test]
fn adapters_are_loaded() {
    let limits = Limits::default();
    let engine = engine(&limits);
    for (functions, parameters) in [(1, 0), (100, 3), (200, 1), (20, 20)] {
        let file = bombs::adapters(functions, parameters);
        precheck(&file, &limits).expect("within the limits");
        let loaded = Component::from_binary(&engine, &file);
        if let Err(error) = loaded {
            panic!("{functions} adapters are admitted and not loaded: {error:#}");
        }
    }
}

/// Nine memories in a module that nothing instantiates: 2.6 KB that once ended a contest.
#[test]
fn a_module_that_nothing_instantiates_is_checked_like_any_other() {
    let limits = Limits::default();
    for (fields, expected) in [
        (
            "(memory 1)".repeat(9),
            "9 linear memories, and the limit is 8",
        ),
        (
            "(table 1 funcref)".repeat(17),
            "17 tables, and the limit is 16",
        ),
        (
            "(table 100001 funcref)".to_owned(),
            "100001 elements of one table at the start, and the limit is 100000",
        ),
        (
            "(memory 65536)".to_owned(),
            "4294967296 bytes of one linear memory at the start, and the limit is 268435456",
        ),
        (
            "(global i32 (i32.const 0))".repeat(66_000),
            "bytes of state of one core instance, and the limit is 1048576",
        ),
        (
            (0..33_000)
                .map(|at| format!(r#"(export "{at}" (func $g{at})) (func $g{at})"#))
                .collect(),
            "bytes of state of one core instance, and the limit is 1048576",
        ),
    ] {
        let rejection = precheck(&component(&fields, 0), &limits).expect_err(expected);
        let found = rejection.to_string();
        assert!(found.contains(expected), "{found}\nexpected {expected}");
        assert!(found.contains("(core module 0, byte "), "{found}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Whatever is admitted and compiled is loaded.
    #[test]
    fn what_is_admitted_and_compiled_is_loaded(
        instances in 0_usize..9,
        memories in 0_usize..5,
        pages in 0_usize..80,
        tables in 0_usize..6,
        elements in 0_usize..1100,
        globals in 0_usize..1200,
        references in 0_usize..200,
        functions in 0_usize..400,
        data in 0_usize..1200,
        passive in 0_usize..1200,
    ) {
        let names: String = (0..functions).map(|at| format!("$g{at} ")).collect();
        let fields = [
            format!("(memory {pages})").repeat(memories),
            format!("(table {elements} funcref)").repeat(tables),
            "(global (mut i64) (i64.const 0))".repeat(globals),
            "(global funcref (ref.func $f))".repeat(references),
            (0..functions).map(|at| format!("(func $g{at})")).collect(),
            format!("(elem declare func {names})"),
            if memories > 0 { r#"(data (i32.const 0) "x")"#.repeat(data) } else { String::new() },
            r#"(data "x")"#.repeat(passive),
        ]
        .concat();
        let limits = limits();
        let file = component(&fields, instances);
        if precheck(&file, &limits).is_ok() {
            let loaded = Component::from_binary(&engine(&limits), &file);
            if let Err(error) = loaded {
                prop_assert!(false, "{error:#}");
            }
        }
    }
}
