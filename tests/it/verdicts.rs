//! Robots that fail: each ends in the verdict that says why, and the next match
//! on the same host is as ever.

use std::fs;

use wasmouse::robot::{Recorder, Verdict};
use wasmouse::sim::{AdmissionLimits, Limits};

use crate::binary::{Ran, ran, wasmouse};
use crate::hostile::{DRIVE_ON, IMPORT_LOG, Module, assert_unharmed, host, play, wasm};

/// Fuel that the flood robot can live with, and that is burnt in milliseconds.
const SMALL: Limits = Limits {
    component_bytes_max: 1 << 20,
    start_fuel_max: 4_000_000,
    step_fuel_max: 4_000_000,
    match_fuel_max: 40_000_000,
    memory_bytes_max: 4 << 20,
    table_elements_max: 1000,
    stack_bytes_max: 128 << 10,
    core_instances_max: 8,
    memories_max: 4,
    tables_max: 4,
    journal_bytes_max: 1000,
    host_call_bytes_max: 4096,
    admission: AdmissionLimits::DEFAULT,
};

/// Plays the robot and compares kind, phase and text of its fault.
#[track_caller]
fn check(robot: Module<'_>, expected: &str) {
    let host = host(SMALL);
    let outcome = play(&host, &robot.component(), &mut Recorder::default());
    let verdict = match outcome.verdict {
        Verdict::Fault(fault) => {
            format!("{} ({}): {fault}", fault.kind.name(), fault.phase.name())
        }
        other => other.title().into_owned(),
    };
    assert_eq!(verdict, expected);
    assert_unharmed(&host);
}

/// A fault in the first call of `next-move`.
#[track_caller]
fn check_step(next: &str, expected: &str) {
    check_step_with("", next, expected);
}

#[track_caller]
fn check_step_with(rest: &str, next: &str, expected: &str) {
    let robot = Module {
        next,
        rest,
        ..Module::default()
    };
    let (kind, detail) = expected.split_once(": ").expect("`kind: detail`");
    check(
        robot,
        &format!("{kind} (next-move): {detail} in step 1 (run 1, at (0, 0))"),
    );
}

#[test]
fn a_harmless_robot_uses_up_its_budget() {
    check(Module::default(), "budget used up");
}

const IMPORT_PANIC: &str = r#"(import "wasmouse:robot/journal@VERSION" "panic"
    (func $panic (param i32 i32)))"#;

#[test]
fn a_panic_ends_the_match_with_its_message() {
    let panicking = Module {
        imports: IMPORT_PANIC,
        rest: r#"(data (i32.const 100) "the map is \"wrong\"\0a")"#,
        ..Module::default()
    };
    const PANIC: &str = "(call $panic (i32.const 100) (i32.const 19))";
    check(
        Module {
            // It does not return, so the robot does not get to its `unreachable`.
            next: &format!("{PANIC} unreachable"),
            ..panicking
        },
        "panic (next-move): panicked: the map is \"wrong\"\n in step 1 (run 1, at (0, 0))",
    );
    check(
        Module {
            start: PANIC,
            ..panicking
        },
        "panic (start): panicked: the map is \"wrong\"\n in `start`",
    );
    check(
        Module {
            next: "(call $panic (i32.const 0) (i32.const 0)) unreachable",
            ..panicking
        },
        "panic (next-move): panicked:  in step 1 (run 1, at (0, 0))",
    );
    check(
        Module {
            next: "(i32.store8 (i32.const 100) (i32.const 255))
                (call $panic (i32.const 100) (i32.const 1)) unreachable",
            ..panicking
        },
        "interface (next-move): broke the interface: invalid utf-8 sequence of 1 bytes from \
         index 0 in step 1 (run 1, at (0, 0))",
    );
}

#[test]
fn a_long_panic_is_cut_between_characters_and_costs_fuel() {
    // One byte, then characters of two bytes: byte 2,000 is in the middle of one.
    let fill = "(i32.store8 (i32.const 100) (i32.const 0x61))
        (local.set 0 (i32.const 101))
        (loop $more
            (i32.store16 (local.get 0) (i32.const 0xa9c3))
            (br_if $more (i32.lt_u
                (local.tee 0 (i32.add (local.get 0) (i32.const 2))) (i32.const 3100))))";
    let panicking = |bytes: u32| {
        format!("{fill} (call $panic (i32.const 100) (i32.const {bytes})) unreachable")
    };
    let played = |next: &str, limits: Limits| {
        let robot = Module {
            imports: IMPORT_PANIC,
            next,
            ..Module::default()
        };
        let mut recorder = Recorder::default();
        let outcome = play(&host(limits), &robot.component(), &mut recorder);
        assert_eq!(recorder.journal.counts(), (0, 0));
        match outcome.verdict {
            Verdict::Fault(fault) => (fault.kind.name(), fault.detail, outcome.fuel.steps),
            other => panic!("{other:?}"),
        }
    };
    // The message does not have to fit the journal.
    let no_journal = Limits {
        journal_bytes_max: 0,
        ..SMALL
    };
    let (kind, detail, short_fuel) = played(&panicking(2001), no_journal);
    assert_eq!((kind, detail.len()), ("panic", "panicked: ".len() + 1999));
    assert!(detail.starts_with("panicked: aé") && detail.ends_with('é'));
    let (_, long_detail, long_fuel) = played(&panicking(2901), no_journal);
    assert_eq!(long_detail, detail);
    assert_eq!(long_fuel - short_fuel, 900);
    let too_little = Limits {
        step_fuel_max: long_fuel - 1,
        ..SMALL
    };
    assert_eq!(played(&panicking(2901), too_little).0, "out-of-step-fuel");
}

#[test]
fn endless_loops_use_up_fuel() {
    const FOREVER: &str = "(loop $forever br $forever)";
    check(
        Module {
            rest: &format!("(func $begin {FOREVER}) (start $begin)"),
            ..Module::default()
        },
        "out-of-start-fuel (instantiate): used up the 4000000 units of fuel for the start \
         while it was loaded",
    );
    check(
        Module {
            start: FOREVER,
            ..Module::default()
        },
        "out-of-start-fuel (start): used up the 4000000 units of fuel for the start in `start`",
    );
    let of_a_step = "out-of-step-fuel: used up the 4000000 units of fuel of a step";
    check_step(&format!("{FOREVER} unreachable"), of_a_step);
    // After the answer, where a robot cleans up.
    check_step_with(
        &format!(
            r#"(func (export "cabi_post_wasmouse:robot/controller@VERSION#next-move")
                (param i32) {FOREVER})"#
        ),
        DRIVE_ON,
        of_a_step,
    );
    // Calls that never return, one inside the other or one after the other.
    check_step_with(
        "(func $even (result i32) return_call $odd)
         (func $odd (result i32) return_call $even)",
        "call $even",
        of_a_step,
    );
    // Operators with a price of their own: one byte each, and nothing at all.
    check_step(
        "(loop $again
            (memory.fill (i32.const 0) (i32.const 0) (i32.const 65536)) (br $again))
         unreachable",
        of_a_step,
    );
    check_step(
        "(loop $again (drop (memory.grow (i32.const 0))) (br $again)) unreachable",
        of_a_step,
    );
}

#[test]
fn slow_robots_use_up_the_fuel_of_the_match() {
    check(
        Module {
            next: "(local $left i32)
                (local.set $left (i32.const 500000))
                (loop $again
                    (local.set $left (i32.sub (local.get $left) (i32.const 1)))
                    (br_if $again (local.get $left)))
                i32.const 16",
            ..Module::default()
        },
        "out-of-match-fuel (next-move): used up the 40000000 units of fuel of the match \
         in step 14 (run 1, at (0, 11))",
    );
}

#[test]
fn traps_have_their_own_verdicts() {
    for (next, expected) in [
        (
            "unreachable",
            "unreachable: executed `unreachable` (a panic or an abort)",
        ),
        (
            "(i32.div_u (i32.const 1) (i32.const 0))",
            "division-by-zero: divided by zero",
        ),
        (
            "(i32.rem_s (i32.const 1) (i32.const 0))",
            "division-by-zero: divided by zero",
        ),
        (
            "(i32.div_s (i32.const 0x80000000) (i32.const -1))",
            "integer-overflow: overflowed an integer",
        ),
        (
            "(i32.trunc_f32_s (f32.const 1e10))",
            "integer-overflow: overflowed an integer",
        ),
        (
            "(i32.trunc_f64_u (f64.const nan))",
            "integer-overflow: converted a float that fits no integer",
        ),
        (
            "(i32.load (i32.const -1))",
            "out-of-bounds: accessed memory out of bounds",
        ),
        (
            "(i32.load (i32.const 65533))",
            "out-of-bounds: accessed memory out of bounds",
        ),
        (
            "(memory.fill (i32.const 65000) (i32.const 0) (i32.const 1000)) i32.const 16",
            "out-of-bounds: accessed memory out of bounds",
        ),
    ] {
        check_step(next, expected);
    }
}

#[test]
fn indirect_calls_have_to_meet_a_function_of_their_type() {
    const TABLE: &str = "(type $answer (func (result i32)))
        (table 3 funcref)
        (elem (i32.const 1) $other)
        (func $other (param f64))";
    for (index, expected) in [
        ("0", "bad-indirect-call: called a null function"),
        ("1", "bad-indirect-call: called a function of another type"),
        ("3", "out-of-bounds: accessed a table out of bounds"),
        ("-1", "out-of-bounds: accessed a table out of bounds"),
    ] {
        let next = format!("(call_indirect (type $answer) (i32.const {index}))");
        check_step_with(TABLE, &next, expected);
    }
}

#[test]
fn deep_recursion_overflows_the_stack() {
    let recursion = "(func $deeper (result i32) (i32.add (call $deeper) (i32.const 1)))";
    let overflow = "stack-overflow: overflowed its stack";
    check_step_with(recursion, "call $deeper", overflow);
    // Few calls with large frames: as deep in bytes.
    let locals = "i64 ".repeat(2000);
    let sum: String = (0..2000)
        .map(|local| format!("(local.set {local} (i64.extend_i32_u (call $deeper)))"))
        .collect();
    let frames = format!("(func $deeper (result i32) (local {locals}) {sum} i32.const 0)");
    check_step_with(&frames, "call $deeper", overflow);
}

#[test]
fn memory_is_limited_for_all_instances_together() {
    check_step(
        "(drop (memory.grow (i32.const 64))) i32.const 16",
        "memory-limit: asked for 4259840 bytes of memory in all, of 4194304",
    );
    // The most that there is in 32 bits, and page by page.
    check_step(
        "(drop (memory.grow (i32.const 65535))) i32.const 16",
        "memory-limit: asked for 4294967296 bytes of memory in all, of 4194304",
    );
    check_step(
        "(loop $again (drop (memory.grow (i32.const 1))) (br $again)) unreachable",
        "memory-limit: asked for 4259840 bytes of memory in all, of 4194304",
    );
    // Each is under the limit.
    check(
        Module {
            memory: r#"(memory (export "memory") 30) (memory 30) (memory 30)"#,
            ..Module::default()
        },
        "memory-limit (instantiate): asked for 5898240 bytes of memory in all, of 4194304 \
         while it was loaded",
    );
    // A memory's own maximum is no fault: growing fails and says so.
    check(
        Module {
            memory: r#"(memory (export "memory") 1 2)"#,
            next: "(if (i32.ne (memory.grow (i32.const 2)) (i32.const -1)) (then unreachable))
                i32.const 16",
            ..Module::default()
        },
        "budget used up",
    );
}

#[test]
fn tables_are_limited_together() {
    check_step_with(
        "(table $table 1 funcref)",
        "(drop (table.grow $table (ref.null func) (i32.const 1000))) i32.const 16",
        "table-limit: asked for 1001 table elements in all, of 1000",
    );
    check(
        Module {
            rest: "(table 600 funcref) (table 600 funcref)",
            ..Module::default()
        },
        "table-limit (instantiate): asked for 1200 table elements in all, of 1000 \
         while it was loaded",
    );
}

#[test]
fn a_data_segment_has_to_fit_its_memory() {
    check(
        Module {
            rest: r#"(data (i32.const 65535) "xy")"#,
            ..Module::default()
        },
        "out-of-bounds (instantiate): accessed memory out of bounds while it was loaded",
    );
}

#[test]
fn answers_have_to_exist() {
    const ANSWERS: &str = r#"
        (data (i32.const 32) "\00\ff\01")
        (data (i32.const 48) "\02\01\01")
        (data (i32.const 65533) "\00\01\00")"#;
    for (pointer, expected) in [
        (
            "32",
            "interface: broke the interface: unexpected discriminant: 255",
        ),
        (
            "48",
            "interface: broke the interface: unexpected discriminant: 2",
        ),
        (
            "65534",
            "interface: broke the interface: pointer out of bounds of memory",
        ),
        (
            "-1",
            "interface: broke the interface: pointer out of bounds of memory",
        ),
    ] {
        let next = format!("i32.const {pointer}");
        check_step_with(ANSWERS, &next, expected);
    }
    // The last bytes of the memory and an odd address are as good as any.
    check(
        Module {
            next: "i32.const 65533",
            rest: ANSWERS,
            ..Module::default()
        },
        "budget used up",
    );
}

/// A robot that calls `log` in its first step with this level, pointer and length.
fn logging(level: i32, pointer: i32, length: i32) -> String {
    format!(
        "(call $log (i32.const {level}) (i32.const {pointer}) (i32.const {length})) i32.const 16"
    )
}

#[test]
fn log_lines_have_to_be_text_of_a_sensible_size() {
    for (next, detail) in [
        (
            logging(1, 32, 1),
            "interface (next-move): broke the interface: invalid utf-8 sequence of 1 bytes \
             from index 0",
        ),
        (
            logging(9, 0, 0),
            "interface (next-move): broke the interface: unexpected discriminant: 9",
        ),
        (
            logging(1, 65530, 7),
            "interface (next-move): broke the interface: string pointer/length out of \
             bounds of memory",
        ),
        (
            logging(1, 100, -50),
            "interface (next-move): broke the interface: string pointer/length out of \
             bounds of memory",
        ),
        (
            logging(1, 64, 5000),
            "interface (next-move): handed the host more than 4096 bytes in one call",
        ),
    ] {
        check(
            Module {
                imports: IMPORT_LOG,
                next: &next,
                rest: r#"(data (i32.const 32) "\ff")"#,
                ..Module::default()
            },
            &format!("{detail} in step 1 (run 1, at (0, 0))"),
        );
    }
}

#[test]
fn a_flood_of_log_lines_uses_up_fuel() {
    check(
        Module {
            imports: IMPORT_LOG,
            next: "(loop $again
                    (call $log (i32.const 0) (i32.const 0) (i32.const 4000)) (br $again))
                unreachable",
            ..Module::default()
        },
        "out-of-step-fuel (next-move): used up the 4000000 units of fuel of a step \
         in step 1 (run 1, at (0, 0))",
    );
}

#[test]
fn the_journal_drops_and_counts_what_is_too_much() {
    let robot = Module {
        imports: IMPORT_LOG,
        next: &logging(1, 64, 84),
        ..Module::default()
    };
    let host = host(SMALL);
    let mut recorder = Recorder::default();
    let outcome = play(&host, &robot.component(), &mut recorder);
    assert_eq!(outcome.verdict.name(), "budget-used-up");
    // Entries of 16 + 84 bytes, 1000 bytes, 1000 steps.
    let journal = &recorder.journal;
    assert_eq!((journal.len(), journal.dropped()), (10, 990));
    assert_unharmed(&host);
}

/// A robot whose answer depends on everything that it may have left behind: it
/// drives on in its first match and traps in any other.
#[test]
fn nothing_survives_a_match() {
    let robot = Module {
        memory: r#"(memory (export "memory") 2)"#,
        rest: r#"(global $matches (mut i32) (i32.const 0))
            (table $table 1 2 funcref)
            (elem declare func $some)
            (func $some)
            (func $remembers (result i32)
                (i32.or
                    (i32.or
                        (global.get $matches)
                        (i32.load (i32.const 100000)))
                    (i32.or
                        (i32.ne (memory.size) (i32.const 2))
                        (i32.or
                            (i32.ne (table.size $table) (i32.const 1))
                            (i32.eqz (ref.is_null (table.get $table (i32.const 0))))))))"#,
        start: "(if (call $remembers) (then unreachable))
            (global.set $matches (i32.const 1))
            (i32.store (i32.const 100000) (i32.const 1))
            (drop (memory.grow (i32.const 1)))
            (drop (table.grow $table (ref.null func) (i32.const 1)))
            (table.set $table (i32.const 0) (ref.func $some))",
        next: "(if (i32.eqz (call $remembers)) (then unreachable)) i32.const 16",
        ..Module::default()
    };
    let component = robot.component();
    let host = host(SMALL);
    let mut recorder = Recorder::default();
    let first = play(&host, &component, &mut recorder);
    assert_eq!(first.verdict.name(), "budget-used-up", "{first:?}");
    for _ in 0..20 {
        assert_eq!(play(&host, &component, &mut recorder), first);
    }
}

/// The worst two through the real program, under the limits that users have.
#[test]
fn the_program_goes_on_after_a_loop_and_a_memory_eater() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let endless = Module {
        next: "(loop $forever br $forever) unreachable",
        ..Module::default()
    };
    let greedy = Module {
        next: "(local $top i32)
            (loop $again
                (local.set $top (i32.shl (memory.grow (i32.const 64)) (i32.const 16)))
                (memory.fill (local.get $top) (i32.const 1) (i32.const 0x400000))
                br $again)
            unreachable",
        ..Module::default()
    };
    for (name, robot) in [("endless", endless), ("greedy", greedy)] {
        let file = folder.path().join(name).with_extension("wasm");
        fs::write(file, robot.component()).expect("a file");
    }
    fs::write(folder.path().join("wasi.wasm"), wasm(IMPORTS_WASI)).expect("a file");
    fs::write(folder.path().join("empty.wasm"), "").expect("a file");
    fs::write(folder.path().join("bare.wasm"), wasm("(module)")).expect("a file");

    let robots = ["endless", "greedy", "wasi", "empty", "bare"].map(|name| format!("{name}.wasm"));
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(wasmouse()
        .arg("run")
        .args(&robots)
        .args(["flood", "test_maze_01", "--no-cache", "--ascii"])
        .current_dir(folder.path()));
    assert_eq!(status.code(), Some(4), "{stderr}");
    let row = |robot: &str| {
        let mut rows = stdout.lines().filter(|line| line.contains(robot));
        rows.next()
            .unwrap_or_else(|| panic!("no {robot} in\n{stdout}"))
    };
    assert!(row("flood").contains("finished"), "{stdout}");
    assert!(
        row("endless").contains("fault: out-of-step-fuel"),
        "{stdout}"
    );
    assert!(row("greedy").contains("fault: memory-limit"), "{stdout}");
    for line in [
        "fault of `endless` in `test_maze_01`: used up the 2000000000 units of fuel of a step \
         in step 1 (run 1, at (0, 0))",
        "fault of `greedy` in `test_maze_01`: asked for 268500992 bytes of memory in all, \
         of 268435456 in step 1 (run 1, at (0, 0))",
        "refused `wasi`: the component imports `wasi:cli/environment@0.2.0`, \
         which a robot does not get",
        "refused `empty`: the file is empty",
        "refused `bare`: core module without component types",
    ] {
        assert!(stderr.contains(line), "no `{line}` in\n{stderr}");
    }
}

const IMPORTS_WASI: &str = r#"(component (import "wasi:cli/environment@0.2.0" (instance)))"#;
