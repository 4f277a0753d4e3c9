//! [`header`]: the binary interface for C and C++.

use std::fmt::Write as _;

use super::model::{Abi, Field, FlatFunction, Kind, Named, Shape};
use crate::bindings::COMMAND;

/// The longest line of a comment, in bytes.
const WIDTH: usize = 80;

/// The C header that belongs to a WIT.
///
/// # Errors
///
/// When the WIT cannot be read, or has something in it that this does not know.
pub fn header(wit: &str) -> Result<String, String> {
    let abi = Abi::read(wit)?;
    let mut out = format!(
        "/* Generated from wit/robot.wit (wasmouse:robot@{version}) by `{COMMAND}`. Do not edit.\n{PREAMBLE}",
        version = abi.version,
    );
    out.push_str(ATTRIBUTES);
    // What is a part of another type alone has no type of its own in C.
    let inlined = abi.types.iter().filter_map(|it| match &it.kind {
        Kind::Variant { cases, payload } => Some(cases[payload.0].0.as_str()),
        _ => None,
    });
    let inlined: Vec<&str> = inlined.collect();
    for named in abi
        .types
        .iter()
        .filter(|it| !inlined.contains(&it.name.as_str()))
    {
        declare(&mut out, &abi, named);
    }
    out.push_str("\n/* ---- What a robot exports ---- */\n");
    for function in &abi.controller.functions {
        let module = &abi.controller.name;
        let attribute = format!("WM_EXPORT(\"{module}#{}\")", function.name);
        raw(&mut out, function, &attribute, "wm_");
    }
    robot(&mut out, &abi)?;
    out.push_str("\n/* ---- What a robot may import ---- */\n");
    for function in &abi.journal.functions {
        let module = &abi.journal.name;
        let attribute = format!("WM_IMPORT(\"{module}\", \"{}\")", function.name);
        raw(&mut out, function, &attribute, "wm_journal_");
    }
    out.push_str(LENGTH);
    for function in &abi.journal.functions {
        friendly(&mut out, function);
    }
    out.push_str("\n#ifdef __cplusplus\n} /* extern \"C\" */\n#endif\n\n#endif /* WASMOUSE_H */\n");
    Ok(out)
}

const PREAMBLE: &str = r#" *
 * The interface of a robot in C (C11) or C++ (C++17). It needs no library.
 *
 *     #include "wasmouse.h"
 *
 *     static void start(const wm_briefing *briefing) {
 *       (void)briefing;
 *     }
 *
 *     static wm_action next_move(wm_sensors sensors) {
 *       if (sensors.left > 0) return wm_move(WM_TURN_LEFT, 1);
 *       if (sensors.front > 0) return wm_move(WM_TURN_STRAIGHT, 1);
 *       return wm_move(WM_TURN_RIGHT, sensors.right > 0 ? 1 : 0);
 *     }
 *
 *     WM_ROBOT(start, next_move);
 *
 * Build it with one of
 *
 *     clang --target=wasm32 -O2 -nostdlib -Wl,--no-entry -o robot.wasm robot.c
 *     zig cc --target=wasm32-freestanding -O2 -nostdlib -Wl,--no-entry -o robot.wasm robot.c
 *
 * and play it with `wasmouse run robot.wasm`.
 *
 * Without WebAssembly (`__wasm__` is not defined) the attributes for imports and
 * exports are left out: a unit test of the robot calls `start` and `next_move`, or
 * `wm_start` and `wm_next_move`, and defines those `wm_journal_...` functions that
 * the robot calls. docs/ABI.md has the same interface without C.
 */
#ifndef WASMOUSE_H
#define WASMOUSE_H

#include <stddef.h>
#include <stdint.h>
"#;

const ATTRIBUTES: &str = r#"
#ifdef __wasm__
#define WM_EXPORT(name) __attribute__((export_name(name)))
#define WM_IMPORT(module, name) __attribute__((import_module(module), import_name(name)))
#else
#define WM_EXPORT(name)
#define WM_IMPORT(module, name)
#endif

#if defined(__GNUC__)
#define WM_NORETURN __attribute__((noreturn))
#else
#define WM_NORETURN
#endif

#ifdef __cplusplus
#define WM_STATIC_ASSERT(condition) static_assert(condition, #condition)
extern "C" {
#else
#define WM_STATIC_ASSERT(condition) _Static_assert(condition, #condition)
#endif

/* ---- Types ---- */
"#;

const LENGTH: &str = r"
/* ---- The same with C's types ---- */

/** Length of a text that ends with a zero byte. Unit: bytes. */
static inline size_t wm_length(const char *text) {
  size_t length = 0;
  while (text[length] != '\0') {
    length++;
  }
  return length;
}
";

/// A name in C.
fn lower(name: &str) -> String {
    name.replace('-', "_")
}

fn upper(name: &str) -> String {
    lower(name).to_uppercase()
}

/// A comment for documentation tools, indented.
fn comment(out: &mut String, indent: &str, docs: &str) {
    let lines = wrapped(docs, WIDTH - indent.len() - 3);
    match lines.as_slice() {
        [] => {}
        [line] if line.len() + indent.len() + 7 <= WIDTH => {
            put(out, &format!("{indent}/** {line} */"));
        }
        lines => {
            put(out, &format!("{indent}/**"));
            for line in lines {
                put(out, format!("{indent} * {line}").trim_end());
            }
            put(out, &format!("{indent} */"));
        }
    }
}

fn put(out: &mut String, line: &str) {
    writeln!(out, "{line}").expect("a string takes everything");
}

/// Paragraphs in lines of that width; an empty line is between two. Lines that begin with `@`
/// begin a paragraph.
fn wrapped(docs: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut is_open = false;
    for line in docs.lines() {
        if line.trim().is_empty() {
            lines.push(String::new());
            is_open = false;
            continue;
        }
        let is_parameter = line.starts_with('@');
        for (number, word) in line.split_whitespace().enumerate() {
            let continues = is_open && !(is_parameter && number == 0);
            match lines.last_mut() {
                Some(last) if continues && last.len() + 1 + word.len() <= width => {
                    last.push(' ');
                    last.push_str(word);
                }
                _ if continues && docs.contains('@') && is_parameter => {
                    lines.push(format!("  {word}"));
                }
                _ => lines.push(word.to_owned()),
            }
            is_open = true;
        }
    }
    lines
}

/// The type of a number in C, as a parameter.
fn parameter_type(shape: &Shape) -> String {
    match shape {
        Shape::U32 => "uint32_t".into(),
        Shape::U64 => "uint64_t".into(),
        Shape::S8 => "int8_t".into(),
        Shape::Address | Shape::String => "const char *".into(),
        Shape::Length => "size_t".into(),
        Shape::Named(name) => format!("wm_{}", lower(name)),
    }
}

/// The type in memory, where an enumeration is one byte.
fn field_type(abi: &Abi, shape: &Shape) -> String {
    match shape {
        Shape::Named(name) if matches!(abi.named(name).kind, Kind::Enumeration(_)) => {
            "uint8_t".into()
        }
        other => parameter_type(other),
    }
}

/// `type name`, with the star of a pointer at the name.
fn declared(ty: &str, name: &str) -> String {
    if ty.ends_with('*') {
        format!("{ty}{name}")
    } else {
        format!("{ty} {name}")
    }
}

fn declare(out: &mut String, abi: &Abi, named: &Named) {
    let name = lower(&named.name);
    out.push('\n');
    comment(out, "", &named.docs);
    match &named.kind {
        Kind::Enumeration(cases) => enumeration(out, &name, cases),
        Kind::Record(fields) => {
            put(out, &format!("typedef struct wm_{name} {{"));
            members(out, abi, fields);
            put(out, &format!("}} wm_{name};"));
            layout(out, &name, named, fields);
        }
        Kind::Variant {
            cases,
            payload: (number, fields),
        } => {
            put(out, &format!("typedef struct wm_{name} {{"));
            let (case, _) = &cases[*number];
            let docs = format!("Which: a `WM_{}_...`.", upper(&name));
            comment(out, "  ", &docs);
            put(out, "  uint8_t kind;");
            let of_case = |docs: &str| {
                format!(
                    "{docs} Only where `kind` is `WM_{}_{}`.",
                    upper(&name),
                    upper(case)
                )
            };
            for field in fields {
                comment(out, "  ", &of_case(&field.docs));
                member(out, abi, field);
            }
            put(out, &format!("}} wm_{name};"));
            layout(out, &name, named, fields);
            out.push('\n');
            comment(out, "", &format!("The values of `kind` of a `wm_{name}`."));
            enumeration(out, &format!("{name}_kind"), cases);
            for (number_of, (case, docs)) in cases.iter().enumerate() {
                let fields = if number_of == *number {
                    fields.as_slice()
                } else {
                    &[]
                };
                constructor(out, abi, &name, case, docs, fields);
            }
        }
    }
}

fn enumeration(out: &mut String, name: &str, cases: &[(String, String)]) {
    let prefix = upper(name.strip_suffix("_kind").unwrap_or(name));
    put(out, &format!("typedef enum wm_{name} {{"));
    for (number, (case, docs)) in cases.iter().enumerate() {
        comment(out, "  ", docs);
        put(out, &format!("  WM_{prefix}_{} = {number},", upper(case)));
    }
    put(out, &format!("}} wm_{name};"));
}

fn members(out: &mut String, abi: &Abi, fields: &[Field]) {
    for field in fields {
        let mut docs = field.docs.clone();
        if let Some(name) = enumeration_of(abi, &field.ty) {
            write!(docs, " A `WM_{}_...`.", upper(name)).expect("a string takes everything");
        }
        comment(out, "  ", &docs);
        member(out, abi, field);
    }
}

fn member(out: &mut String, abi: &Abi, field: &Field) {
    let ty = field_type(abi, &field.ty);
    put(out, &format!("  {};", declared(&ty, &lower(&field.name))));
}

/// The name of the enumeration that a type is.
fn enumeration_of<'a>(abi: &Abi, shape: &'a Shape) -> Option<&'a str> {
    match shape {
        Shape::Named(name) if matches!(abi.named(name).kind, Kind::Enumeration(_)) => Some(name),
        _ => None,
    }
}

/// What the canonical ABI says about the type in memory, as assertions.
fn layout(out: &mut String, name: &str, named: &Named, fields: &[Field]) {
    put(
        out,
        &format!("WM_STATIC_ASSERT(sizeof(wm_{name}) == {});", named.size),
    );
    for field in fields {
        put(
            out,
            &format!(
                "WM_STATIC_ASSERT(offsetof(wm_{name}, {}) == {});",
                lower(&field.name),
                field.offset
            ),
        );
    }
}

/// A function that makes a value of one case.
fn constructor(out: &mut String, abi: &Abi, name: &str, case: &str, docs: &str, fields: &[Field]) {
    out.push('\n');
    let is_small = |field: &Field| field.ty == Shape::S8;
    let mut docs = docs.to_owned();
    for field in fields.iter().filter(|it| is_small(it)) {
        write!(
            docs,
            " `{}` is limited to -128 ..= 127, which is what fits.",
            lower(&field.name)
        )
        .expect("a string takes everything");
    }
    comment(out, "", &docs);
    let parameters = fields.iter().map(|it| {
        let ty = match it.ty {
            Shape::S8 => "int".to_owned(),
            ref other => parameter_type(other),
        };
        declared(&ty, &lower(&it.name))
    });
    let parameters = or_void(parameters.collect());
    put(
        out,
        &format!(
            "static inline wm_{name} wm_{}({parameters}) {{",
            lower(case)
        ),
    );
    put(out, &format!("  wm_{name} value;"));
    put(
        out,
        &format!("  value.kind = WM_{}_{};", upper(name), upper(case)),
    );
    let all = match &abi.named(name).kind {
        Kind::Variant { payload, .. } => payload.1.as_slice(),
        _ => &[],
    };
    for field in all {
        let (ty, member) = (field_type(abi, &field.ty), lower(&field.name));
        if !fields.iter().any(|it| it.name == field.name) {
            put(out, &format!("  value.{member} = 0;"));
        } else if is_small(field) {
            let limited = format!("{member} < -128 ? -128 : {member} > 127 ? 127 : {member}");
            put(out, &format!("  value.{member} = (int8_t)({limited});"));
        } else {
            put(out, &format!("  value.{member} = ({ty}){member};"));
        }
    }
    put(out, "  return value;\n}");
}

fn or_void(parameters: Vec<String>) -> String {
    if parameters.is_empty() {
        "void".into()
    } else {
        parameters.join(", ")
    }
}

/// The numbers of a function as parameters in C.
fn flat_parameters(function: &FlatFunction) -> Vec<String> {
    let flat = function.parameters.iter().flat_map(|it| &it.flat);
    flat.map(|it| declared(&parameter_type(&it.ty), &lower(&it.path.join("_"))))
        .collect()
}

fn result_type(function: &FlatFunction) -> String {
    match &function.result {
        Some(name) => format!("const wm_{} *", lower(name)),
        None => "void".into(),
    }
}

/// The function as a core module has it.
fn raw(out: &mut String, function: &FlatFunction, attribute: &str, prefix: &str) {
    let mut docs = function.docs.clone();
    docs.push('\n');
    for flat in function.parameters.iter().flat_map(|it| &it.flat) {
        let name = lower(&flat.path.join("_"));
        let text = flat.docs.replace('\n', " ");
        write!(docs, "\n@param {name} {text}").expect("a string takes everything");
    }
    if let Some(name) = &function.result {
        write!(
            docs,
            "\n@return The address of a `wm_{}`, read at once.",
            lower(name)
        )
        .expect("a string takes everything");
    }
    out.push('\n');
    comment(out, "", &docs);
    put(out, attribute);
    if never_returns(function) {
        put(out, "WM_NORETURN");
    }
    let name = format!("{prefix}{}", lower(&function.name));
    let parameters = or_void(flat_parameters(function)).replace(", ", ",\n    ");
    let ty = result_type(function);
    put(out, &format!("{}({parameters});", declared(&ty, &name)));
}

fn never_returns(function: &FlatFunction) -> bool {
    function.docs.contains("Does not return.")
}

/// A macro that makes the exports of two functions with C's types.
fn robot(out: &mut String, abi: &Abi) -> Result<(), String> {
    let [start, next_move] = abi.controller.functions.as_slice() else {
        return Err("the controller has other functions".into());
    };
    let mut lines = vec!["#define WM_ROBOT(on_start, on_move)".to_owned()];
    for (function, name, way) in [(start, "on_start", "&"), (next_move, "on_move", "")] {
        let [parameter] = function.parameters.as_slice() else {
            return Err(format!("`{}` has other parameters", function.name));
        };
        let Shape::Named(ty) = &parameter.ty else {
            return Err(format!("`{}` takes no record", function.name));
        };
        let result = result_type(function);
        lines.push(format!(
            "  {}({}) {{",
            declared(&result, &format!("wm_{}", lower(&function.name))),
            flat_parameters(function).join(",\n      ")
        ));
        let variable = lower(&parameter.name);
        lines.push(format!("    wm_{} {variable};", lower(ty)));
        let by_value = |it: &super::model::Flat| {
            let member = lower(&it.dotted());
            let value = lower(&it.path.join("_"));
            let value = match enumeration_of(abi, &it.ty) {
                Some(_) => format!("(uint8_t){value}"),
                None => value,
            };
            format!("    {variable}.{member} = {value};")
        };
        lines.extend(parameter.flat.iter().map(by_value));
        let call = format!("{name}({way}{variable})");
        if let Some(result) = &function.result {
            lines.push(format!("    static wm_{} value;", lower(result)));
            lines.push(format!("    value = {call};"));
            lines.push("    return &value;".into());
        } else {
            lines.push(format!("    {call};"));
        }
        lines.push("  }".into());
    }
    lines.push("  WM_STATIC_ASSERT(1)".into());
    out.push('\n');
    comment(
        out,
        "",
        "Makes a robot of two functions, `void on_start(const wm_briefing *)` and `wm_action \
         on_move(wm_sensors)`. They are called as `wm_start` and `wm_next_move` are.",
    );
    let lines: Vec<String> = lines.join("\n").lines().map(str::to_owned).collect();
    let width = lines.iter().map(String::len).max().unwrap_or(0) + 1;
    for (number, line) in lines.iter().enumerate() {
        let is_last = number + 1 == lines.len();
        let line = if is_last {
            line.clone()
        } else {
            format!("{line:width$}\\")
        };
        put(out, &line);
    }
    Ok(())
}

/// The function with C's types: records and texts that end with a zero byte.
fn friendly(out: &mut String, function: &FlatFunction) {
    out.push('\n');
    comment(
        out,
        "",
        &format!(
            "{}{}",
            function.docs,
            match function.parameters.iter().find(|it| it.ty == Shape::String) {
                Some(it) => format!(" `{}` ends with a zero byte.", lower(&it.name)),
                None => String::new(),
            }
        ),
    );
    if never_returns(function) {
        put(out, "WM_NORETURN");
    }
    let parameters = function
        .parameters
        .iter()
        .map(|it| declared(&parameter_type(&it.ty), &lower(&it.name)));
    let name = lower(&function.name);
    let parameters = or_void(parameters.collect());
    put(
        out,
        &format!("static inline void wm_{name}({parameters}) {{"),
    );
    let arguments = function.parameters.iter().flat_map(|parameter| {
        parameter.flat.iter().map(|flat| match flat.ty {
            Shape::Length => format!("wm_length({})", lower(&parameter.name)),
            _ => lower(&flat.dotted()),
        })
    });
    let arguments: Vec<String> = arguments.collect();
    put(
        out,
        &format!("  wm_journal_{name}({});\n}}", arguments.join(", ")),
    );
}
