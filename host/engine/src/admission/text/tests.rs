//! Text that becomes binary, and text that does not.

use super::super::binary::BinaryKind;
use super::super::examine::examine;
use super::super::rejection::Rejection;
use super::*;

/// A robot that drives on.
const ROBOT: &str = r#"(module
  (memory (export "memory") 1)
  (data (i32.const 16) "\00\01\01")
  (func (export "start") (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32))
  (func (export "next_move") (param i32 i32 i32) (result i32)
    i32.const 16))"#;

#[track_caller]
fn check_rejected(text: &[u8], name: &str, message_part: &str) {
    let examination = examine(text, &Limits::default());
    let rejection = examination.component.unwrap_err();
    let message = rejection.reason().raw().to_owned();
    assert!(
        message.contains(message_part),
        "`{message}` lacks `{message_part}`"
    );
    assert_eq!(rejection.name(), name, "{message}");
    assert!(!message.contains(char::is_control), "{message}");
    assert!(!rejection.hint().is_empty());
}

#[test]
fn text_is_recognised_by_how_it_begins() {
    for text in [
        "(module)",
        " \r\n\t(module)",
        ";; a robot\n(module)",
        "(;",
        "\u{feff}(module)",
    ] {
        assert_eq!(
            BinaryKind::of(text.as_bytes()),
            BinaryKind::Text,
            "{text:?}"
        );
    }
    for other in [
        "",
        "module",
        "; no comment",
        "\0asm",
        "\u{feff}",
        "\u{a0}(module)",
    ] {
        assert_ne!(
            BinaryKind::of(other.as_bytes()),
            BinaryKind::Text,
            "{other:?}"
        );
    }
}

#[test]
fn modules_and_components_are_admitted() {
    let limits = Limits::default();
    let examined = |text: &str| {
        examine(text.as_bytes(), &limits)
            .component
            .unwrap()
            .into_owned()
    };
    let module = examined(ROBOT);
    assert_eq!(examined(ROBOT), module, "again");
    assert_eq!(examined(&format!("\u{feff}{ROBOT}")), module, "with a mark");
    // A file of fields needs no `(module ...)`.
    let fields = ROBOT.trim_start_matches("(module").trim_end_matches(')');
    assert!(
        examine(format!("{fields})").as_bytes(), &limits)
            .component
            .is_ok()
    );
    let component = wasmprinter::print_bytes(&module).unwrap();
    assert!(component.starts_with("(component"), "{component}");
    assert!(examine(component.as_bytes(), &limits).component.is_ok());
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    check_rejected(
        b"(module\n  (func\n    i32.cnst 5))",
        "text",
        "malformed WebAssembly text: line 3, column 5: unknown operator or unexpected token, \
         at `i32.cnst 5))`",
    );
    check_rejected(b"(module", "text", "line 1, column 8: expected `)`");
    check_rejected(
        b"(module (func call $nowhere))",
        "text",
        "unknown func: failed to find name `$nowhere`, at `$nowhere))`",
    );
    check_rejected(b"(module\n\n\"\xff\")", "text", "not UTF-8: line 3");
    check_rejected(b"(module) (module)", "text", "extra tokens remaining");
    check_rejected(b"()", "text", "line 1, column 2");
    check_rejected(b"(; a comment", "text", "line 1");
    check_rejected("(\u{202e}\u{1b}[31m".as_bytes(), "text", "line 1");
    check_rejected(b"(module binary \"hello\")", "not-wasm", "a text file");
    check_rejected(b"(module)", "core-module", "exports nothing");
}

#[test]
fn what_validation_finds_is_named_with_its_line() {
    let body = |body: &str| ROBOT.replace("    i32.const 16))", body);
    check_rejected(
        body("    (if (local.get 0)\n      (then nop))\n    i32.const 16\n    i64.eqz)\n)")
            .as_bytes(),
        "text",
        "invalid WebAssembly text: line 9, column 5: type mismatch: expected i64, found i32, \
         at `i64.eqz)`",
    );
    // The function ends without a result: that stands nowhere, so it is the function.
    check_rejected(
        body("nop))").as_bytes(),
        "text",
        "line 5, column 4: type mismatch",
    );
    check_rejected(
        body("(i32.atomic.load (i32.const 0))))").as_bytes(),
        "proposal",
        "uses threads in line 6, column 2, a proposal that is off: threads run in another order",
    );
}

#[test]
fn large_text_is_rejected_unread() {
    let mut limits = Limits::default();
    limits.admission.text_bytes_max = 100;
    let text = format!("(module {})", " ".repeat(100));
    let error = to_binary(text.as_bytes(), &limits).unwrap_err();
    assert_eq!(error, TextError::TooLarge { max: 100 });
}

#[test]
fn a_short_text_cannot_make_a_long_file() {
    // The debug information of a function is longer than its text.
    let text = ROBOT.replacen("(func ", &format!("{}(func ", "(func)".repeat(100)), 1);
    let mut limits = Limits::default();
    let max = u64::try_from(text.len()).unwrap();
    limits.admission.component_bytes_max = max;
    let examination = examine(text.as_bytes(), &limits);
    let rejection = examination.component.unwrap_err();
    let is_expected = matches!(rejection, Rejection::TooLarge { max: it } if it == max);
    assert!(is_expected, "{rejection:?}");
}

/// Each opens something again and again: the parser has to give up before its stack does.
#[test]
fn deep_nesting_is_rejected() {
    let nested = |open: &str| [b"(", open.as_bytes(), &open.as_bytes().repeat(200_000)].concat();
    for open in [
        "(",
        "(module ",
        "(component ",
        "(func ",
        "(block ",
        "(i32.add ",
        "(if (then ",
        "(@a ",
        "(;",
        "(type (component ",
        "(type (list ",
        "(core module ",
        "(instance (export \"a\" ",
        "(import \"a\" (instance (export \"a\" ",
        "(type (instance (type ",
        "(alias outer ",
        "(core type (module (type ",
        "(rec ",
        "(type (sub ",
        "(ref null ",
        "(export \"a\" (func ",
        "(canon lift (core func ",
        "(data (offset ",
        "(elem (item ",
        "(try_table (catch ",
    ] {
        for text in [
            nested(open),
            [b"(module ", &nested(open)[..]].concat(),
            [b"(component ", &nested(open)[..]].concat(),
        ] {
            assert!(to_binary(&text, &Limits::default()).is_err(), "{open}");
        }
    }
    // Blocks that are written one after the other nest in the binary form alone.
    let blocks = format!(
        "(module (func {}))",
        "block ".repeat(300_000) + &"end ".repeat(300_000)
    );
    check_rejected(blocks.as_bytes(), "over-limit", "nested blocks");
    let folded = format!(
        "(module (func {}{}))",
        "(block ".repeat(300_000),
        ")".repeat(300_000)
    );
    check_rejected(folded.as_bytes(), "over-limit", "nested blocks");
}
