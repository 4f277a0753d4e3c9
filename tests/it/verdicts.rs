//! Verdicts that depend on the limits, the journal, and failures in the whole program. The other
//! verdicts are in the hostile corpus.

use std::fs;

use wasmouse_core::game::{SandboxLimits, Verdict};
use wasmouse_tests::binary::{Ran, ran, wasmouse};

use crate::hostile::{Engine, IMPORT_LOG, Module, SMALL, wasm};

/// Plays the robot and compares kind and text of its fault.
#[track_caller]
fn check(robot: Module<'_>, expected: &str) {
    let engine = Engine::new(SMALL);
    let verdict = engine.play(&robot.component()).record.verdict;
    let found = match verdict {
        Verdict::Fault { fault } => {
            let (kind, text) = (fault.kind.name(), fault.describe());
            format!("{kind}: {}", text.raw())
        }
        other => other.title().into_owned(),
    };
    assert_eq!(found, expected);
    engine.assert_unharmed();
}

/// Each limit is that of the rules, and the fault names it.
#[test]
fn the_sandbox_limits_are_those_of_the_rules() {
    const FOREVER: &str = "(loop $forever br $forever)";
    let in_step_1 = |next: &str, rest: &str, expected: &str| {
        let robot = Module {
            imports: IMPORT_LOG,
            next,
            rest,
            ..Module::default()
        };
        let place = "in step 1 (exploration run, at (0, 0))";
        check(robot, &format!("{expected} {place}"));
    };
    check(
        Module {
            rest: &format!("(func $begin {FOREVER}) (start $begin)"),
            ..Module::default()
        },
        "out-of-start-fuel: exceeded the start fuel limit (4,000,000) during instantiation",
    );
    check(
        Module {
            start: FOREVER,
            ..Module::default()
        },
        "out-of-start-fuel: exceeded the start fuel limit (4,000,000) in `start`",
    );
    in_step_1(
        &format!("{FOREVER} unreachable"),
        "",
        "out-of-step-fuel: exceeded the per-step fuel limit (4,000,000)",
    );
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
        "out-of-match-fuel: exceeded the match fuel limit (40,000,000) \
         in step 14 (exploration run, at (0, 11))",
    );
    in_step_1(
        "(loop $again (drop (memory.grow (i32.const 1))) (br $again)) unreachable",
        "",
        "out-of-memory: exceeded the memory limit: requested 5 MiB, limit 4 MiB",
    );
    in_step_1(
        "(drop (table.grow $table (ref.null func) (i32.const 1000))) i32.const 16",
        "(table $table 1 funcref)",
        // One element more is in the shim through which a component reaches the host.
        "table-limit: exceeded the table limit: requested 1002 elements, limit 1000",
    );
    // With a quarter of the default stack, a quarter of the depth.
    in_step_1(
        "(call $deeper (i32.const 4000)) i32.const 16",
        "(func $deeper (param i32)
            (if (local.get 0) (then
                (call $deeper (i32.sub (local.get 0) (i32.const 1)))
                (drop (memory.grow (i32.const 0))))))",
        "stack-overflow: overflowed its stack",
    );
    in_step_1(
        "(call $log (i32.const 1) (i32.const 64) (i32.const 5000)) i32.const 16",
        "",
        "invalid-action: passed more than 4096 bytes to the host in one call",
    );
}

/// A memory's own maximum is not a fault: growing fails and returns -1.
#[test]
fn a_memory_may_fail_to_grow() {
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
    let place = "in step 1 (exploration run, at (0, 0))";
    check(
        Module {
            // It does not return, so the robot does not get to its `unreachable`.
            next: &format!("{PANIC} unreachable"),
            ..panicking
        },
        &format!("panic: panicked: the map is \"wrong\"\n {place}"),
    );
    check(
        Module {
            start: PANIC,
            ..panicking
        },
        "panic: panicked: the map is \"wrong\"\n in `start`",
    );
    check(
        Module {
            next: "(call $panic (i32.const 0) (i32.const 0)) unreachable",
            ..panicking
        },
        &format!("panic: panicked:  {place}"),
    );
    check(
        Module {
            next: "(i32.store8 (i32.const 100) (i32.const 255))
                (call $panic (i32.const 100) (i32.const 1)) unreachable",
            ..panicking
        },
        &format!(
            "invalid-action: violated the interface: invalid utf-8 sequence of 1 bytes from \
             index 0 {place}"
        ),
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
    let played = |next: &str, change: fn(&mut SandboxLimits, u64), value: u64| {
        let robot = Module {
            imports: IMPORT_PANIC,
            next,
            ..Module::default()
        };
        let mut limits = SMALL;
        change(&mut limits.sandbox, value);
        let record = Engine::new(limits).play(&robot.component()).record;
        assert_eq!((record.journal.entries, record.journal.dropped), (0, 0));
        let fault = record.verdict.fault().expect("a fault").clone();
        (fault.kind.name(), fault.detail, record.fuel.steps)
    };
    // The message does not have to fit the journal.
    let journal = |limits: &mut SandboxLimits, max| limits.journal_bytes_max = max;
    let (kind, detail, short_fuel) = played(&panicking(2001), journal, 0);
    assert_eq!((kind, detail.len()), ("panic", "panicked: ".len() + 1999));
    let text = detail.raw();
    assert!(text.starts_with("panicked: aé") && text.ends_with('é'));
    let (_, long_detail, long_fuel) = played(&panicking(2901), journal, 0);
    assert_eq!(long_detail, detail);
    assert_eq!(long_fuel - short_fuel, 900);
    let step_fuel = |limits: &mut SandboxLimits, max| limits.step_fuel_max = max;
    let (kind, _, _) = played(&panicking(2901), step_fuel, long_fuel - 1);
    assert_eq!(kind, "out-of-step-fuel");
}

#[test]
fn the_journal_drops_and_counts_what_is_too_much() {
    let robot = Module {
        imports: IMPORT_LOG,
        next: "(call $log (i32.const 1) (i32.const 64) (i32.const 84)) i32.const 16",
        ..Module::default()
    };
    let engine = Engine::new(SMALL);
    let record = engine.play(&robot.component()).record;
    assert_eq!(record.verdict.title(), "budget used up");
    // Entries of 16 + 84 bytes, 1000 bytes, 1000 steps.
    assert_eq!((record.journal.entries, record.journal.dropped), (10, 990));
    engine.assert_unharmed();
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
    assert!(row("greedy").contains("fault: out-of-memory"), "{stdout}");
    for line in [
        "exceeded the per-step fuel limit (2,000,000,000) in step 1 (exploration run, at (0, 0))",
        "exceeded the memory limit: requested 257 MiB, limit 256 MiB in step 1",
        "the component imports `wasi:cli/environment@0.2.0`, which is not available to robots",
        "the file is empty",
        "core module without component types",
    ] {
        assert!(stderr.contains(line), "no `{line}` in\n{stderr}");
    }
}

const IMPORTS_WASI: &str = r#"(component (import "wasi:cli/environment@0.2.0" (instance)))"#;
