//! ABI: actions, pointers, text and calls that break the canonical ABI.

use serde_json::Value;

use super::binary::escaped;
use super::case::{Case, fault, harmless, out_of_step_fuel, rejected, unreachable, violation};
use crate::composite::Composite;
use crate::module::{DRIVE_ON, IMPORT_LOG, Module};

/// The cases 35 to 51, except those with an inner component.
pub fn cases() -> Vec<Case> {
    [
        actions(),
        pointers(),
        panics(),
        text(),
        floods(),
        forged(),
        encodings(),
        after_the_action(),
        types(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The fault of a call that passes more than the allowance.
const TOO_MUCH: &str = "passed more than 65536 bytes to the host in one call";

/// A robot that returns the bytes at that place as its action.
fn returning(numbers: &'static [u8], name: &str, pointer: &'static str, expected: Value) -> Case {
    Case::new(numbers, name, expected, move || {
        Module {
            next: pointer,
            rest: r#"
                (data (i32.const 32) "\00\ff\01")
                (data (i32.const 48) "\02\01\01")
                (data (i32.const 64) "\ff\ff\ff")
                (data (i32.const 65533) "\00\01\00")"#,
            ..Module::default()
        }
        .component()
    })
}

fn actions() -> Vec<Case> {
    let unknown = |number| violation(&format!("unexpected discriminant: {number}"));
    vec![
        returning(
            &[35],
            "turn-that-does-not-exist",
            "i32.const 32",
            unknown(255),
        )
        .shown(),
        returning(
            &[35],
            "action-that-does-not-exist",
            "i32.const 48",
            unknown(2),
        ),
        returning(&[35], "action-255", "i32.const 64", unknown(255)),
    ]
}

fn pointers() -> Vec<Case> {
    let outside = || violation("pointer out of bounds of memory");
    let logging = |numbers, name: &str, pointer: u32, length: u32| {
        let expected = violation("string pointer/length out of bounds of memory");
        Case::new(numbers, name, expected, move || log(1, pointer, length))
    };
    vec![
        returning(
            &[37],
            "action-behind-the-memory",
            "i32.const 65534",
            outside(),
        ),
        returning(
            &[37, 39],
            "action-at-the-end-of-the-address-space",
            "i32.const -1",
            outside(),
        ),
        returning(
            &[37],
            "action-in-the-last-bytes",
            "i32.const 65533",
            harmless(),
        ),
        // The action has no alignment, so an odd address is as good as any.
        returning(
            &[38],
            "action-at-an-odd-address",
            "i32.const 17",
            harmless(),
        ),
        logging(&[37], "text-behind-the-memory", 65_530, 7),
        logging(&[37], "text-far-behind-the-memory", 0x4000_0000, 1),
        logging(&[39], "text-that-wraps-around", 0xffff_fff0, 0x20),
        logging(&[39], "text-of-4-gib", 0, u32::MAX),
    ]
}

/// A robot that logs in each step.
fn log(level: u32, pointer: u32, length: u32) -> Vec<u8> {
    Module {
        imports: IMPORT_LOG,
        next: &format!(
            "(call $log (i32.const {level}) (i32.const {pointer}) (i32.const {length})) {DRIVE_ON}"
        ),
        ..Module::default()
    }
    .component()
}

/// A robot that logs these bytes in each step.
fn log_text(text: &[u8]) -> Vec<u8> {
    Module {
        imports: IMPORT_LOG,
        memory: r#"(memory (export "memory") 2)"#,
        rest: &format!(r#"(data (i32.const 1024) "{}")"#, escaped(text)),
        next: &format!(
            "(call $log (i32.const 3) (i32.const 1024) (i32.const {})) {DRIVE_ON}",
            text.len()
        ),
        ..Module::default()
    }
    .component()
}

/// A robot that panics with these bytes in its first step.
fn panic_with(text: &[u8]) -> Vec<u8> {
    Module {
        imports: r#"(import "wasmouse:robot/journal@VERSION" "panic"
            (func $panic (param i32 i32)))"#,
        rest: &format!(r#"(data (i32.const 1024) "{}")"#, escaped(text)),
        next: &format!(
            "(call $panic (i32.const 1024) (i32.const {})) unreachable",
            text.len()
        ),
        ..Module::default()
    }
    .component()
}

/// Panics: the message is the only text of a robot in a verdict.
fn panics() -> Vec<Case> {
    const FORGED: &str = "\u{1b}[31mred\nfault of `flood`: \u{202e}\u{9b}<script>alert(1)</script>";
    vec![
        Case::new(
            &[43],
            "panic-with-a-forged-message",
            fault("panic", &format!("panicked: {FORGED}")),
            || panic_with(FORGED.as_bytes()),
        )
        .shown(),
        Case::new(
            &[40],
            "panic-with-invalid-utf-8",
            violation("invalid utf-8 sequence of 1 bytes from index 3"),
            || panic_with(b"ok \xff"),
        ),
        Case::new(
            &[41],
            "panic-with-a-long-message",
            fault("panic", &format!("panicked: a{}", "\u{e9}".repeat(999))),
            || panic_with(format!("a{}", "\u{e9}".repeat(20_000)).as_bytes()),
        )
        .shown(),
        Case::new(
            &[40],
            "panic-outside-memory",
            violation("string pointer/length out of bounds of memory"),
            || {
                Module {
                    imports: r#"(import "wasmouse:robot/journal@VERSION" "panic"
                        (func $panic (param i32 i32)))"#,
                    next: "(call $panic (i32.const -8) (i32.const 16)) unreachable",
                    ..Module::default()
                }
                .component()
            },
        ),
    ]
}

fn text() -> Vec<Case> {
    let malformed = |name: &str, bytes: &'static [u8], detail: &str| {
        Case::new(&[40], name, violation(detail), move || log_text(bytes))
    };
    let of_length = |numbers, name: &str, expected, length: usize| {
        Case::new(numbers, name, expected, move || {
            log_text(&vec![b'x'; length])
        })
    };
    vec![
        malformed(
            "invalid-utf-8",
            b"ok \xff",
            "invalid utf-8 sequence of 1 bytes from index 3",
        ),
        malformed(
            "overlong-utf-8",
            b"\xc0\x80",
            "invalid utf-8 sequence of 1 bytes from index 0",
        ),
        malformed(
            "surrogate-in-utf-8",
            b"ok\xed\xa0\x80",
            "invalid utf-8 sequence of 1 bytes from index 2",
        ),
        malformed(
            "cut-utf-8",
            b"\xe2\x82",
            "incomplete utf-8 byte sequence from index 0",
        ),
        of_length(&[42], "text-of-exactly-the-allowance", harmless(), 65_536),
        of_length(
            &[42],
            "text-over-the-allowance",
            fault("invalid-action", TOO_MUCH),
            65_537,
        )
        .shown(),
        Case::new(
            &[35],
            "level-that-does-not-exist",
            violation("unexpected discriminant: 4"),
            || log(4, 0, 0),
        ),
    ]
}

/// Calls into the journal for ever.
fn floods() -> Vec<Case> {
    let flood = |numbers: &'static [u8], name: &str, import: &'static str, call: &'static str| {
        Case::new(numbers, name, out_of_step_fuel(), move || {
            Module {
                imports: &format!(r#"(import "wasmouse:robot/journal@VERSION" {import})"#),
                next: &format!("(loop $forever {call} br $forever) unreachable"),
                ..Module::default()
            }
            .component()
        })
    };
    vec![
        flood(
            &[41],
            "flood-of-long-log-lines",
            r#""log" (func $log (param i32 i32 i32))"#,
            "(call $log (i32.const 0) (i32.const 0) (i32.const 60000))",
        ),
        flood(
            &[41],
            "flood-of-empty-log-lines",
            r#""log" (func $log (param i32 i32 i32))"#,
            "(call $log (i32.const 0) (i32.const 0) (i32.const 0))",
        ),
        flood(
            &[],
            "flood-of-paint",
            r#""paint" (func $paint (param i32 i32 i32))"#,
            "(call $paint (i32.const 0) (i32.const 0) (i32.const 1))",
        ),
        flood(
            &[],
            "flood-of-paint-outside",
            r#""paint" (func $paint (param i32 i32 i32))"#,
            "(call $paint (i32.const -1) (i32.const 300) (i32.const 1))",
        ),
        flood(
            &[],
            "flood-of-long-labels",
            r#""label" (func $label (param i32 i32 i32 i32))"#,
            "(call $label (i32.const 0) (i32.const 0) (i32.const 0) (i32.const 60000))",
        ),
        flood(
            &[],
            "flood-of-beliefs",
            r#""wall" (func $wall (param i32 i32 i32 i32))"#,
            "(call $wall (i32.const 0) (i32.const 0) (i32.const 0) (i32.const 1))",
        ),
    ]
}

/// Text that wants to be something else, in log lines and labels.
const FORGED: &[&str] = &[
    "\u{1b}[2J\u{1b}[H\u{1b}]0;owned\u{7}\u{1b}[31mred",
    "\u{9b}31mC1\u{85}next line",
    "one\nfault of `flood` in `test_maze_01`: cheated\r\nwasmouse: flood finished 0.000",
    "\u{202e}gnp.exe\u{2066}isolated\u{200f}\u{200b}zero",
    "nul\0, delete \u{7f}, bell \u{7}, backspace \u{8}",
    "<script>alert(1)</script><img src=x onerror=\"alert(1)\">&lt;&amp;'\"",
    "]]></svg><script>alert(2)</script><!-- --> {{1}} ${1} `1` | a | b |",
    "{\"verdict\": \"finished\", \"score\": 0.0}",
    "\u{e000}\u{fdd0}\u{fffe}\u{10ffff} \u{1f9ff}e\u{301}\u{301}\u{301}",
];

fn forged() -> Vec<Case> {
    vec![
        Case::new(&[43], "forged-text", harmless(), || {
            let mut place = 1024;
            let (mut data, mut calls) = (String::new(), String::new());
            for text in FORGED {
                let length = text.len();
                data += &format!(
                    r#"(data (i32.const {place}) "{}")"#,
                    escaped(text.as_bytes())
                );
                calls += &format!(
                    "(call $log (i32.const 1) (i32.const {place}) (i32.const {length}))
                     (call $label (i32.const 1) (i32.const 1)
                        (i32.const {place}) (i32.const {length}))
                     (call $label (i32.const 2) (i32.const 1)
                        (i32.const {place}) (i32.const {length}))"
                );
                place += length;
            }
            Module {
                imports: &format!(
                    r#"{IMPORT_LOG} (import "wasmouse:robot/journal@VERSION" "label"
                        (func $label (param i32 i32 i32 i32)))"#
                ),
                rest: &data,
                start: &calls,
                next: &format!("{calls} {DRIVE_ON}"),
                ..Module::default()
            }
            .component()
        })
        .shown(),
        // In standings a robot has the name of its file.
        Case::new(&[43], "forged-file-name", harmless(), || log(1, 0, 0))
            .named("a\u{1b}[31m\u{9b}b\u{202e}<script>alert(3)<img src=x>\u{e0041}\u{7f}")
            .shown(),
        Case::new(
            &[43],
            "forged-file-name-of-a-rejected-file",
            rejected("empty", "the file is empty"),
            Vec::new,
        )
        .named("b\u{1b}[31m\u{9b}b\u{202e}<script>alert(3)<img src=x>\nflood: finished")
        .shown(),
    ]
}

/// Text in the other encodings that the canonical ABI knows.
fn encodings() -> Vec<Case> {
    let encoded =
        |name: &str, encoding: &'static str, expected, bytes: &'static [u8], call: &'static str| {
            Case::new(&[44], name, expected, move || {
                Composite {
                    log_options: encoding,
                    robot: Module {
                        imports: IMPORT_LOG,
                        memory: Composite::MEMORY,
                        rest: &format!(r#"(data (i32.const 64) "{}")"#, escaped(bytes)),
                        next: &format!("(call $log {call}) {DRIVE_ON}"),
                        ..Module::default()
                    },
                    memory: r#"(memory (export "memory") 4)"#,
                    ..Composite::default()
                }
                .component()
            })
        };
    const UTF16: &str = "string-encoding=utf16";
    const LATIN1: &str = "string-encoding=latin1+utf16";
    let level_at_64 = "(i32.const 1) (i32.const 64) (i32.const 2)";
    vec![
        encoded("utf-16", UTF16, harmless(), b"h\0i\0", level_at_64).shown(),
        encoded(
            "utf-16-with-forged-text",
            UTF16,
            harmless(),
            b"\x1b\0\x2e\x20",
            level_at_64,
        )
        .shown(),
        encoded(
            "utf-16-with-half-a-pair",
            UTF16,
            violation("unpaired surrogate found: d800"),
            b"\x00\xd8a\0",
            level_at_64,
        ),
        encoded(
            "utf-16-at-an-odd-address",
            UTF16,
            violation("string pointer not aligned to 2"),
            b"",
            "(i32.const 1) (i32.const 65) (i32.const 2)",
        ),
        encoded(
            "utf-16-whose-size-wraps-around",
            UTF16,
            violation("string pointer/length out of bounds of memory"),
            b"",
            "(i32.const 1) (i32.const 0) (i32.const 0x80000001)",
        ),
        encoded(
            "utf-16-over-the-allowance",
            UTF16,
            fault("invalid-action", TOO_MUCH),
            b"",
            "(i32.const 1) (i32.const 0) (i32.const 65536)",
        ),
        encoded("latin-1", LATIN1, harmless(), b"\xe9\x9b", level_at_64).shown(),
        encoded(
            "latin-1-that-grows-over-the-allowance",
            LATIN1,
            fault("invalid-action", TOO_MUCH),
            b"",
            "(i32.const 1) (i32.const 0) (i32.const 65537)",
        ),
        encoded(
            "latin-1-marked-as-utf-16",
            LATIN1,
            harmless(),
            b"h\0i\0",
            "(i32.const 1) (i32.const 64) (i32.const 0x80000002)",
        ),
        encoded(
            "latin-1-marked-and-too-long",
            LATIN1,
            violation("string pointer/length out of bounds of memory"),
            b"",
            "(i32.const 1) (i32.const 64) (i32.const -1)",
        ),
    ]
}

/// What runs after the action is returned.
fn after_the_action() -> Vec<Case> {
    let after = |name: &str, expected, body: &'static str| {
        Case::new(&[48], name, expected, move || {
            Module {
                imports: IMPORT_LOG,
                rest: &format!(
                    r#"(func (export "cabi_post_wasmouse:robot/controller@VERSION#next-move")
                        (param i32) {body})"#
                ),
                ..Module::default()
            }
            .component()
        })
    };
    vec![
        after("trap-in-post-return", unreachable(), "unreachable"),
        after(
            "log-in-post-return",
            violation("wasm trap: cannot leave component instance"),
            "(call $log (i32.const 0) (i32.const 0) (i32.const 1))",
        ),
        after(
            "growth-in-post-return",
            fault(
                "out-of-memory",
                "exceeded the memory limit: requested 4096 MiB, limit 256 MiB",
            ),
            "(drop (memory.grow (i32.const 65535)))",
        ),
    ]
}

/// The right names with other types.
fn types() -> Vec<Case> {
    const MOVE: &str = r#"(record (field "turn" $the-turn) (field "advance" s8))"#;
    const ACTION: &str = r#"(variant (case "move" $the-move) (case "reset"))"#;
    const SENSORS: &str = r#"(record (field "left" u32) (field "front" u32) (field "right" u32))"#;
    let other = |name: &str, reason: &str, right: &'static str, wrong: &'static str| {
        let reason = format!(
            "the component does not fit the world `robot`: \
             the function `next-move` has the wrong type: {reason}"
        );
        Case::new(&[51], name, rejected("wrong-type", &reason), move || {
            let text = Composite::default().wat();
            assert!(text.contains(right), "{right}");
            crate::module::wasm(&text.replace(right, wrong))
        })
    };
    vec![
        other(
            "flags-for-a-move",
            "type mismatch for case move: expected `record` found `flags`",
            MOVE,
            r#"(flags "turn" "advance")"#,
        )
        .shown(),
        other(
            "a-list-for-a-move",
            "type mismatch for case move: expected `record` found `list`",
            MOVE,
            "(list u8)",
        ),
        other(
            "a-tuple-for-a-move",
            "type mismatch for case move: expected `record` found `tuple`",
            MOVE,
            "(tuple $the-turn s8)",
        ),
        other(
            "an-unsigned-advance",
            "type mismatch for case move: type mismatch for field advance: expected `s8` found `u8`",
            MOVE,
            r#"(record (field "turn" $the-turn) (field "advance" u8))"#,
        ),
        other(
            "the-fields-of-a-move-swapped",
            "type mismatch for case move: type mismatch for field turn: expected `enum` found `s8`",
            MOVE,
            r#"(record (field "advance" s8) (field "turn" $the-turn))"#,
        ),
        other(
            "one-field-more",
            "type mismatch for case move: expected record of 2 fields, found 3 fields",
            MOVE,
            r#"(record (field "turn" $the-turn) (field "advance" s8) (field "more" s8))"#,
        ),
        other(
            "the-cases-of-an-action-swapped",
            "expected variant case named move, found reset",
            ACTION,
            r#"(variant (case "reset") (case "move" $the-move))"#,
        ),
        other(
            "one-action-more",
            "expected variant of 2 cases, found 3 cases",
            ACTION,
            r#"(variant (case "move" $the-move) (case "reset") (case "win"))"#,
        ),
        other(
            "an-option-for-an-action",
            "expected `variant` found `option`",
            ACTION,
            "(option $the-move)",
        ),
        other(
            "a-tuple-for-the-sensors",
            "expected `record` found `tuple`",
            SENSORS,
            "(tuple u32 u32 u32)",
        ),
    ]
}
