//! Inner components: what the canonical ABI does between the components of a robot, at
//! its own `realloc`, with resources, and when it calls itself.

use super::case::{Case, fault, harmless, out_of_step_fuel, unreachable, violation};
use crate::composite::{Composite, JOURNAL, TYPES};
use crate::module::{DRIVE_ON, Module, wasm};

/// Of the cases 5 to 50 those that need an inner component.
pub fn cases() -> Vec<Case> {
    [reallocs(), values(), reentry(), resources(), lending()]
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
    /// Canonical options of the robot.
    robot_options: &'static str,
}

const TEXT: Handover = Handover {
    value: "string",
    given: "(i32.const 64) (i32.const 5)",
    parameters: "(param i32 i32)",
    realloc: "i32.const 128",
    take: "",
    options: "",
    robot_options: "",
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
            robot_options,
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
                (core func $take (canon lower (func $take) (memory $memory) {robot_options}))
                (core instance $inner (export "take" (func $take)))"#
            ),
            with: r#"(with "inner" (instance $inner))"#,
            robot: Module {
                imports: &format!(r#"(import "inner" "take" (func $take {parameters}))"#),
                memory: Composite::MEMORY,
                rest: r#"(data (i32.const 64) "hello\ff") (data (i32.const 80) "\00\d8a\00")"#,
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
        realloc(
            &[40],
            "invalid-utf-16-to-an-inner-component",
            violation("invalid utf16 encoding"),
            Handover {
                given: "(i32.const 80) (i32.const 2)",
                robot_options: UTF16,
                ..wide("i32.const 128")
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
                    (type $other (resource (rep i32)))
                    (core func $drop-other (canon resource.drop $other))
                    (core instance $things
                        (export \"new\" (func $new)) (export \"drop\" (func $drop))
                        (export \"rep\" (func $rep)) (export \"drop-other\" (func $drop-other)))",
                with: r#"(with "things" (instance $things))"#,
                robot: Module {
                    imports: r#"(import "things" "new" (func $new (param i32) (result i32)))
                        (import "things" "drop" (func $drop (param i32)))
                        (import "things" "rep" (func $rep (param i32) (result i32)))
                        (import "things" "drop-other" (func $drop-other (param i32)))"#,
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
        using(
            &[50],
            "resource-dropped-as-another-type",
            violation(
                "handle index 1 used with the wrong type, expected guest-defined resource but \
                 found a different guest-defined resource",
            ),
            "(call $drop-other (call $new (i32.const 7)))",
        ),
    ]
}

/// Handles of a resource that another component of the robot has defined.
fn lending() -> Vec<Case> {
    let lending = |numbers, name: &str, reason, next: &'static str, user: &'static str| {
        Case::new(numbers, name, violation(reason), move || {
            three_components(next, user)
        })
    };
    vec![
        lending(
            &[50],
            "resource-lent-and-given-away",
            "cannot remove owned resource while borrowed",
            "(local.set $thing (call $make)) (call $both (local.get $thing) (local.get $thing))",
            "",
        ),
        lending(
            &[50],
            "borrowed-resource-given-away",
            "cannot lift own resource from a borrow",
            "(call $use (call $make))",
            "(call $consume (local.get 0))",
        ),
        lending(
            &[50],
            "borrowed-resource-kept",
            "borrow handles still remain at the end of the call",
            "(call $use (call $make))",
            "",
        ),
        lending(
            &[49],
            "resource-lent-at-the-limit-of-handles",
            "cannot lend resource: store handle limit exceeded",
            "(local $count i32)
             (loop $again
                (local.set $thing (call $make))
                (local.set $count (i32.add (local.get $count) (i32.const 1)))
                (br_if $again (i32.lt_u (local.get $count) (i32.const 16))))
             (call $use (local.get $thing))",
            "(call $drop (local.get 0))",
        ),
    ]
}

/// A robot beside one component that has a resource and one that borrows it; with a body for
/// the robot's step, and one for the function `use` of the other.
fn three_components(next: &str, user: &str) -> Vec<u8> {
    const PROVIDER: &str = r#"(component $provider
        (type $thing (resource (rep i32)))
        (core func $new (canon resource.new $thing))
        (core module $m
            (import "own" "new" (func $new (param i32) (result i32)))
            (func (export "make") (result i32) (call $new (i32.const 7)))
            (func (export "consume") (param i32))
            (func (export "both") (param i32 i32)))
        (core instance $own (export "new" (func $new)))
        (core instance $m (instantiate $m (with "own" (instance $own))))
        (export $t "thing" (type $thing))
        (func (export "make") (result (own $t)) (canon lift (core func $m "make")))
        (func (export "consume") (param "thing" (own $t)) (canon lift (core func $m "consume")))
        (func (export "both") (param "lent" (borrow $t)) (param "given" (own $t))
            (canon lift (core func $m "both"))))"#;
    let robot = Composite {
        before: r#"
            (import "thing" (type $thing (sub resource)))
            (import "make" (func $make (result (own $thing))))
            (import "use" (func $use (param "thing" (borrow $thing))))
            (import "both" (func $both (param "lent" (borrow $thing)) (param "given" (own $thing))))
            (core func $make (canon lower (func $make)))
            (core func $use (canon lower (func $use)))
            (core func $both (canon lower (func $both)))
            (core instance $things
                (export "make" (func $make)) (export "use" (func $use))
                (export "both" (func $both)))"#,
        with: r#"(with "things" (instance $things))"#,
        robot: Module {
            imports: r#"(import "things" "make" (func $make (result i32)))
                (import "things" "use" (func $use (param i32)))
                (import "things" "both" (func $both (param i32 i32)))"#,
            memory: Composite::MEMORY,
            next: &format!("(local $thing i32) {next} {DRIVE_ON}"),
            ..Module::default()
        },
        ..Composite::default()
    };
    let robot = robot.wat().replacen("(component", "(component $robot", 1);
    wasm(&format!(
        r#"(component
            {TYPES}
            {JOURNAL}
            {PROVIDER}
            (instance $provider (instantiate $provider))
            (alias export $provider "thing" (type $thing))
            (alias export $provider "make" (func $make))
            (alias export $provider "consume" (func $consume))
            (alias export $provider "both" (func $both))
            (component $user
                (import "thing" (type $thing (sub resource)))
                (import "consume" (func $consume (param "thing" (own $thing))))
                (core func $consume (canon lower (func $consume)))
                (core func $drop (canon resource.drop $thing))
                (core module $m
                    (import "host" "consume" (func $consume (param i32)))
                    (import "host" "drop" (func $drop (param i32)))
                    (func (export "use") (param i32) {user}))
                (core instance $host
                    (export "consume" (func $consume)) (export "drop" (func $drop)))
                (core instance $m (instantiate $m (with "host" (instance $host))))
                (func (export "use") (param "thing" (borrow $thing))
                    (canon lift (core func $m "use"))))
            (instance $user (instantiate $user
                (with "thing" (type $thing)) (with "consume" (func $consume))))
            (alias export $user "use" (func $use))
            {robot}
            (instance $robot (instantiate $robot
                (with "wasmouse:robot/types@VERSION" (instance $types))
                (with "wasmouse:robot/journal@VERSION" (instance $journal))
                (with "thing" (type $thing)) (with "make" (func $make))
                (with "use" (func $use)) (with "both" (func $both))))
            (alias export $robot "wasmouse:robot/controller@VERSION" (instance $controller))
            (export "wasmouse:robot/controller@VERSION" (instance $controller)))"#
    ))
}
