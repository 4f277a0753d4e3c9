//! Execution: loops, recursion, fuel to the last unit, state and traps.

use super::case::{
    Case, fault, fault_in, harmless, out_of_match_fuel, out_of_start_fuel, out_of_step_fuel,
};
use crate::composite::Composite;
use crate::module::{DRIVE_ON, IMPORT_LOG, Module};
use serde_json::json;

const FOREVER: &str = "(loop $forever br $forever)";

/// The cases 1 to 23.
pub fn cases() -> Vec<Case> {
    [
        endless_loops(),
        recursion(),
        fuel_to_the_last_unit(),
        state(),
        traps(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A robot that does this in its first step, and is harmless if it gets over it.
fn once(rest: &str, first: &str) -> Vec<u8> {
    Module {
        imports: IMPORT_LOG,
        rest: &format!("(global $is-later (mut i32) (i32.const 0)) {rest}"),
        next: &format!(
            "(local $left i32)
             (if (i32.eqz (global.get $is-later)) (then
                (global.set $is-later (i32.const 1)) {first}))
             {DRIVE_ON}"
        ),
        ..Module::default()
    }
    .component()
}

fn endless_loops() -> Vec<Case> {
    vec![
        Case::new(
            &[1],
            "loop-in-core-start",
            out_of_start_fuel("instantiate"),
            || {
                Module {
                    rest: &format!("(func $begin {FOREVER}) (start $begin)"),
                    ..Module::default()
                }
                .component()
            },
        ),
        Case::new(
            &[2],
            "loop-in-second-instance",
            out_of_start_fuel("instantiate"),
            || {
                Composite {
                    after: &format!(
                        "(core module $second (func $begin {FOREVER}) (start $begin))
                         (core instance (instantiate $second))"
                    ),
                    ..Composite::default()
                }
                .component()
            },
        ),
        Case::new(&[3], "loop-in-start", out_of_start_fuel("start"), || {
            Module {
                start: FOREVER,
                ..Module::default()
            }
            .component()
        }),
        Case::new(&[4], "loop-in-step", out_of_step_fuel(), || {
            once("", FOREVER)
        }),
        // The world has no call that needs it, so nobody calls it.
        Case::new(&[5], "loop-in-unused-realloc", harmless(), || {
            Module {
                rest: &format!(
                    r#"(func (export "cabi_realloc") (param i32 i32 i32 i32) (result i32)
                        {FOREVER} unreachable)"#
                ),
                ..Module::default()
            }
            .component()
        }),
        Case::new(&[6], "loop-in-post-return", out_of_step_fuel(), || {
            post_return(FOREVER)
        }),
        Case::new(&[7], "loop-of-free-operators", out_of_step_fuel(), || {
            let free = "nop (block) (loop) (if (i32.const 0) (then) (else))".repeat(50);
            once("", &format!("(loop $forever {free} br $forever)"))
        }),
        Case::new(&[11], "endless-tail-calls", out_of_step_fuel(), || {
            once(
                "(func $even return_call $odd) (func $odd return_call $even)",
                "call $even",
            )
        }),
        Case::new(
            &[11, 12],
            "endless-indirect-tail-calls",
            out_of_step_fuel(),
            || {
                once(
                    "(type $action (func)) (table 2 funcref) (elem (i32.const 0) $even $odd)
                     (func $even (return_call_indirect (type $action) (i32.const 1)))
                     (func $odd (return_call_indirect (type $action) (i32.const 0)))",
                    "call $even",
                )
            },
        ),
    ]
}

fn post_return(body: &str) -> Vec<u8> {
    Module {
        rest: &format!(
            r#"(func (export "cabi_post_wasmouse:robot/controller@VERSION#next-move")
                (param i32) {body})"#
        ),
        ..Module::default()
    }
    .component()
}

fn recursion() -> Vec<Case> {
    let overflow = || fault("stack-overflow", "overflowed its stack");
    vec![
        Case::new(&[8], "mutual-recursion", overflow(), || {
            once(
                "(func $even (result i32) (i32.add (call $odd) (i32.const 1)))
                 (func $odd (result i32) (i32.add (call $even) (i32.const 1)))",
                "(drop (call $even))",
            )
        }),
        // Whatever depth is just under the limit: a host call is made there.
        Case::new(
            &[9],
            "host-calls-down-to-the-stack-limit",
            overflow(),
            || {
                once(
                    "(func $deeper (result i32)
                    (call $log (i32.const 0) (i32.const 0) (i32.const 1))
                    (i32.add (call $deeper) (i32.const 1)))",
                    "(drop (call $deeper))",
                )
            },
        ),
        Case::new(&[10], "recursion-with-large-frames", overflow(), || {
            let count = 1900;
            let locals = "i64 ".repeat(count);
            let set: String = (0..count)
                .map(|local| format!("(local.set {local} (i64.load (i32.const {})))", local * 6))
                .collect();
            let sum: String = (0..count)
                .map(|local| format!("(i64.store (i32.const {}) (local.get {local}))", local * 6))
                .collect();
            once(
                &format!("(func $deeper (local {locals}) {set} call $deeper {sum})"),
                "call $deeper",
            )
        }),
        Case::new(&[12], "indirect-call-cycle", overflow(), || {
            once(
                "(type $count (func (result i32)))
                 (table 2 funcref) (elem (i32.const 0) $even $odd)
                 (func $even (result i32)
                    (i32.add (call_indirect (type $count) (i32.const 1)) (i32.const 1)))
                 (func $odd (result i32)
                    (i32.add (call_indirect (type $count) (i32.const 0)) (i32.const 1)))",
                "(drop (call $even))",
            )
        }),
        Case::new(
            &[8],
            "recursion-in-core-start",
            fault_in("instantiate", 0, "stack-overflow", "overflowed its stack"),
            || {
                Module {
                    rest: "(func $deeper (result i32) (i32.add (call $deeper) (i32.const 1)))
                    (func $begin (drop (call $deeper))) (start $begin)",
                    ..Module::default()
                }
                .component()
            },
        ),
    ]
}

/// A step's fuel.
const STEP_FUEL: u64 = 2_000_000_000;

/// Burns that much fuel exactly, up to a few units that the loop itself takes first.
fn burn(fuel: u64) -> String {
    // Setting the counter takes 2, each round 6.
    let (rounds, rest) = ((fuel - 2) / 6, (fuel - 2) % 6);
    let pad = "(drop (i32.const 0))".repeat(usize::try_from(rest).expect("below 6"));
    format!(
        "(local.set $left (i32.const {rounds}))
         (loop $again
            (local.set $left (i32.sub (local.get $left) (i32.const 1)))
            (br_if $again (local.get $left)))
         {pad}"
    )
}

fn fuel_to_the_last_unit() -> Vec<Case> {
    // Entering the function takes 1, asking whether it is the first step 3, noting
    // that 2, and the action 1. A call costs 3 besides its arguments, and a component
    // reaches the host through a shim that takes 11.
    const AROUND: u64 = 7;
    const LOG: u64 = 6 + 11 + 200;
    let log = "(call $log (i32.const 0) (i32.const 0) (i32.const 0))";
    let ends = |used: u64| {
        let mut expected = harmless();
        expected["fuel"]["step_max"] = json!(used);
        expected
    };
    let case = |numbers, name: &str, expected, fuel: u64, then: String| {
        Case::new(numbers, name, expected, move || {
            once("(func $idle)", &format!("{}{then}", burn(fuel)))
        })
    };
    vec![
        case(
            &[13],
            "fuel-ends-one-before-the-last-operator",
            ends(STEP_FUEL - 1),
            STEP_FUEL - AROUND - 1,
            String::new(),
        ),
        case(
            &[13],
            "fuel-ends-at-the-last-operator",
            ends(STEP_FUEL),
            STEP_FUEL - AROUND,
            String::new(),
        ),
        // A call asks for fuel when it is entered, and there is none left.
        case(
            &[13],
            "fuel-ends-at-a-call",
            out_of_step_fuel(),
            STEP_FUEL - AROUND - 1,
            "(call $idle)".into(),
        ),
        case(
            &[13],
            "fuel-ends-behind-a-host-call",
            ends(STEP_FUEL),
            STEP_FUEL - AROUND - LOG,
            log.into(),
        ),
        case(
            &[13],
            "fuel-ends-in-a-host-call",
            out_of_step_fuel(),
            // The action behind it is not reached, and one unit is missing.
            STEP_FUEL - AROUND - LOG + 2,
            log.into(),
        ),
        Case::new(
            &[14],
            "one-unit-left-each-step",
            out_of_match_fuel(11),
            || {
                Module {
                    next: &format!("(local $left i32) {} {DRIVE_ON}", burn(STEP_FUEL - 3)),
                    ..Module::default()
                }
                .component()
            },
        ),
    ]
}

/// Nothing is left of an earlier match, and nothing differs from machine to machine.
fn state() -> Vec<Case> {
    let remembering = |numbers: &'static [u8],
                       name: &str,
                       rest: &'static str,
                       is_left: &'static str,
                       leave: &'static str| {
        Case::new(numbers, name, harmless(), move || {
            Module {
                memory: r#"(memory (export "memory") 2)"#,
                rest,
                start: &format!("(if {is_left} (then unreachable)) {leave}"),
                next: &format!("{leave} {DRIVE_ON}"),
                ..Module::default()
            }
            .component()
        })
        .with(&["--repeat=4"])
    };
    vec![
        Case::new(&[20], "moves-that-depend-on-nan-bits", harmless(), nan_bits),
        remembering(
            &[21],
            "memory-of-an-earlier-match",
            "",
            "(i32.load (i32.const 100000))",
            "(i32.store (i32.const 100000) (i32.const 1))",
        ),
        remembering(
            &[21],
            "grown-memory-of-an-earlier-match",
            "",
            "(i32.ne (memory.size) (i32.const 2))",
            "(drop (memory.grow (i32.const 1)))",
        ),
        remembering(
            &[21],
            "data-of-an-earlier-match",
            r#"(data (i32.const 70000) "\01")"#,
            "(i32.ne (i32.load8_u (i32.const 70000)) (i32.const 1))",
            "(i32.store8 (i32.const 70000) (i32.const 2))",
        ),
        remembering(
            &[22],
            "global-of-an-earlier-match",
            "(global $left (mut i64) (i64.const 0))",
            "(i32.wrap_i64 (global.get $left))",
            "(global.set $left (i64.const 1))",
        ),
        remembering(
            &[22],
            "table-of-an-earlier-match",
            "(table 4 9 funcref) (elem declare func $idle) (func $idle)",
            "(i32.eqz (i32.and (i32.eq (table.size 0) (i32.const 4))
                (ref.is_null (table.get 0 (i32.const 3)))))",
            "(table.set 0 (i32.const 3) (ref.func $idle))
             (drop (table.grow 0 (ref.func $idle) (i32.const 1)))",
        ),
        remembering(
            &[22],
            "dropped-segments-of-an-earlier-match",
            r#"(data $d "x") (table 1 funcref) (elem $e func $idle) (func $idle)"#,
            "(i32.const 0) (memory.init $d (i32.const 9) (i32.const 0) (i32.const 1))
             (table.init $e (i32.const 0) (i32.const 0) (i32.const 1))",
            "(data.drop $d) (elem.drop $e)",
        ),
    ]
}

/// Drives on as long as every NaN that it can make has the canonical bits.
fn nan_bits() -> Vec<u8> {
    const F64: [&str; 10] = [
        "(f64.div (f64.const 0) (f64.const 0))",
        "(f64.sqrt (f64.const -1))",
        "(f64.sub (f64.const inf) (f64.const inf))",
        "(f64.mul (f64.const -0) (f64.const inf))",
        "(f64.add (f64.const nan:0x123456789) (f64.const 1))",
        "(f64.add (f64.const -nan:0x4000000000001) (f64.const nan:0x2))",
        "(f64.min (f64.const -nan) (f64.const 1))",
        "(f64.nearest (f64.const -nan:0x77))",
        "(f64.promote_f32 (f32.const -nan:0x55))",
        "(f64x2.extract_lane 1 (f64x2.mul (v128.const f64x2 1 -nan:0x9) (v128.const f64x2 1 1)))",
    ];
    const F32: [&str; 5] = [
        "(f32.div (f32.const 0) (f32.const 0))",
        "(f32.demote_f64 (f64.const -nan:0x123456789))",
        "(f32.max (f32.const nan:0x1) (f32.const 1))",
        "(f32.floor (f32.const -nan:0x77))",
        "(f32x4.extract_lane 3 (f32x4.add (v128.const f32x4 1 1 1 -nan:0x9) (v128.const f32x4 1 1 1 1)))",
    ];
    let f64s = F64.map(|nan| {
        format!(
            "(if (i64.ne (i64.reinterpret_f64 {nan}) (i64.const 0x7ff8000000000000))
                (then unreachable))"
        )
    });
    let f32s = F32.map(|nan| {
        format!(
            "(if (i32.ne (i32.reinterpret_f32 {nan}) (i32.const 0x7fc00000))
                (then unreachable))"
        )
    });
    Module {
        next: &format!("{} {} {DRIVE_ON}", f64s.concat(), f32s.concat()),
        ..Module::default()
    }
    .component()
}

fn traps() -> Vec<Case> {
    const TABLE: &str = "(type $action (func (result i32)))
        (table 3 funcref)
        (elem (i32.const 1) $other)
        (func $other (param f64))";
    [
        (
            "unreachable",
            "unreachable",
            "executed `unreachable` (panicked or aborted)",
            "unreachable",
        ),
        (
            "division-by-zero",
            "division-by-zero",
            "divided by zero",
            "(i32.div_u (i32.const 1) (local.get $left)) drop",
        ),
        (
            "remainder-by-zero",
            "division-by-zero",
            "divided by zero",
            "(i64.rem_s (i64.const 1) (i64.extend_i32_u (local.get $left))) drop",
        ),
        (
            "division-overflow",
            "integer-overflow",
            "overflowed an integer",
            "(i32.div_s (i32.const 0x80000000) (i32.sub (local.get $left) (i32.const 1))) drop",
        ),
        (
            "truncation-overflow",
            "integer-overflow",
            "overflowed an integer",
            "(i32.trunc_f32_s (f32.const 1e10)) drop",
        ),
        (
            "truncation-of-nan",
            "integer-overflow",
            "converted a float that does not fit an integer",
            "(i64.trunc_f64_u (f64.const nan)) drop",
        ),
        (
            "load-out-of-bounds",
            "out-of-bounds",
            "accessed memory out of bounds",
            "(i32.load offset=0xffffffff (i32.const -1)) drop",
        ),
        (
            "load-over-the-edge",
            "out-of-bounds",
            "accessed memory out of bounds",
            "(i32.load (i32.const 65533)) drop",
        ),
        (
            "fill-out-of-bounds",
            "out-of-bounds",
            "accessed memory out of bounds",
            "(memory.fill (i32.const 65000) (i32.const 0) (i32.const 1000))",
        ),
        (
            "null-indirect-call",
            "bad-indirect-call",
            "called a null function",
            "(call_indirect (type $action) (i32.const 0)) drop",
        ),
        (
            "mistyped-indirect-call",
            "bad-indirect-call",
            "called a function of the wrong type",
            "(call_indirect (type $action) (i32.const 1)) drop",
        ),
        (
            "indirect-call-out-of-bounds",
            "out-of-bounds",
            "accessed a table out of bounds",
            "(call_indirect (type $action) (i32.const -1)) drop",
        ),
        (
            "indirect-call-over-the-edge",
            "out-of-bounds",
            "accessed a table out of bounds",
            "(call_indirect (type $action) (i32.const 3)) drop",
        ),
    ]
    .into_iter()
    .map(|(name, kind, detail, body)| {
        Case::new(&[23], name, fault(kind, detail), move || once(TABLE, body)).shown()
    })
    .collect()
}
