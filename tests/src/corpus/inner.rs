//! Inner components: what the canonical ABI does between the components of a robot, at
//! its own `realloc`, with resources, and when it calls itself.

use super::case::{Case, fault, harmless, out_of_step_fuel, unreachable, violation};
use crate::composite::Composite;
use crate::module::{DRIVE_ON, Module};

/// Of the cases 5 to 50 those that need an inner component.
pub fn cases() -> Vec<Case> {
    [reallocs(), values(), reentry(), resources()]
        .into_iter()
        .flatten()
        .collect()
}

/// A robot that hands a value to an inner component in each step.
#[derive(Clone, Copy)]
struct Handover {
    /// The type of the value.
    value: &'static str,
    /// The value as the robot has it, on the stack.
    given: &'static str,
    /// The parameters that it is in core WebAssembly.
    parameters: &'static str,
    /// Body of the inner component's `realloc`.
    realloc: &'static str,
    /// Body of the inner component's function.
    take: &'static str,
    /// Canonical options of the inner component.
    options: &'static str,
}

const TEXT: Handover = Handover {
    value: "string",
    given: "(i32.const 64) (i32.const 5)",
    parameters: "(param i32 i32)",
    realloc: "i32.const 128",
    take: "",
    options: "",
};

impl Handover {
    fn component(self) -> Vec<u8> {
        let Self {
            value,
            given,
            parameters,
            realloc,
            take,
            options,
        } = self;
        let callee = format!(
            r#"(component $callee
                (type $level' (enum "debug" "info" "warning" "error"))
                (import "level" (type $level (eq $level')))
                (import "log" (func $log (param "level" $level) (param "message" string)))
                (core module $libc (memory (export "memory") 1))
                (core instance $libc (instantiate $libc))
                (alias core export $libc "memory" (core memory $memory))
                (core func $log (canon lower (func $log) (memory $memory)))
                (core module $m
                    (import "libc" "memory" (memory 1))
                    (import "host" "log" (func $log (param i32 i32 i32)))
                    (func $realloc (export "realloc")
                        (param i32 i32 i32 i32) (result i32) {realloc})
                    (func (export "take") {parameters} {take}))
                (core instance $host (export "log" (func $log)))
                (core instance $m (instantiate $m
                    (with "libc" (instance $libc)) (with "host" (instance $host))))
                (alias core export $m "realloc" (core func $realloc))
                (func (export "take") (param "value" {value})
                    (canon lift (core func $m "take")
                        (memory $memory) (realloc $realloc) {options})))"#
        );
        Composite {
            before: &format!(
                r#"(import "take" (func $take (param "value" {value})))
                (core func $take (canon lower (func $take) (memory $memory)))
                (core instance $inner (export "take" (func $take)))"#
            ),
            with: r#"(with "inner" (instance $inner))"#,
            robot: Module {
                imports: &format!(r#"(import "inner" "take" (func $take {parameters}))"#),
                memory: Composite::MEMORY,
                rest: r#"(data (i32.const 64) "hello\ff")"#,
                next: &format!("(call $take {given}) {DRIVE_ON}"),
                ..Module::default()
            },
            ..Composite::default()
        }
        .beside(&callee)
    }
}

fn reallocs() -> Vec<Case> {
    const UTF16: &str = "string-encoding=utf16";
    let realloc = |numbers, name: &str, expected, handover: Handover| {
        Case::new(numbers, name, expected, move || handover.component())
    };
    let body = |realloc| Handover { realloc, ..TEXT };
    let wide = |realloc| Handover {
        options: UTF16,
        ..body(realloc)
    };
    vec![
        realloc(&[], "text-to-an-inner-component", harmless(), TEXT),
        realloc(
            &[5],
            "loop-in-realloc",
            out_of_step_fuel(),
            body("(loop $forever br $forever) unreachable"),
        ),
        // The null pointer is an address like any other.
        realloc(
            &[45],
            "realloc-that-returns-0",
            harmless(),
            body("i32.const 0"),
        ),
        realloc(
            &[45],
            "realloc-out-of-bounds",
            violation("wasm trap: string content out-of-bounds"),
            body("i32.const 65533"),
        ),
        realloc(
            &[45],
            "realloc-at-the-end-of-the-address-space",
            violation("wasm trap: string content out-of-bounds"),
            body("i32.const -1"),
        ),
        realloc(
            &[45],
            "realloc-misaligned",
            violation("wasm trap: unaligned pointer"),
            wide("i32.const 129"),
        ),
        realloc(
            &[45],
            "realloc-that-traps",
            unreachable(),
            body("unreachable"),
        ),
        realloc(
            &[46],
            "realloc-that-logs",
            violation("wasm trap: cannot leave component instance"),
            body("(call $log (i32.const 0) (i32.const 0) (i32.const 1)) i32.const 128"),
        ),
        realloc(
            &[45],
            "realloc-that-overflows-the-stack",
            fault("stack-overflow", "overflowed its stack"),
            body(
                "(i32.add (i32.const 1)
                (call $realloc (local.get 0) (local.get 1) (local.get 2) (local.get 3)))",
            ),
        ),
        realloc(
            &[39],
            "text-of-4-gib-to-an-inner-component",
            violation("wasm trap: string content out-of-bounds"),
            Handover {
                given: "(i32.const 64) (i32.const -1)",
                ..TEXT
            },
        ),
        realloc(
            &[40],
            "invalid-utf-8-to-an-inner-component",
            violation("invalid utf8 encoding"),
            Handover {
                given: "(i32.const 64) (i32.const 6)",
                ..wide("i32.const 0")
            },
        ),
    ]
}

fn values() -> Vec<Case> {
    let value = |name: &str, expected, value, given, take| {
        let handover = Handover {
            value,
            given,
            take,
            parameters: "(param i32)",
            ..TEXT
        };
        Case::new(&[36], name, expected, move || handover.component())
    };
    vec![
        // Every number but 0 is true, and arrives as 1.
        value(
            "bool-2",
            harmless(),
            "bool",
            "(i32.const 2)",
            "(if (i32.ne (local.get 0) (i32.const 1)) (then unreachable))",
        ),
        value(
            "surrogate-char",
            violation("wasm trap: invalid `char` bit pattern"),
            "char",
            "(i32.const 0xd800)",
            "",
        ),
        value(
            "char-beyond-unicode",
            violation("wasm trap: invalid `char` bit pattern"),
            "char",
            "(i32.const 0x110000)",
            "",
        ),
        value(
            "number-that-does-not-fit",
            harmless(),
            "u8",
            "(i32.const 0x1ff)",
            "(if (i32.ne (local.get 0) (i32.const 0xff)) (then unreachable))",
        ),
    ]
}

/// Calls into an instance that has not returned yet.
fn reentry() -> Vec<Case> {
    const TABLE: &str = r#"(memory (export "memory") 1) (table (export "table") 1 funcref)"#;
    vec![
        Case::new(
            &[47],
            "re-entry-of-itself",
            violation("wasm trap: cannot enter component instance"),
            || {
                Composite {
                    memory: TABLE,
                    robot: Module {
                        imports: r#"(import "env" "table" (table 1 funcref))
                        (type $next (func (param i32 i32 i32 i32)))"#,
                        memory: Composite::MEMORY,
                        next:
                            "(call_indirect (type $next) (i32.const 1) (i32.const 1) (i32.const 1)
                        (i32.const 32) (i32.const 0)) i32.const 32",
                        ..Module::default()
                    },
                    after: r#"(core func $again (canon lower (func $next-move) (memory $memory)))
                    (core module $fix
                        (import "env" "table" (table 1 funcref))
                        (import "own" "again" (func $again (param i32 i32 i32 i32)))
                        (elem (i32.const 0) $again))
                    (core instance $own (export "again" (func $again)))
                    (core instance (instantiate $fix
                        (with "env" (instance $libc)) (with "own" (instance $own))))"#,
                    ..Composite::default()
                }
                .component()
            },
        ),
        Case::new(
            &[47],
            "call-of-a-component-inside-itself",
            violation("wasm trap: cannot enter component instance"),
            || {
                Composite {
                    memory: TABLE,
                    robot: Module {
                        imports: r#"(import "env" "table" (table 1 funcref))
                        (type $go (func))"#,
                        memory: Composite::MEMORY,
                        next: "(call_indirect (type $go) (i32.const 0)) i32.const 16",
                        ..Module::default()
                    },
                    after: r#"(component $callee
                        (core module $m (func (export "go")))
                        (core instance $m (instantiate $m))
                        (func (export "go") (canon lift (core func $m "go"))))
                    (instance $callee (instantiate $callee))
                    (core func $go (canon lower (func $callee "go")))
                    (core module $fix
                        (import "env" "table" (table 1 funcref))
                        (import "own" "go" (func $go))
                        (elem (i32.const 0) $go))
                    (core instance $own (export "go" (func $go)))
                    (core instance (instantiate $fix
                        (with "env" (instance $libc)) (with "own" (instance $own))))"#,
                    ..Composite::default()
                }
                .component()
            },
        ),
    ]
}

/// Handles of the robot's own resource type.
fn resources() -> Vec<Case> {
    let using = |numbers, name: &str, expected, next: &'static str| {
        Case::new(numbers, name, expected, move || {
            Composite {
                before: "(type $thing (resource (rep i32)))
                    (core func $new (canon resource.new $thing))
                    (core func $drop (canon resource.drop $thing))
                    (core func $rep (canon resource.rep $thing))
                    (core instance $things
                        (export \"new\" (func $new)) (export \"drop\" (func $drop))
                        (export \"rep\" (func $rep)))",
                with: r#"(with "things" (instance $things))"#,
                robot: Module {
                    imports: r#"(import "things" "new" (func $new (param i32) (result i32)))
                        (import "things" "drop" (func $drop (param i32)))
                        (import "things" "rep" (func $rep (param i32) (result i32)))"#,
                    memory: Composite::MEMORY,
                    next: &format!("(local $thing i32) {next} {DRIVE_ON}"),
                    ..Module::default()
                },
                ..Composite::default()
            }
            .component()
        })
    };
    vec![
        using(
            &[49],
            "resources-for-ever",
            violation("cannot allocate another handle: store handle limit exceeded"),
            "(loop $forever (drop (call $new (i32.const 7))) (br $forever))",
        ),
        using(
            &[49],
            "resources-given-back",
            out_of_step_fuel(),
            "(loop $forever (call $drop (call $new (i32.const 7))) (br $forever))",
        )
        .seconds(200)
        .long(),
        using(
            &[50],
            "resource-dropped-twice",
            violation("unknown handle index 1"),
            "(local.set $thing (call $new (i32.const 7)))
             (call $drop (local.get $thing)) (call $drop (local.get $thing))",
        ),
        using(
            &[50],
            "resource-never-made",
            violation("unknown handle index 12345"),
            "(call $drop (i32.const 12345))",
        ),
        using(
            &[50],
            "resource-asked-after-its-drop",
            violation("unknown handle index 1"),
            "(local.set $thing (call $new (i32.const 7)))
             (call $drop (local.get $thing)) (drop (call $rep (local.get $thing)))",
        ),
    ]
}
