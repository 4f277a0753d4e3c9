//! The check before compilation: every limit is exact, files that would take a compiler minutes
//! are rejected at once, and damaged files cause no panic.

use std::time::Instant;

use proptest::prelude::*;
use wasmouse_engine::admission::BinaryKind;
use wasmouse_engine::admission::precheck::{Measure, Measures, precheck};
use wasmouse_engine::bundled::bundled;
use wasmouse_engine::{Limits, engine_config};
use wasmouse_tests::{bombs, corpus};
use wasmtime::component::Component;

/// The most that a decision may take here, unoptimised and beside other tests: far
/// more than it does, and far less than compiling would.
const SECONDS_MAX: u64 = 30;

/// Requires that the file is rejected soon, and returns the rejection after its name.
#[track_caller]
fn rejection(file: &[u8], what: &str) -> String {
    let start = Instant::now();
    let rejection = precheck(file, &Limits::default()).expect_err(what);
    let seconds = start.elapsed().as_secs();
    assert!(seconds < SECONDS_MAX, "{rejection}: {seconds} s");
    format!("{}: {rejection}", rejection.name().escaped())
}

#[track_caller]
fn check(file: &[u8], expected: &str) {
    let found = rejection(file, expected);
    assert!(found.starts_with(expected), "{found}\nexpected {expected}");
}

#[test]
fn bombs_are_rejected_for_what_makes_them_one() {
    let nested = "over-limit: the file has 65 nested loops, and the limit is 64 \
        (function 0 `bomb`, byte ";
    check(&bombs::nested_loops(1000), nested);
    check(&bombs::nested_loops(10_000), nested);
    check(
        &bombs::nested_blocks(10_000),
        "over-limit: the file has 4001 nested blocks, and the limit is 4000 ",
    );
    for (file, what) in [
        (
            bombs::locals_and_branches(10_000, 10_000),
            "variables times blocks in a function",
        ),
        (
            bombs::branch_tables(100, 1000),
            "blocks of control flow in a function",
        ),
        (
            bombs::branch_tables(20, 2000),
            "blocks of control flow in a function",
        ),
        (
            bombs::exits(3000, 30),
            "values carried by the branches of a function",
        ),
        (
            bombs::typed_blocks(10_000, 10),
            "variables times blocks in a function",
        ),
        (
            bombs::indirect_calls(30_000),
            "blocks of control flow in a function",
        ),
        (
            bombs::stacked_values(30_000, 1),
            "values on the operand stack",
        ),
        (
            bombs::stacked_values(490, 200),
            "ms of estimated time to compile a function",
        ),
        // Each is admitted alone; the first one makes the others take five times as long.
        (
            bombs::followed_by(
                &bombs::stacked_values(20, 2000),
                &bombs::stacked_values(43, 100),
                480,
            ),
            "ms of estimated time to compile the file",
        ),
        (
            bombs::with_repeated_functions(&bombs::reused_loads(3000, 9), 12)
                .expect("a core module"),
            "ms of estimated time to compile the file",
        ),
        // What the allocator of registers goes through for each value that is alive over many blocks.
        (
            bombs::with_repeated_functions(&bombs::exits(2297, 10), 26).expect("a core module"),
            "ms of estimated time to compile the file",
        ),
        (
            bombs::with_repeated_functions(&bombs::held_values(2297, 10, 13, 0), 12)
                .expect("a core module"),
            "ms of estimated time to compile the file",
        ),
        // 20,000 numbers are loaded one by one, and their sum is needed at the end: all of them stay alive
        // until then. That took 4 s where 0.5 s were estimated.
        (
            bombs::woven(0xcd, 0, 400, 2, 3, 2),
            "ms of estimated time to compile a function",
        ),
        (
            bombs::woven(0x6d, 0, 400, 2, 3, 2),
            "ms of estimated time to compile a function",
        ),
        // 1.5 GB on two threads.
        (
            bombs::locals_and_branches(5500, 3800),
            "MiB of estimated memory to compile a function",
        ),
        (
            bombs::with_repeated_functions(&bombs::locals_and_branches(5000, 2000), 2)
                .expect("a core module"),
            "MiB of estimated memory to compile the file",
        ),
        (bombs::empty_functions(1_000_000), "functions"),
        (bombs::long_function(7_600_000), "bytes in a function"),
        (
            bombs::wide_calls(1000, 10),
            "parameters and results of one function or block",
        ),
        (
            bombs::simd(150_000),
            "MiB of estimated memory to compile a function",
        ),
        (bombs::constant(100_000), "bytes in a constant expression"),
        (
            bombs::globals(1_000_000),
            "items of one kind in a core module",
        ),
        (
            bombs::exports(1_000_000),
            "items of one kind in a core module",
        ),
        (bombs::types(1_000_000), "function types in a core module"),
        (bombs::long_name(90_000), "bytes in a name"),
        (bombs::exponential(30), "core instances"),
        (bombs::nested_components(900), "nested components"),
        (
            bombs::reference_globals(60_000),
            "ms of estimated time to compile a function",
        ),
        (
            bombs::written_globals(60_000, 0),
            "ms of estimated time to compile a function",
        ),
        (
            bombs::placed_data(20_000),
            "ms of estimated time to compile a function",
        ),
        (
            bombs::escaped_functions(30_000, 200),
            "ms of estimated time to compile the file",
        ),
        (bombs::function_types(3, 5000, 20), "core function types"),
        (
            bombs::sparse_memories(2, 8),
            "bytes of images of memories and tables",
        ),
        (
            bombs::sparse_tables(50, 16, 100_000),
            "bytes of images of memories and tables",
        ),
        (bombs::sparse_tables(50, 33, 100_000), "tables"),
        (bombs::many_exports(3, 90_000), "items of core modules"),
        (bombs::many_modules(900), "core modules"),
        (
            bombs::elements_of_instances(62, 90_000),
            "elements in element segments",
        ),
        (
            bombs::data_of_instances(8, 9_000_000),
            "bytes of data segments after instantiation",
        ),
        (
            bombs::equal_targets(200, 20_000, 200),
            "ms of estimated time to compile the file",
        ),
        (
            bombs::declared_instances(1900, 18),
            "parts of component types to compare",
        ),
        (
            bombs::compared_instances(2000, 100, 10),
            "parts of component types to compare",
        ),
        (
            bombs::exported_instances(2000, 100, 10),
            "parts of component types to compare",
        ),
        (
            bombs::doubled_instances(18),
            "parts of component types to compare",
        ),
        (
            bombs::nested_component_types(60),
            "parts of component types to compare",
        ),
        (bombs::module_types(900, 100), "component items"),
        (
            bombs::adapters(600, 2),
            "lowered functions after instantiation",
        ),
        (bombs::doubled_tuple(16), "parts in a component type"),
        (bombs::wide_record(9_000), "parts in a component type"),
    ] {
        let found = rejection(&file, what);
        assert!(found.starts_with("over-limit: "), "{found}");
        assert!(found.contains(&format!(" {what}, and")), "{found}\n{what}");
    }
}

/// Files in which each measure is at least 1.
/// The estimated milliseconds for a function that keeps ten floats alive over 1,000 exits of a block, with
/// that code between the exits and the floats' last use.
fn estimate_with(between: &str) -> u64 {
    use std::fmt::Write as _;

    let mut text = String::from(
        "(component (core module (memory 1) (global $sum (mut f64) (f64.const 0))
           (global $fixed i32 (i32.const 0))
           (func $call (loop (br_if 0 (i32.load (i32.const 0)))))
           (func (param $address i32) (local $carried i32) (local $zero i32)",
    );
    let floats = 0..10;
    let mut code = String::new();
    for float in floats.clone() {
        write!(text, "(local $f{float} f64)").expect("a string");
        let load = format!("(f64.load offset={} (local.get $address))", 8 * float);
        write!(code, "(local.set $f{float} {load})").expect("a string");
    }
    code.push_str("(block $out ");
    for exit in 0..1000 {
        let load = format!("(i32.load offset={exit} (local.get $address))");
        write!(
            code,
            "(local.set $carried {load}) (br_if $out (local.get $address))"
        )
        .expect("a string");
    }
    write!(
        code,
        ") {between} (i32.store (local.get $address) (local.get $carried))"
    )
    .expect("a string");
    for float in floats {
        let sum = format!("(f64.add (global.get $sum) (local.get $f{float}))");
        write!(code, "(global.set $sum {sum})").expect("a string");
    }
    write!(text, "{code})))").expect("a string");
    let file = wat::parse_str(text).expect("WebAssembly text");
    let shape = precheck(&file, &Limits::default()).expect("admitted");
    shape.measures.get(Measure::Work)
}

#[test]
fn only_calls_that_are_made_shorten_the_estimate() {
    let without = estimate_with("");
    let with = estimate_with("(call $call)");
    assert!(with * 2 < without, "{with} ms, and {without} ms without it");
    for never in [
        "(if (i32.const 0) (then (call $call)))",
        "(if (i32.eqz (i32.const 3)) (then (call $call)))",
        "(block (br_if 0 (i32.const 1)) (call $call))",
        "(if (i32.and (local.get $carried) (i32.const 0)) (then (call $call)))",
        "(if (i32.xor (local.get $address) (local.get $address)) (then (call $call)))",
        "(if (i32.xor (local.get $address) (i32.add (local.get $address) (i32.const 0)))
           (then (call $call)))",
        "(if (local.get $zero) (then (call $call)))",
        "(if (global.get $fixed) (then (call $call)))",
        "(if (select (i32.const 0) (i32.const 0) (local.get $carried)) (then (call $call)))",
        "(block (br 0) (call $call))",
        "(block (block (br 1)) (call $call))",
        "(block (block (br_table 0 1 (i32.const 1))) (call $call))",
        // The floats are not needed there.
        "(if (local.get $carried) (then (call $call) (return)))",
    ] {
        let with = estimate_with(never);
        assert!(with >= without, "{never}: {with} ms of {without}");
    }
}

fn samples() -> Vec<Vec<u8>> {
    vec![
        bombs::branch_tables(30, 30),
        bombs::exits(100, 10),
        bombs::nested_loops(20),
        bombs::typed_blocks(100, 5),
        bombs::stacked_values(100, 50),
        bombs::empty_functions(1000),
        bombs::long_function(60_000),
        bombs::exponential(4),
        bombs::doubled_tuple(5),
        bombs::nested_components(5),
        bombs::long_name(50),
        bombs::simd(2000),
        bombs::types(9),
        bombs::constant(9),
        bombs::elements_of_instances(3, 10),
        bombs::data_of_instances(3, 10),
        bombs::adapters(4, 2),
        bombs::many_exports(2, 10),
    ]
}

/// The limit of one measure.
fn set(limits: &mut Limits, measure: Measure, max: u64) {
    let Limits { sandbox, admission } = limits;
    let small = u32::try_from(max).expect("samples are small");
    match measure {
        Measure::CoreInstances => admission.core_instances_max = small,
        Measure::Memories => admission.memories_max = small,
        Measure::MemoryBytes => sandbox.memory_bytes_max = max,
        Measure::Tables => admission.tables_max = small,
        Measure::TableElements => sandbox.table_elements_max = max,
        Measure::ComponentDepth => admission.component_depth_max = small,
        Measure::ComponentItems => admission.component_items_max = small,
        Measure::ExpandedItems => admission.expanded_items_max = small,
        Measure::AdapterValues => admission.adapter_values_max = small,
        Measure::TypeParts => admission.type_parts_max = small,
        Measure::NameBytes => admission.name_bytes_max = small,
        Measure::CustomSections => admission.custom_sections_max = small,
        Measure::ModuleItems => admission.module_items_max = small,
        Measure::FunctionTypes => admission.function_types_max = small,
        Measure::Functions => admission.functions_max = small,
        Measure::Modules => admission.modules_max = small,
        Measure::CoreInstanceBytes => admission.core_instance_bytes_max = small,
        Measure::ComponentInstanceBytes => admission.component_instance_bytes_max = small,
        Measure::LoweredFunctions => admission.lowered_functions_max = small,
        Measure::FileItems => admission.file_items_max = small,
        Measure::FileFunctionTypes => admission.file_function_types_max = small,
        Measure::Elements => admission.elements_max = small,
        Measure::DataBytes => admission.data_bytes_max = max,
        Measure::ImageBytes => admission.image_bytes_max = max,
        Measure::TypeWork => admission.type_work_max = small,
        Measure::Values => admission.values_max = small,
        Measure::ConstBytes => admission.const_bytes_max = small,
        Measure::Locals => admission.locals_max = small,
        Measure::FunctionBytes => admission.function_bytes_max = small,
        Measure::Nesting => admission.nesting_max = small,
        Measure::LoopNesting => admission.loop_nesting_max = small,
        Measure::Operands => admission.operands_max = small,
        Measure::BranchTargets => admission.branch_targets_max = small,
        Measure::Blocks => admission.blocks_max = small,
        Measure::Cells => admission.cells_max = max,
        Measure::Carried => admission.carried_max = small,
        Measure::FunctionMemory => admission.function_memory_mib_max = small,
        Measure::FunctionWork => admission.function_work_ms_max = small,
        Measure::Memory => admission.memory_mib_max = small,
        Measure::Work => admission.work_ms_max = small,
    }
}

/// A file that has exactly as much as the limit is admitted, and rejected when the
/// limit is 1 lower.
#[test]
fn every_limit_is_exact() {
    let custom = [
        &b"\0asm\x01\0\0\0"[..],
        &b"\0\x02\x01a\0\x02\x01a\0\x02\x01a"[..],
    ]
    .concat();
    let samples: Vec<(Vec<u8>, Measures)> = samples()
        .into_iter()
        .chain([custom])
        .map(|file| {
            let shape = precheck(&file, &Limits::default()).expect("a small file");
            (file, shape.measures)
        })
        .collect();
    for measure in Measure::all() {
        let (file, measures) = samples
            .iter()
            .max_by_key(|(_, measures)| measures.get(measure))
            .expect("there are samples");
        let found = measures.get(measure);
        assert!(found > 0, "no sample has any {}", measure.name());
        let mut limits = Limits::default();
        set(&mut limits, measure, found);
        assert_eq!(measure.max(&limits), found, "{}", measure.name());
        let shape = precheck(file, &limits).expect("exactly at the limit");
        assert_eq!(shape.measures, *measures);
        set(&mut limits, measure, found - 1);
        let rejection = precheck(file, &limits).expect_err(measure.name());
        let expected = format!(" {}, and the limit is {} (", measure.what(), found - 1);
        let found = rejection.to_string();
        assert!(found.contains(&expected), "{found}\n{expected}");
    }
}

#[test]
fn bundled_robots_are_far_from_every_limit() {
    let limits = Limits::default();
    for robot in bundled() {
        let shape = precheck(robot.component, &limits).expect(robot.name);
        for measure in Measure::all() {
            let (found, max) = (shape.measures.get(measure), measure.max(&limits));
            // A robot has one memory and one or two tables, of few.
            assert!(
                found * 4 <= max,
                "{}: {found} {}",
                robot.name,
                measure.name()
            );
        }
    }
}

#[test]
fn a_rejection_names_module_and_function() {
    let text = r#"(component (core module) (core module
        (func) (func $hot (export "x") (param i32) (br_table 0 0 0 0 0 (local.get 0)))))"#;
    let mut limits = Limits::default();
    limits.admission.branch_targets_max = 3;
    let file = wat::parse_str(text).expect("written here");
    let rejection = precheck(&file, &limits).expect_err("4 targets").to_string();
    let expected = "the file has 4 targets in a branch table, and the limit is 3 \
        (core module 1, function 1 `hot`, byte ";
    assert!(rejection.starts_with(expected), "{rejection}");
}

/// Robots of the corpus that must play are not rejected for their size.
#[test]
fn robots_that_play_are_within_the_limits() {
    let mut over = Vec::new();
    for case in corpus::cases() {
        let plays = |expected: &serde_json::Value| expected.get("rejection").is_none();
        if !case.expected.iter().all(plays) {
            continue;
        }
        for file in case.files() {
            if let Err(rejection) = precheck(&file, &Limits::default()) {
                over.push(format!("{}: {rejection}", case.name));
            }
        }
    }
    assert_eq!(over, [""; 0]);
}

/// What is instantiated must be known, or it could not be counted.
#[test]
fn foreign_components_are_not_instantiated() {
    for text in [
        r#"(component (component (import "c" (component $c)) (instance (instantiate $c))))"#,
        r#"(component (component (import "m" (core module $m)) (core instance (instantiate $m))))"#,
        r#"(component (component $a (component $b) (export "b" (component $b)))
            (instance $i (instantiate $a)) (alias export $i "b" (component $b))
            (instance (instantiate $b)))"#,
    ] {
        let file = wat::parse_str(text).expect("written here");
        check(
            &file,
            "invalid: the component is not valid: it instantiates",
        );
    }
}

/// Proposals that are turned off are rejected by name.
#[test]
fn proposals_that_are_off() {
    for (text, words) in [
        ("(module (memory i64 1))", "memory64"),
        ("(module (memory 1 1 shared))", "threads"),
        ("(module (tag))", "exceptions"),
        ("(module (type (struct)))", "garbage collection"),
        ("(module (table 1 externref))", "garbage collection"),
        ("(module (memory 1 (pagesize 1)))", "page size"),
        (
            "(module (func (result v128) v128.const i64x2 0 0 v128.const i64x2 0 0
                i8x16.relaxed_swizzle))",
            "relaxed SIMD",
        ),
        ("(component (type (stream u8)))", "async"),
        ("(component (type (future u8)))", "async"),
        ("(component (core func (canon thread.index)))", "thread"),
        ("(component (type (list u8 4)))", "fixed length"),
        ("(component (type error-context))", "async"),
    ] {
        let file = wat::parse_str(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let found = rejection(&file, text);
        assert!(found.starts_with("proposal: "), "{text}: {found}");
        assert!(found.contains(" at byte "), "{found}");
        let lower = found.to_lowercase();
        assert!(lower.contains(&words.to_lowercase()), "{text}: {found}");
    }
}

/// The check knows no engine; it admits the proposals that the engine has, and no others.
#[test]
fn the_proposals_are_those_of_the_engine() {
    let engine = wasmtime::Engine::new(&engine_config(&Limits::default(), 1));
    let engine = engine.expect("address space for one match");
    let mut counts = [0, 0];
    for text in [
        // A proposal each, by the names of wasmparser's features.
        "(module (global (import \"m\" \"g\") (mut i32)) (export \"g\" (global 0)))",
        "(module (func (result i32) f32.const 0 i32.trunc_sat_f32_s))",
        "(module (func (result i32) i32.const 0 i32.extend8_s))",
        "(module (table 1 externref))",
        "(module (func (result i32 i32) i32.const 0 i32.const 0))",
        "(module (memory 1) (func i32.const 0 i32.const 0 i32.const 0 memory.fill))",
        "(module (func (result v128) v128.const i64x2 0 0))",
        "(module (func (result v128) v128.const i64x2 0 0 v128.const i64x2 0 0
            i8x16.relaxed_swizzle))",
        "(module (memory 1 1 shared))",
        "(module (memory 1) (func (result i32) i32.const 0 i32.atomic.load))",
        "(module (func $f return_call $f))",
        "(module (memory 1) (memory 1))",
        "(module (tag))",
        "(module (func try_table end))",
        "(module (memory i64 1))",
        "(module (table i64 1 funcref))",
        "(module (global i32 (i32.add (i32.const 1) (i32.const 2))))",
        "(module (type $t (func)) (func (param (ref $t)) local.get 0 call_ref $t))",
        "(module (type (struct)))",
        "(module (type (array i8)))",
        "(module (func (result i31ref) i32.const 0 ref.i31))",
        "(module (memory 1 (pagesize 1)))",
        "(module (func (result i64 i64) i64.const 0 i64.const 0 i64.const 0 i64.const 0
            i64.add128))",
        "(module (type $f (func)) (type (cont $f)))",
        "(component (type (stream u8)))",
        "(component (type (future u8)))",
        "(component (type (func async)))",
        "(component (core func (canon thread.index)))",
        "(component (core func (canon backpressure.inc)))",
        "(component (type (list u8 4)))",
        "(component (type (map string u8)))",
        "(component (type error-context))",
        "(component (import \"v\" (value string)))",
        "(component (core module) (core instance (instantiate 0)))",
        "(component (import \"a:b/c@1.2.3\" (instance)))",
        "(component (type (resource (rep i32))))",
        "(component (type (enum \"a\" \"b\")) (type (record (field \"f\" u8))))",
    ] {
        let file = wat::parse_str(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let engine_has_it = match BinaryKind::of(&file) {
            BinaryKind::Component => Component::from_binary(&engine, &file).is_ok(),
            _ => wasmtime::Module::validate(&engine, &file).is_ok(),
        };
        let admitted = precheck(&file, &Limits::default());
        assert_eq!(admitted.is_ok(), engine_has_it, "{text}: {admitted:?}");
        // Whoever needs one that is off is told which.
        if let Err(rejection) = admitted {
            assert_eq!(rejection.name(), "proposal", "{text}: {rejection}");
        }
        counts[usize::from(engine_has_it)] += 1;
    }
    println!("{} are off, {} are on", counts[0], counts[1]);
    assert!(counts[0] > 10 && counts[1] > 10, "{counts:?}");
}

proptest! {
    /// Damaged files are rejected or admitted; nothing panics.
    #[test]
    fn damage_never_panics(
        which in any::<prop::sample::Index>(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let samples = [
            bombs::branch_tables(3, 3), bombs::typed_blocks(3, 3), bombs::exponential(3),
            bombs::doubled_tuple(3), bombs::nested_loops(3), bombs::constant(3),
        ];
        let mut file = which.get(&samples).clone();
        for (at, byte) in damage {
            let at = at.index(file.len());
            file[at] = byte;
        }
        drop(precheck(&file, &Limits::default()));
    }
}
