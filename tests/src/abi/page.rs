//! [`page`]: the binary interface as a page.

use std::fmt::Write as _;

use super::model::{Abi, Field, FlatFunction, Interface, Kind, Named, Shape};
use crate::bindings::COMMAND;

/// The page that belongs to a WIT.
///
/// # Errors
///
/// When the WIT cannot be read, or has something in it that this does not know.
pub fn page(wit: &str) -> Result<String, String> {
    let abi = Abi::read(wit)?;
    let mut out = format!(
        "<!-- Generated from wit/robot.wit by `{COMMAND}`. Do not edit. -->\n{}",
        TOP.replace("{controller}", &abi.controller.name)
            .replace("{journal}", &abi.journal.name)
            .replace("{version}", &abi.version)
    );
    out.push_str("\n## Exports\n");
    functions(&mut out, &abi, &abi.controller);
    out.push_str(OTHER_EXPORTS);
    out.push_str("\n## Imports\n");
    out.push_str(IMPORTS);
    functions(&mut out, &abi, &abi.journal);
    out.push_str("\n## Numbers of the enumerations\n");
    for named in &abi.types {
        if let Kind::Enumeration(cases) = &named.kind {
            table(&mut out, named, cases);
        }
    }
    out.push_str(BOTTOM);
    Ok(out)
}

const TOP: &str = r#"# The binary interface of a robot

For robots that are written by hand, in WebAssembly text, or in a language without a bindings
generator. A robot is a core WebAssembly module with two functions and a memory; numbers are all
that crosses the boundary. For C and C++, [`wit/wasmouse.h`](../wit/wasmouse.h) is this page as a
header. [`wit/robot.wit`](../wit/robot.wit) says what everything means, and this page, which is
generated from it, what it is in bytes.

`wasmouse run robot.wasm` and `wasmouse run robot.wat` play a module as it is. This one follows
the wall on its left:

```wat
(module
  (memory (export "memory") 1)
  (func (export "start")
    (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32))
  (func (export "next_move") (param $left i32) (param $front i32) (param $right i32)
    (result i32)
    ;; byte 0: 0, a move. Byte 1: turn left, go straight, or turn right.
    (i32.store8 (i32.const 1)
      (if (result i32) (local.get $left)
        (then (i32.const 0))
        (else (select (i32.const 1) (i32.const 2) (local.get $front)))))
    ;; byte 2: drive 1 cell, or none in a dead end.
    (i32.store8 (i32.const 2)
      (i32.ne (i32.const 0)
        (i32.or (local.get $left) (i32.or (local.get $front) (local.get $right)))))
    (i32.const 0)))
```

## Names

A module uses plain names or full names, and not both:

| what | plain name | full name |
|---|---|---|
| export, called once before the first step | `start` | `{controller}#start` |
| export, called once in each step | `next_move` or `next-move` | `{controller}#next-move` |
| export, the memory | `memory` | `memory` |
| import, the module of the journal's functions | `journal` | `{journal}` |

Plain names mean the version of the host, {version} here. Full names say for which version a robot
was built, so that another host can say that it does not fit. The names that begin with `cm32p2`
are not read.
"#;

const OTHER_EXPORTS: &str = r"
### `_initialize`

Optional, without parameters and results. Called once, before `start`; what it uses counts against
the fuel limit of `start`, and is not reported.
";

const IMPORTS: &str = "
All are optional. None returns a value. A text is the address of its first byte and its number of
bytes; it is UTF-8, and need not end with a zero byte. A call costs 200 units of fuel, and 1 for
each byte of text.
";

const BOTTOM: &str = r"
## What is checked

- A signature that differs is rejected before the robot plays, with the name of the function.
- A number that is not in the tables above, and an address outside of memory, end the match with a
  fault. No address has to be aligned.
- Parameters are unsigned where the WIT says `u32` or `u64`.
- Each match has a fresh instance: memory and globals are as the module says.
- Proposals that are on: everything in WebAssembly 2.0, tail calls, extended constant expressions
  and several memories. A module that needs another one is rejected with its name and the reason.
- Text (`.wat`) has at most 4 MiB, and is recognised by how it begins: with `(` or `;;`.
";

/// A cell of a table: one line.
fn cell(text: &str) -> String {
    text.replace('\n', " ").replace('|', "\\|")
}

fn put(out: &mut String, line: &str) {
    writeln!(out, "{line}").expect("a string takes everything");
}

/// What the WIT calls a type.
fn wit_type(shape: &Shape) -> String {
    match shape {
        Shape::U32 => "u32".into(),
        Shape::U64 => "u64".into(),
        Shape::S8 => "s8".into(),
        Shape::Address | Shape::Length | Shape::String => "string".into(),
        Shape::Named(name) => name.clone(),
    }
}

fn functions(out: &mut String, abi: &Abi, interface: &Interface) {
    for function in &interface.functions {
        signature(out, function);
        put(out, "");
        put(out, "| parameter | type | name | in the WIT | meaning |");
        put(out, "|---|---|---|---|---|");
        let flat = function.parameters.iter().flat_map(|it| &it.flat);
        for (number, it) in flat.enumerate() {
            put(
                out,
                &format!(
                    "| {number} | `{}` | `{}` | `{}` | {} |",
                    it.core(),
                    it.dotted(),
                    wit_type(&it.ty),
                    cell(&it.docs)
                ),
            );
        }
        if let Some(name) = &function.result {
            result(out, abi.named(name));
        }
    }
}

fn signature(out: &mut String, function: &FlatFunction) {
    let flat = function.parameters.iter().flat_map(|it| &it.flat);
    let types: Vec<&str> = flat.map(|it| it.core()).collect();
    let result = match function.result {
        Some(_) => " (result i32)",
        None => "",
    };
    put(out, &format!("\n### `{}`\n", function.name));
    put(out, &format!("`(param {}){result}`", types.join(" ")));
    put(out, &format!("\n{}", function.docs));
}

/// The bytes of what a function returns the address of.
fn result(out: &mut String, named: &Named) {
    let Kind::Variant {
        cases,
        payload: (number, fields),
    } = &named.kind
    else {
        return;
    };
    put(
        out,
        &format!(
            "\nIt returns the address of {} bytes, which are read at once:\n",
            named.size
        ),
    );
    put(out, "| offset | size | name | in the WIT | meaning |");
    put(out, "|---|---|---|---|---|");
    let numbered = cases.iter().enumerate();
    let numbered = numbered.map(|(number, (case, docs))| format!("{number} `{case}`: {docs}"));
    let numbered = numbered.collect::<Vec<_>>().join(" ");
    let case = Field {
        name: "case".into(),
        docs: numbered,
        ty: Shape::Named(named.name.clone()),
        offset: 0,
        size: 1,
    };
    byte(out, &case, "");
    let only = format!("Only of `{}`. ", cases[*number].0);
    for field in fields {
        byte(out, field, &only);
    }
}

fn byte(out: &mut String, field: &Field, before: &str) {
    put(
        out,
        &format!(
            "| {} | {} | `{}` | `{}` | {} |",
            field.offset,
            field.size,
            field.name,
            wit_type(&field.ty),
            cell(&format!("{before}{}", field.docs))
        ),
    );
}

fn table(out: &mut String, named: &Named, cases: &[(String, String)]) {
    put(out, &format!("\n### `{}`\n\n{}\n", named.name, named.docs));
    put(out, "| number | name | meaning |");
    put(out, "|---|---|---|");
    for (number, (case, docs)) in cases.iter().enumerate() {
        put(out, &format!("| {number} | `{case}` | {} |", cell(docs)));
    }
}
