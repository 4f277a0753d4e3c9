//! The folders of `host/src` are a pipeline, and this holds them to it: imports
//! point left along `maze -> sim -> robot -> contest -> report`, with `cli` around
//! it, and only `cli` and `robot` reach outside the process.
//!
//! The check is textual ([`source`] finds the paths in a file): it sees what is
//! written, not what a macro makes. Test modules are left out.

mod source;

use std::fs;
use std::path::{Path, PathBuf};
use std::slice;

use source::Source;

/// The folders, each of which may import those before it.
const LAYERS: [&str; 6] = ["maze", "sim", "robot", "contest", "report", "cli"];

/// Layers without a way to files, the terminal, the environment or wasm.
const PURE: [&str; 4] = ["maze", "sim", "contest", "report"];

/// Macros that print.
const PRINTING: [&str; 5] = ["print", "println", "eprint", "eprintln", "dbg"];

/// Beginnings of paths that lead outside.
const OUTSIDE: [&[&str]; 14] = [
    &["std", "fs"],
    &["std", "env"],
    &["std", "net"],
    &["std", "process"],
    &["fs"],
    &["anstream"],
    &["clap"],
    &["crossterm"],
    &["etcetera"],
    &["indicatif"],
    &["tempfile"],
    &["wasmparser"],
    &["wasmtime"],
    &["wit_component"],
];

/// Names that lead outside wherever they stand in a path.
const STREAMS: [&str; 3] = ["stdin", "stdout", "stderr"];

/// What is wrong in the code of a module, which is named from the crate's root.
fn problems(module: &[&str], source: &Source) -> Vec<String> {
    let own = layer(module[0]).expect("a module in one of the folders");
    let mut problems = Vec::new();
    for path in &source.paths {
        let shown = path.join("::");
        match target(module, path).map(|name| (name, layer(name))) {
            Some((_, Some(other))) if other > own => {
                problems.push(format!("`{}` imports `{shown}`", LAYERS[own]));
            }
            Some((name, None)) => problems.push(format!("`{name}` of `{shown}` is no folder")),
            _ => {}
        }
        if PURE.contains(&module[0]) && leads_outside(path) {
            problems.push(format!("`{}` uses `{shown}`", LAYERS[own]));
        }
    }
    if PURE.contains(&module[0]) {
        let printing = source.macros.iter();
        let printing = printing.filter(|name| PRINTING.contains(&name.as_str()));
        problems.extend(printing.map(|name| format!("`{}` calls `{name}!`", LAYERS[own])));
    }
    problems
}

fn layer(name: &str) -> Option<usize> {
    LAYERS.iter().position(|layer| *layer == name)
}

/// The folder that a path leads to when it leaves its module: by `crate`, or by
/// `super` as often as it takes.
fn target<'a>(module: &[&str], path: &'a [String]) -> Option<&'a str> {
    let supers = path.iter().take_while(|name| *name == "super").count();
    let to_root = match path[0].as_str() {
        "crate" => 1,
        _ if supers > 0 && supers >= module.len() => supers,
        _ => return None,
    };
    path.get(to_root).map(String::as_str)
}

fn leads_outside(path: &[String]) -> bool {
    OUTSIDE.iter().any(|outside| {
        let beginning = path.iter().take(outside.len());
        beginning.map(String::as_str).eq(outside.iter().copied())
    }) || path.iter().any(|name| STREAMS.contains(&name.as_str()))
}

#[test]
fn imports_point_left_and_only_cli_and_robot_reach_outside() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../host/src");
    let mut files = Vec::new();
    for layer in LAYERS {
        find_files(&root.join(layer), &mut files);
    }
    assert!(files.len() > 50, "only {} files", files.len());
    let read: Vec<(Vec<String>, Source)> = files
        .iter()
        .map(|file| {
            let text = fs::read_to_string(file).expect("a source file");
            let place = file.strip_prefix(&root).expect("a file below the root");
            (module_path(place), Source::parse(&text))
        })
        .collect();
    let tests: Vec<Vec<String>> = read
        .iter()
        .flat_map(|(module, source)| {
            let names = source.test_modules.iter();
            names.map(|name| [&module[..], slice::from_ref(name)].concat())
        })
        .collect();

    let mut found = Vec::new();
    let mut crossings = 0;
    for (module, source) in &read {
        if tests.iter().any(|test| module.starts_with(test)) {
            continue;
        }
        let names: Vec<&str> = module.iter().map(String::as_str).collect();
        let leaving = source
            .paths
            .iter()
            .filter(|path| target(&names, path).is_some());
        crossings += leaving.count();
        let problems = problems(&names, source);
        found.extend(
            problems
                .iter()
                .map(|it| format!("{}: {it}", module.join("::"))),
        );
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(
        crossings > 100,
        "only {crossings} imports between folders were seen"
    );
}

fn find_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            find_files(&path, files);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
}

/// `maze/format/mod.rs` is `maze::format`, and `maze/cell.rs` is `maze::cell`.
fn module_path(place: &Path) -> Vec<String> {
    let mut names: Vec<String> = place
        .with_extension("")
        .iter()
        .map(|name| name.to_str().expect("names are text").to_owned())
        .collect();
    if names.last().is_some_and(|name| name == "mod") {
        names.pop();
    }
    names
}

#[track_caller]
fn check(module: &str, code: &str, expected: &[&str]) {
    let names: Vec<&str> = module.split("::").collect();
    let found = problems(&names, &Source::parse(code));
    assert_eq!(found, expected, "{module}: {code}");
}

#[test]
fn the_check_sees_imports_to_the_right() {
    check("sim", "use crate::maze::Cell;", &[]);
    check(
        "sim",
        "use crate::robot::Host;",
        &["`sim` imports `crate::robot::Host`"],
    );
    check(
        "robot::play",
        "use super::Host; use crate::sim::{Run, Score};",
        &[],
    );
    check(
        "maze::cell",
        "use crate::{maze::Maze, sim::{Run, Score}, report};",
        &[
            "`maze` imports `crate::sim::Run`",
            "`maze` imports `crate::sim::Score`",
            "`maze` imports `crate::report`",
        ],
    );
    check(
        "contest::run",
        "fn f() -> crate::report::Lines { crate :: cli :: run() }",
        &[
            "`contest` imports `crate::report::Lines`",
            "`contest` imports `crate::cli::run`",
        ],
    );
    check(
        "report",
        "pub(crate) use crate::contest::Mean as Average;",
        &[],
    );
    check("cli::run", "use crate::{contest::*, report::*};", &[]);
    check(
        "sim",
        "use crate::Secret;",
        &["`Secret` of `crate::Secret` is no folder"],
    );
}

#[test]
fn the_check_follows_super() {
    check(
        "maze::format::udacity",
        "use super::super::Maze; use super::edges;",
        &[],
    );
    check(
        "maze::format::udacity",
        "use super::super::super::sim::Run;",
        &["`maze` imports `super::super::super::sim::Run`"],
    );
    check(
        "maze",
        "use super::sim::Run;",
        &["`maze` imports `super::sim::Run`"],
    );
    check("sim::score", "use super::super::maze::Cell;", &[]);
}

#[test]
fn the_check_sees_what_leads_outside() {
    check("robot::cache", "use std::fs; fn f() { println!(); }", &[]);
    check("maze", "use std::fs;", &["`maze` uses `std::fs`"]);
    check(
        "report",
        "use std::{fmt, io::{self, stdout, Write}};",
        &["`report` uses `std::io::stdout`"],
    );
    check(
        "contest",
        "fn f() { io::stderr().flush() }",
        &["`contest` uses `io::stderr`"],
    );
    check(
        "sim",
        "fn f() { eprintln!(\"{}\", 1) }",
        &["`sim` calls `eprintln!`"],
    );
    check(
        "sim",
        "fn f() { std::println!() }",
        &["`sim` calls `println!`"],
    );
    check(
        "sim",
        "use wasmtime::Engine;",
        &["`sim` uses `wasmtime::Engine`"],
    );
    check(
        "maze",
        "fn f() { writeln!(text, \"\") } use std::fmt::Write;",
        &[],
    );
}

#[test]
fn the_check_leaves_out_what_is_no_code() {
    check(
        "maze",
        "// use crate::sim;\n/// [`crate::cli`]\n/* crate::sim /* x */ */",
        &[],
    );
    check(
        "maze",
        r##"const A: &str = "crate::sim"; const B: &str = r#"" crate::cli "#;"##,
        &[],
    );
    check(
        "maze",
        "const Q: char = '\"'; use crate::sim::A; // \"",
        &["`maze` imports `crate::sim::A`"],
    );
    check(
        "maze",
        "fn f<'a>(x: &'a str) { crate::sim::f('a') }",
        &["`maze` imports `crate::sim::f`"],
    );
    check(
        "maze",
        "#[cfg(test)]\nmod tests { use crate::cli; fn f() { dbg!({}) } }",
        &[],
    );
    check(
        "maze",
        "#[cfg(test)] #[track_caller] fn f() { println!() } use crate::cli::A;",
        &["`maze` imports `crate::cli::A`"],
    );
    let source = Source::parse("#[cfg(test)]\nmod testing;\nmod real;");
    assert_eq!(source.test_modules, ["testing"]);
}
