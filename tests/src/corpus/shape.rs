//! Shape: modules and components that lack what a robot has, or have what it must not.

use serde_json::Value;

use super::case::{Case, harmless, invalid, rejected};
use crate::composite::{Composite, TYPES};
use crate::module::{Module, START_PARAMETERS, versioned, wasm};

/// The cases 54 and 58 to 60.
pub fn cases() -> Vec<Case> {
    [modules(), exports(), imports()]
        .into_iter()
        .flatten()
        .collect()
}

fn modules() -> Vec<Case> {
    let module = |name: &str, reason: &str, text: String| {
        Case::new(&[54], name, rejected("core-module", reason), move || {
            wasm(&text)
        })
    };
    let start =
        format!(r#"(func (export "wasmouse:robot/controller@VERSION#start") {START_PARAMETERS})"#);
    let importing = |import: &str| {
        Module {
            imports: import,
            ..Module::default()
        }
        .wat()
    };
    vec![
        module(
            "empty-module",
            "core module without component types that exports neither `start` nor \
             `next_move`, also not under their full names \
             (`wasmouse:robot/controller@VERSION#...`); it exports nothing",
            "(module)".into(),
        ),
        module(
            "module-without-next-move",
            "core module without the export `wasmouse:robot/controller@VERSION#next-move`",
            format!(r#"(module (memory (export "memory") 1) {start})"#),
        ),
        module(
            "module-without-memory",
            "core module without the export `memory`",
            Module {
                memory: "(memory 1)",
                ..Module::default()
            }
            .wat(),
        ),
        module(
            "module-with-a-memory-that-is-a-function",
            "...: module does not export a memory named `memory`",
            Module {
                memory: r#"(memory 1) (func (export "memory"))"#,
                ..Module::default()
            }
            .wat(),
        ),
        module(
            "module-with-other-signatures",
            "...: type mismatch for function `start`: expected `[...]` but found `[] -> []`",
            r#"(module (memory (export "memory") 1)
                (func (export "wasmouse:robot/controller@VERSION#start"))
                (func (export "wasmouse:robot/controller@VERSION#next-move")
                    (param i32 i32 i32) (result i32) i32.const 0))"#
                .into(),
        ),
        module(
            "module-that-imports-an-older-wasi",
            "core module imports `fd_write` from `wasi_unstable`, which is not available to robots",
            importing(
                r#"(import "wasi_unstable" "fd_write"
                (func (param i32 i32 i32 i32) (result i32)))"#,
            ),
        ),
        module(
            "module-that-imports-an-intrinsic",
            "core module imports `[waitable-set-new]` from `$root`, which is not available to robots",
            importing(r#"(import "$root" "[waitable-set-new]" (func (result i32)))"#),
        ),
        module(
            "module-that-lowers-asynchronously",
            "...: the `async` canonical option requires an async function type...",
            importing(
                r#"(import "wasmouse:robot/journal@VERSION" "[async-lower]log"
                (func (param i32 i32 i32) (result i32)))"#,
            ),
        ),
        module(
            "module-that-drops-resources-of-the-journal",
            "... is missing function `[resource-drop]log` that is required by the module",
            importing(
                r#"(import "wasmouse:robot/journal@VERSION" "[resource-drop]log"
                (func (param i32)))"#,
            ),
        ),
        module(
            "module-that-imports-another-log",
            "...: type mismatch for function `log`: expected `[I32, I32, I32] -> []` but found `[I64] -> []`",
            importing(
                r#"(import "wasmouse:robot/journal@VERSION" "log"
                (func (param i64)))"#,
            ),
        ),
        module(
            "module-that-imports-what-the-journal-lacks",
            "... is missing function `win` that is required by the module",
            importing(r#"(import "wasmouse:robot/journal@VERSION" "win" (func))"#),
        ),
        module(
            "module-with-two-starts",
            "malformed core module: duplicate export name `wasmouse:robot/controller@VERSION#start` already defined at byte ...",
            Module {
                rest: &start,
                ..Module::default()
            }
            .wat(),
        ),
    ]
}

/// A component with that text for another, which has to be there.
fn changed(right: &'static str, wrong: &str) -> Vec<u8> {
    let (text, right) = (Composite::default().wat(), versioned(right));
    assert!(text.contains(&right), "{right}");
    wasm(&text.replace(&right, wrong))
}

fn other_version(version: &str) -> Value {
    let reason = format!("the robot was built for wasmouse:robot@{version}; this host runs 0.2.x");
    rejected("other-version", &reason)
}

fn exports() -> Vec<Case> {
    let other = |name: &str, expected: Value, right: &'static str, wrong: &'static str| {
        Case::new(&[58], name, expected, move || changed(right, wrong))
    };
    let missing = |exports: &str| {
        rejected(
            "no-controller",
            &format!(
                "the component does not export \
            `wasmouse:robot/controller@VERSION`; it exports {exports}"
            ),
        )
    };
    const EXPORT: &str = r#"(export "wasmouse:robot/controller@VERSION" (instance $controller))"#;
    const NEXT: &str = r#"(export "next-move" (func $next-move))"#;
    let wrong_type = |reason: &str| {
        rejected(
            "wrong-type",
            &format!("the component does not fit the world `robot`: {reason}"),
        )
    };
    vec![
        Case::new(&[58], "empty-component", missing("nothing"), || {
            wasm("(component)")
        }),
        other("controller-not-exported", missing("nothing"), EXPORT, ""),
        other(
            "controller-of-another-version",
            other_version("0.1.0"),
            EXPORT,
            r#"(export "wasmouse:robot/controller@0.1.0" (instance $controller))"#,
        ),
        other(
            "controller-misspelt",
            missing("`wasmouse:robot/controler@VERSION`"),
            EXPORT,
            r#"(export "wasmouse:robot/controler@VERSION" (instance $controller))"#,
        ),
        other(
            "controller-of-a-later-patch",
            harmless(),
            EXPORT,
            r#"(export "wasmouse:robot/controller@0.2.99" (instance $controller))"#,
        ),
        other(
            "controller-of-two-patch-versions",
            wrong_type("`wasmouse:robot/controller@VERSION` is not an interface"),
            EXPORT,
            r#"(export "wasmouse:robot/controller@0.2.99" (instance $controller))
                (export "wasmouse:robot/controller@VERSION" (func $start))"#,
        ),
        other(
            "controller-that-is-a-function",
            wrong_type("`wasmouse:robot/controller@VERSION` is not an interface"),
            EXPORT,
            r#"(export "wasmouse:robot/controller@VERSION" (func $start))"#,
        ),
        other(
            "controller-without-next-move",
            wrong_type("`wasmouse:robot/controller@VERSION` has no function `next-move`"),
            NEXT,
            "",
        ),
        other(
            "next-move-renamed",
            invalid(
                "export name `next_move` is not a valid extern name: `next_move` is not in kebab case",
            ),
            NEXT,
            r#"(export "next_move" (func $next-move))"#,
        ),
        other(
            "start-in-place-of-next-move",
            wrong_type("the function `next-move` has the wrong type: ..."),
            NEXT,
            r#"(export "next-move" (func $start))"#,
        ),
    ]
}

/// A robot whose component has more imports.
fn importing(imports: &str) -> Vec<u8> {
    Composite {
        before: imports,
        ..Composite::default()
    }
    .component()
}

fn imports() -> Vec<Case> {
    let unknown = |numbers, name: &str, import: &str, text: &'static str| {
        let reason = format!("the component imports `{import}`, which is not available to robots");
        Case::new(
            numbers,
            name,
            rejected("unknown-import", &reason),
            move || importing(text),
        )
    };
    const LEVEL: &str = r#"(export "level" (type $the-level (eq $level)))"#;
    const MESSAGE: &str = r#"(param "message" string)"#;
    vec![
        unknown(
            &[59],
            "import-of-wasi-cli",
            "wasi:cli/environment@0.2.0",
            r#"(import "wasi:cli/environment@0.2.0" (instance))"#,
        )
        .shown(),
        unknown(
            &[59],
            "import-of-wasi-clocks",
            "wasi:clocks/monotonic-clock@0.2.3",
            r#"(import "wasi:clocks/monotonic-clock@0.2.3" (instance
                (export "now" (func (result u64)))))"#,
        ),
        unknown(
            &[59],
            "import-of-wasi-sockets",
            "wasi:sockets/tcp@0.2.0",
            r#"(import "wasi:sockets/tcp@0.2.0" (instance))"#,
        ),
        Case::new(
            &[59],
            "import-of-a-later-journal",
            other_version("0.3.0"),
            || wasm(r#"(component (import "wasmouse:robot/journal@0.3.0" (instance)))"#),
        ),
        Case::new(
            &[59],
            "log-of-another-type",
            rejected(
                "wrong-type",
                "...: type mismatch with parameters: expected 2-tuple, found 0-tuple",
            ),
            || {
                wasm(
                    r#"(component
                (import "wasmouse:robot/journal@VERSION" (instance (export "log" (func))))
                (instance $empty)
                (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#,
                )
            },
        ),
        Case::new(
            &[59],
            "log-of-lists",
            rejected(
                "wrong-type",
                "...: type mismatch with parameters: expected `string` found `list`",
            ),
            || changed(MESSAGE, r#"(param "message" (list u8))"#),
        ),
        Case::new(
            &[59],
            "journal-with-one-function-more",
            rejected(
                "wrong-type",
                "...: instance export `win` has the wrong type: function implementation is missing",
            ),
            || changed(LEVEL, &format!(r#"{LEVEL} (export "win" (func))"#)),
        ),
        unknown(
            &[60],
            "import-of-a-function",
            "now",
            r#"(import "now" (func (result u64)))"#,
        ),
        unknown(
            &[60],
            "import-of-a-module",
            "m",
            r#"(import "m" (core module))"#,
        ),
        unknown(
            &[60],
            "import-of-a-component",
            "c",
            r#"(import "c" (component))"#,
        ),
        unknown(
            &[60],
            "import-of-an-instance",
            "i",
            r#"(import "i" (instance))"#,
        ),
        unknown(
            &[60],
            "import-of-a-type",
            "t",
            r#"(import "t" (type (sub resource)))"#,
        ),
        Case::new(
            &[60],
            "import-by-address",
            rejected(
                "invalid",
                "the component is not valid: import name `...` is not a valid extern name...",
            ),
            || importing(r#"(import "url=<https://robots.example/a.wasm>" (func))"#),
        ),
        Case::new(
            &[60],
            "journal-that-is-a-module",
            rejected("wrong-type", "...: expected module found instance"),
            || {
                wasm(&format!(
                    r#"(component {TYPES}
                (import "wasmouse:robot/journal@VERSION" (core module))
                (instance $empty)
                (export "wasmouse:robot/controller@VERSION" (instance $empty)))"#
                ))
            },
        ),
    ]
}
