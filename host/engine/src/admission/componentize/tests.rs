//! Modules that become robots, and those that cannot.

use proptest::prelude::*;
use wasmparser::{Parser, Payload, Validator};
use wit_component::{StringEncoding, embed_component_metadata};

use super::super::binary::BinaryKind;
use super::componentize;
use super::encode::robot_world;

const START: &str = r#"(func (export "wasmouse:robot/controller@0.2.0#start")
    (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32))"#;
const NEXT: &str = r#"(func (export "wasmouse:robot/controller@0.2.0#next-move")
    (param i32 i32 i32) (result i32) i32.const 16)"#;
const MEMORY: &str = r#"(memory (export "memory") 1)"#;

fn module(fields: &[&str]) -> Vec<u8> {
    wat::parse_str(format!("(module {})", fields.join("\n"))).unwrap()
}

fn good() -> Vec<u8> {
    module(&[START, NEXT, MEMORY])
}

/// As a bindings generator leaves it.
fn typed(module: &[u8]) -> Vec<u8> {
    typed_with(module, StringEncoding::UTF8)
}

fn typed_with(module: &[u8], strings: StringEncoding) -> Vec<u8> {
    let (resolve, world) = robot_world(0);
    let mut bytes = module.to_vec();
    embed_component_metadata(&mut bytes, &resolve, world, strings, false).unwrap();
    bytes
}

fn export_names(component: &[u8]) -> Vec<String> {
    let mut depth = 0;
    let mut names = Vec::new();
    for payload in Parser::new(0).parse_all(component) {
        match payload.unwrap() {
            Payload::ModuleSection { .. } | Payload::ComponentSection { .. } => depth += 1,
            Payload::End(_) => depth -= 1,
            Payload::ComponentExportSection(section) if depth == 0 => {
                names.extend(section.into_iter().map(|e| e.unwrap().name.name.to_owned()));
            }
            _ => {}
        }
    }
    names
}

#[track_caller]
fn check_refused(module: &[u8], message_part: &str) {
    let error = componentize(module).unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains(message_part),
        "`{message}` lacks `{message_part}`"
    );
    assert!(!error.hint().is_empty());
}

#[test]
fn plain_exports_become_a_component() {
    let component = componentize(&good()).unwrap();
    assert_eq!(BinaryKind::of(&component), BinaryKind::Component);
    assert_eq!(
        export_names(&component),
        ["wasmouse:robot/controller@0.2.0"]
    );
}

#[test]
fn embedded_types_become_a_component() {
    let component = componentize(&typed(&good())).unwrap();
    assert_eq!(
        export_names(&component),
        ["wasmouse:robot/controller@0.2.0"]
    );
    // Types written by us and types written by a generator must agree.
    assert_eq!(component, componentize(&good()).unwrap());
}

#[test]
fn the_journal_may_be_imported_without_types() {
    let paint = r#"(import "wasmouse:robot/journal@0.2.0" "paint" (func (param i32 i32 i32)))"#;
    let component = componentize(&module(&[paint, START, NEXT, MEMORY])).unwrap();
    assert_eq!(BinaryKind::of(&component), BinaryKind::Component);
}

#[test]
fn refusals_say_what_is_missing() {
    check_refused(b"", "the file is empty");
    check_refused(b"(module)", "WebAssembly text");
    check_refused(b"\x7fELF\x02\x01\x01\0", "7f 45 4c 46");
    check_refused(b"\0asm\x09\0\0\0", "unknown version");
    check_refused(&componentize(&good()).unwrap(), "already a component");
    check_refused(&good()[..good().len() - 3], "malformed core module");
    check_refused(&module(&[]), "it exports nothing");
    check_refused(&module(&[MEMORY]), "it exports `memory`");
    check_refused(&module(&[START, MEMORY]), "#next-move`");
    check_refused(&module(&[NEXT, MEMORY]), "#start`");
    check_refused(&module(&[START, NEXT]), "export `memory`");
}

#[test]
fn refusals_name_a_foreign_import() {
    let wasi = r#"(import "wasi_unstable" "fd_write"
        (func (param i32 i32 i32 i32) (result i32)))"#;
    let module = module(&[wasi, START, NEXT, MEMORY]);
    check_refused(&module, "imports `fd_write` from `wasi_unstable`");
    check_refused(&typed(&module), "imports `fd_write`");
}

/// Imports of preview 1 that do not exist, or have another type.
#[test]
fn preview_1_is_answered_as_far_as_it_goes() {
    let with = |name: &str, parameters: &str| {
        let import = format!(
            r#"(import "wasi_snapshot_preview1" "{name}" (func (param {parameters}) (result i32)))"#
        );
        module(&[&import, START, NEXT, MEMORY])
    };
    let component = componentize(&with("fd_close", "i32")).unwrap();
    assert_eq!(
        export_names(&component),
        ["wasmouse:robot/controller@0.2.0"]
    );
    check_refused(&with("fd_fly", "i32"), "imports `fd_fly` from");
    check_refused(&with("fd_close", "i64"), "fd_close");
}

/// The adapter has the names of the module's version.
#[test]
fn preview_1_is_answered_for_other_patch_versions() {
    let text = r#"(import "wasi_snapshot_preview1" "sched_yield" (func (result i32)))
        (import "wasmouse:robot/journal@0.2.17" "log" (func (param i32 i32 i32)))"#;
    let [start, next] = [START, NEXT].map(|text| text.replace("@0.2.0", "@0.2.17"));
    let component = componentize(&module(&[text, &start, &next, MEMORY])).unwrap();
    assert_eq!(
        export_names(&component),
        ["wasmouse:robot/controller@0.2.0"]
    );
    Validator::new().validate_all(&component).unwrap();
}

#[test]
fn a_wrong_signature_is_named() {
    let start = r#"(func (export "wasmouse:robot/controller@0.2.0#start") (param i32))"#;
    check_refused(&module(&[start, NEXT, MEMORY]), "#start");
}

const PLAIN_START: &str = r#"(func (export "start")
    (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32))"#;
const PLAIN_NEXT: &str = r#"(func (export "next_move")
    (param i32 i32 i32) (result i32) i32.const 16)"#;
const PLAIN_LOG: &str = r#"(import "journal" "log" (func (param i32 i32 i32)))"#;
const FULL_LOG: &str = r#"(import "wasmouse:robot/journal@0.2.0" "log"
    (func (param i32 i32 i32)))"#;

#[test]
fn plain_names_become_the_same_component() {
    let full = componentize(&module(&[FULL_LOG, START, NEXT, MEMORY])).unwrap();
    let plain = module(&[PLAIN_LOG, PLAIN_START, PLAIN_NEXT, MEMORY]);
    assert_eq!(componentize(&plain).unwrap(), full);
    let of_wit = PLAIN_NEXT.replace("next_move", "next-move");
    let of_wit = module(&[PLAIN_LOG, PLAIN_START, &of_wit, MEMORY]);
    assert_eq!(componentize(&of_wit).unwrap(), full);
}

#[test]
fn exports_beside_plain_names_stay() {
    let initialize = r#"(func (export "_initialize"))(global (export "g") i32 i32.const 1)"#;
    let plain = componentize(&module(&[PLAIN_START, PLAIN_NEXT, MEMORY, initialize])).unwrap();
    let full = componentize(&module(&[START, NEXT, MEMORY, initialize])).unwrap();
    assert_eq!(plain, full);
    assert_ne!(plain, componentize(&good()).unwrap());
    // What a linker exports beside the full names means nothing.
    let both = r#"(func (export "start"))(func (export "next_move"))"#;
    assert!(componentize(&module(&[START, NEXT, MEMORY, both])).is_ok());
}

#[test]
fn mixed_names_are_refused() {
    for (fields, message_part) in [
        (
            [START, PLAIN_NEXT, MEMORY, ""],
            "plain for export `next_move`, full for others",
        ),
        (
            [PLAIN_START, NEXT, MEMORY, ""],
            "plain for export `start`, full for others",
        ),
        (
            [PLAIN_LOG, START, NEXT, MEMORY],
            "plain for imports from `journal`, full for its exports",
        ),
        (
            [FULL_LOG, PLAIN_START, PLAIN_NEXT, MEMORY],
            "plain for its exports, full for imports from `wasmouse:robot/journal@0.2.0`",
        ),
    ] {
        check_refused(&module(&fields), message_part);
    }
    let other = PLAIN_NEXT.replace("next_move", "next-move");
    check_refused(
        &module(&[PLAIN_START, PLAIN_NEXT, &other, MEMORY]),
        "exports both `next_move` and `next-move`",
    );
}

#[test]
fn missing_plain_names_are_named() {
    check_refused(
        &module(&[PLAIN_START, MEMORY]),
        "without the export `next_move`",
    );
    check_refused(&module(&[PLAIN_NEXT, MEMORY]), "without the export `start`");
    check_refused(
        &module(&[PLAIN_START, PLAIN_NEXT]),
        "without the export `memory`",
    );
    let foreign = r#"(import "env" "abort" (func))"#;
    check_refused(
        &module(&[foreign, PLAIN_START, PLAIN_NEXT, MEMORY]),
        "imports `abort` from `env`",
    );
    let unknown = r#"(import "journal" "print" (func))"#;
    check_refused(
        &module(&[unknown, PLAIN_START, PLAIN_NEXT, MEMORY]),
        "print",
    );
    let short = PLAIN_START.replace("i64 ", "");
    check_refused(&module(&[&short, PLAIN_NEXT, MEMORY]), "#start");
}

#[test]
fn names_of_build_targets_are_refused() {
    let next = r#"(func (export "cm32p2|wasmouse:robot/controller@0.2|next-move"))"#;
    check_refused(&module(&[next]), "the build target `cm32p2`");
}

#[test]
fn proposals_that_are_off_are_named() {
    let tag = "(tag)";
    check_refused(
        &module(&[START, NEXT, MEMORY, tag]),
        "uses exceptions at byte",
    );
}

#[test]
fn the_string_encoding_is_kept() {
    const LOG: &str = r#"(import "wasmouse:robot/journal@0.2.0" "log"
        (func (param i32 i32 i32)))"#;
    let module = module(&[LOG, START, NEXT, MEMORY]);
    let utf8 = componentize(&module).unwrap();
    assert_eq!(componentize(&typed(&module)).unwrap(), utf8);
    let utf16 = componentize(&typed_with(&module, StringEncoding::UTF16)).unwrap();
    assert_ne!(utf16, utf8);
}

#[test]
fn types_of_the_module_are_not_decoded() {
    // Anything could stand here, also what makes `wit-parser` recurse.
    let mut bytes = good();
    bytes.extend([0, 20, 14]);
    bytes.extend(b"component-type");
    bytes.extend(*b"evil!");
    assert_eq!(
        componentize(&bytes).unwrap(),
        componentize(&good()).unwrap()
    );
}

#[test]
fn missing_export_of_a_typed_module_is_named() {
    check_refused(&typed(&module(&[START, MEMORY])), "#next-move`");
    check_refused(&typed(&module(&[MEMORY])), "module with component types");
}

#[test]
fn many_exports_are_cut_and_escaped() {
    let exports: Vec<String> = (0..12)
        .map(|i| format!(r#"(func (export "\1b[31m{i:02}"))"#))
        .collect();
    let fields: Vec<&str> = exports.iter().map(String::as_str).collect();
    check_refused(&module(&fields), "4 more");
    check_refused(&module(&fields), r"`\u{1b}[31m00`");
}

proptest! {
    /// Damaged modules are rejected or wrapped; the host never panics on one.
    #[test]
    fn damage_never_panics(
        has_types in any::<bool>(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = if has_types { typed(&good()) } else { good() };
        for (at, byte) in damage {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        drop(componentize(&bytes));
    }
}
