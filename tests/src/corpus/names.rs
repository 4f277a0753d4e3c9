//! Names: conflicting, long, many, and with something for the terminal in them.

use super::case::{Case, invalid, over_limit, rejected, unreachable};
use crate::composite::Composite;
use crate::module::{Module, wasm};

/// The cases 61 and 69.
pub fn cases() -> Vec<Case> {
    component_names()
        .into_iter()
        .chain(module_names())
        .collect()
}

/// A robot whose component has more imports.
fn importing(imports: &str) -> Vec<u8> {
    Composite {
        before: imports,
        ..Composite::default()
    }
    .component()
}

/// A robot whose component has more exports.
fn exporting(exports: &str) -> Vec<u8> {
    Composite {
        after: exports,
        ..Composite::default()
    }
    .component()
}

fn long(length: usize) -> String {
    "n".repeat(length)
}

fn component_names() -> Vec<Case> {
    vec![
        Case::new(
            &[61],
            "conflicting-import-names",
            invalid("import name `A-B` conflicts with previous name `a-b`"),
            || importing(r#"(import "a-b" (func)) (import "A-B" (func))"#),
        ),
        Case::new(
            &[61],
            "conflicting-export-names",
            invalid("export name `A-B` conflicts with previous name `a-b`"),
            || exporting(r#"(export "a-b" (func $start)) (export "A-B" (func $start))"#),
        ),
        Case::new(
            &[61],
            "export-name-with-an-escape",
            invalid("export name `...` is not a valid extern name: `...` is not in kebab case"),
            || exporting(r#"(export "\1b[31m\u{9b}\u{202e}" (func $start))"#),
        )
        .shown(),
        Case::new(
            &[61],
            "import-name-with-an-escape",
            invalid("import name `...` is not a valid extern name: `...` is not in kebab case"),
            || importing(r#"(import "\1b[31m\u{9b}\u{202e}" (func))"#),
        )
        .shown(),
        Case::new(
            &[61],
            "import-name-of-90-kb",
            over_limit("90000 bytes in a name", 2000),
            || importing(&format!(r#"(import "{}" (func))"#, long(90_000))),
        )
        .shown(),
        Case::new(
            &[61],
            "import-name-of-a-megabyte",
            invalid("string size out of bounds"),
            || importing(&format!(r#"(import "{}" (func))"#, long(1_000_000))),
        ),
        Case::new(
            &[61],
            "100000-export-names",
            over_limit("100004 component items", 10000),
            || {
                let exports: String = (0..100_000)
                    .map(|at| format!(r#"(export "e{at}" (func $f))"#))
                    .collect();
                wasm(&format!(
                    r#"(component
                    (core module $m (func (export "f")))
                    (core instance $m (instantiate $m))
                    (func $f (canon lift (core func $m "f")))
                    {exports})"#
                ))
            },
        )
        .shown(),
    ]
}

fn module_names() -> Vec<Case> {
    vec![
        Case::new(
            &[61],
            "module-export-names-of-90-kb",
            over_limit("90001 bytes in a name", 2000),
            || {
                let exports: String = (0..100)
                    .map(|at| format!(r#"(func (export "{}{at}"))"#, long(90_000)))
                    .collect();
                wasm(&format!("(module {exports})"))
            },
        )
        .shown(),
        Case::new(
            &[61],
            "module-import-of-90-kb",
            over_limit("90000 bytes in a name", 2000),
            || {
                Module {
                    imports: &format!(r#"(import "{0}" "{0}" (func))"#, long(90_000)),
                    ..Module::default()
                }
                .core()
            },
        )
        .shown(),
        Case::new(
            &[69],
            "function-with-an-escape-in-its-name",
            unreachable(),
            || {
                Module {
                    rest: r#"(func $f
                        (@name "\1b[31mred\0afault of `flood`: \u{202e}\u{9b}<script>alert(1)")
                        unreachable)"#,
                    next: "(call $f) i32.const 16",
                    ..Module::default()
                }
                .component()
            },
        )
        .shown(),
        Case::new(
            &[69],
            "module-import-with-an-escape",
            rejected("core-module", "core module imports `\\u{202e}\\u{7}` from `\\u{1b}[31m\\u{9b}m`, which is not available to robots"),
            || {
                Module {
                    imports: r#"(import "\1b[31m\u{9b}m" "\u{202e}\07" (func))"#,
                    ..Module::default()
                }
                .core()
            },
        )
        .shown(),
        Case::new(
            &[69],
            "module-export-with-an-escape",
            rejected("core-module", "core module without component types that exports neither `start` nor `next_move`, also not under their full names (`wasmouse:robot/controller@VERSION#...`); it exports `\\u{1b}[31m\\u{9b}m\\u{202e}`"),
            || wasm(r#"(module (func (export "\1b[31m\u{9b}m\u{202e}")))"#),
        )
        .shown(),
        Case::new(
            &[69],
            "journal-function-with-an-escape",
            rejected(
                "core-module",
                "core module does not fit the world `wasmouse:robot/robot@VERSION`: failed to decode world from module: ... is missing function `...` that is required by the module",
            ),
            || {
                Module {
                    imports: r#"(import "wasmouse:robot/journal@VERSION" "\1b[31m\u{9b}m\u{202e}"
                    (func))"#,
                    ..Module::default()
                }
                .core()
            },
        )
        .shown(),
    ]
}
