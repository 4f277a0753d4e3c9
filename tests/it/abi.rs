//! The page of the binary interface and the C header: they are what the generator writes, a robot
//! made from the tables of the page gets and does what they say, and the header compiles.

use std::fs;
use std::path::Path;
use std::process::Command;

use wasmouse_core::journal::{Entry, NoteOf};
use wasmouse_tests::{abi, bindings};

use crate::hostile::Engine;
use wasmouse_engine::Limits;

fn read(path: &str) -> String {
    let path = xtask::repository().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_header_and_the_page_are_those_of_the_wit() {
    let wit = read("wit/robot.wit");
    for (file, made) in [
        (abi::HEADER, abi::header(&wit)),
        (abi::PAGE, abi::page(&wit)),
    ] {
        assert!(
            made.expect("a valid WIT package") == read(file),
            "{file} is not what the generator writes: run `{}` and commit the result",
            bindings::COMMAND
        );
    }
}

#[test]
fn a_wit_that_is_not_known_is_an_error() {
    let wit = read("wit/robot.wit");
    for (from, to) in [
        ("seed: u64", "seed: f64"),
        ("seed: u64", "seed: list<u64>"),
        ("reset,", "reset(cell),"),
        ("interface controller", "interface others"),
    ] {
        let changed = wit.replacen(from, to, 1);
        assert_ne!(changed, wit, "{from}");
        assert!(abi::page(&changed).is_err(), "{to}");
        assert!(abi::header(&changed).is_err(), "{to}");
    }
}

/// The rows of the table under a heading of the page, without backquotes.
fn rows(page: &str, heading: &str, first: &str) -> Vec<Vec<String>> {
    let section = page.split("\n### ").find(|it| {
        it.starts_with(&format!("`{heading}`\n")) && it.contains(&format!("| {first} |"))
    });
    let section = section.unwrap_or_else(|| panic!("the page has no table of `{heading}`"));
    let lines = section.lines();
    let table = lines.skip_while(|line| !line.starts_with(&format!("| {first} |")));
    let table = table.skip(2).take_while(|line| line.starts_with('|'));
    let cells = |line: &str| {
        let cells = line.trim_matches('|').split(" | ");
        cells.map(|it| it.trim().replace('`', "")).collect()
    };
    table.map(cells).collect()
}

/// The number of a row's name.
fn number(rows: &[Vec<String>], name: &str, column: usize) -> u32 {
    let row = rows.iter().find(|row| row[column] == name);
    let row = row.unwrap_or_else(|| panic!("no row `{name}`"));
    row[0].parse().expect("a number")
}

#[test]
fn a_robot_made_from_the_page_gets_what_it_says() {
    let page = read(abi::PAGE);
    let start = rows(&page, "start", "parameter");
    let mut checks = String::new();
    for (name, value) in [
        ("dimension", 12),
        ("start.x", 0),
        ("start.y", 0),
        ("goal.origin.x", 5),
        ("goal.origin.y", 5),
        ("goal.width", 2),
        ("goal.height", 2),
        ("budget", 1000),
        (
            "budget-scope",
            number(&rows(&page, "budget-scope", "number"), "both-runs", 1),
        ),
        ("longest-move", 3),
        ("units-per-cell", 1),
        ("exploration-divisor", 30),
        ("seed", 0),
        ("variant", 0),
    ] {
        let index = number(&start, name, 2);
        let ty = &start[usize::try_from(index).expect("small")][1];
        checks.push_str(&format!(
            "(if ({ty}.ne (local.get {index}) ({ty}.const {value})) (then unreachable))\n"
        ));
    }
    assert_eq!(start.len(), 14, "all of them are checked");
    // The numbers of all enumerations, one entry in the journal for each.
    let mut calls = String::new();
    let mut expected = Vec::new();
    for (table, call) in [
        (
            "level",
            "(call $log (i32.const #) (i32.const 64) (i32.const 2))",
        ),
        (
            "color",
            "(call $paint (i32.const 1) (i32.const 2) (i32.const #))",
        ),
        (
            "heading",
            "(call $wall (i32.const 1) (i32.const 2) (i32.const #) (i32.const 0))",
        ),
        (
            "belief",
            "(call $wall (i32.const 1) (i32.const 2) (i32.const 0) (i32.const #))",
        ),
    ] {
        for row in rows(&page, table, "number") {
            calls.push_str(&call.replace('#', &row[0]));
            expected.push((table, row[1].clone()));
        }
    }
    let turns = rows(&page, "turn", "number");
    let action = rows(&page, "next-move", "offset");
    let at = |name: &str| number(&action, name, 2);
    let (case, turn, advance) = (at("case"), at("turn"), at("advance"));
    let straight = number(&turns, "straight", 1);
    assert!(action[0][4].starts_with("0 move: ") && action[0][4].contains(" 1 reset: "));
    // It drives 2 cells of 11, then asks for a reset, which is ignored, and panics.
    let signatures = |name: &str| {
        let parameters = rows(&page, name, "parameter");
        let types = parameters.iter().map(|row| row[1].as_str());
        types.collect::<Vec<_>>().join(" ")
    };
    let text = format!(
        r#"(module
        (import "journal" "log" (func $log (param {log})))
        (import "journal" "paint" (func $paint (param {paint})))
        (import "journal" "label" (func $label (param {label})))
        (import "journal" "wall" (func $wall (param {wall})))
        (import "journal" "panic" (func $panic (param {panic})))
        (memory (export "memory") 1)
        (data (i32.const 64) "hi")
        (global $step (mut i32) (i32.const 0))
        (func (export "start") (param {briefing}) {checks} {calls}
            (call $label (i32.const 3) (i32.const 4) (i32.const 64) (i32.const 2)))
        (func (export "next_move") (param $left i32) (param $front i32) (param $right i32)
            (result i32)
            (global.set $step (i32.add (global.get $step) (i32.const 1)))
            (if (i32.ne (local.get $front)
                    (select (i32.const 11) (i32.const 9) (i32.eq (global.get $step) (i32.const 1))))
                (then unreachable))
            (if (i32.eq (global.get $step) (i32.const 3))
                (then (call $panic (i32.const 64) (i32.const 2))))
            (i32.store8 (i32.add (i32.const 131) (i32.const {case}))
                (i32.eq (global.get $step) (i32.const 2)))
            (i32.store8 (i32.add (i32.const 131) (i32.const {turn})) (i32.const {straight}))
            (i32.store8 (i32.add (i32.const 131) (i32.const {advance})) (i32.const 2))
            (i32.const 131)))"#,
        log = signatures("log"),
        paint = signatures("paint"),
        label = signatures("label"),
        wall = signatures("wall"),
        panic = signatures("panic"),
        briefing = signatures("start"),
    );
    let played = Engine::new(Limits::default()).play(text.as_bytes());
    let fault = played.record.verdict.fault().expect("it panics");
    assert_eq!(
        (fault.kind.name(), fault.step),
        ("panic", 3),
        "{:?}",
        played.record.verdict
    );
    let entries: Vec<Entry<'_>> = played.recording.journal.entries().collect();
    assert_eq!(entries.len(), expected.len() + 1);
    for (entry, (table, name)) in entries.iter().zip(&expected) {
        let found = match (entry.note, *table) {
            (NoteOf::Log { level, text }, "level") if text == "hi" => format!("{level:?}"),
            (NoteOf::Paint { color, .. }, "color") => format!("{color:?}"),
            (NoteOf::Wall { side, .. }, "heading") => format!("{side:?}"),
            (NoteOf::Wall { belief, .. }, "belief") => format!("{belief:?}"),
            (note, table) => panic!("{note:?} for {table}"),
        };
        assert_eq!(found.to_lowercase(), *name, "{table}");
    }
    let last = entries.last().map(|it| format!("{:?}", it.note));
    let last = last.expect("a label");
    assert!(last.contains("Label") && last.contains("\"hi\""), "{last}");
}

/// The example of the page is one that plays.
#[test]
fn the_example_of_the_page_plays() {
    let page = read(abi::PAGE);
    let example = page
        .split("```wat\n")
        .nth(1)
        .and_then(|it| it.split("```").next());
    let example = example.expect("the page has an example");
    let played = Engine::new(Limits::default()).play(example.as_bytes());
    assert_eq!(played.record.verdict.fault(), None);
    assert_eq!(
        played.record.steps.total(),
        1000,
        "it follows the wall to the end"
    );
}

/// A robot in C, which is its own test where it is not WebAssembly.
const ROBOT: &str = r#"
#include "wasmouse.h"

static wm_briefing seen;
static void start(const wm_briefing *briefing) { seen = *briefing; }
static wm_action next_move(wm_sensors sensors) {
  if (sensors.left > 0) return wm_move(WM_TURN_LEFT, 1);
  if (sensors.front > 0) return wm_move(WM_TURN_STRAIGHT, 300);
  wm_log(WM_LEVEL_INFO, "dead end");
  return sensors.right > 0 ? wm_move(WM_TURN_RIGHT, -300) : wm_reset();
}
WM_ROBOT(start, next_move);

#ifndef __wasm__
static size_t logged;
void wm_journal_log(wm_level level, const char *message, size_t message_length) {
  logged += level == WM_LEVEL_INFO && message[0] == 'd' ? message_length : 1000;
}
int main(void) {
  const wm_action *action;
  wm_start(1, 2, 3, 4, 5, 6, 7, 8, WM_BUDGET_SCOPE_EACH_RUN, 10, 11, 12, 13, 14);
  if (seen.dimension != 1 || seen.start.x != 2 || seen.start.y != 3) return 1;
  if (seen.goal.origin.x != 4 || seen.goal.origin.y != 5 || seen.goal.width != 6) return 2;
  if (seen.goal.height != 7 || seen.budget != 8 || seen.budget_scope != 1) return 3;
  if (seen.longest_move != 10 || seen.units_per_cell != 11) return 4;
  if (seen.exploration_divisor != 12 || seen.seed != 13 || seen.variant != 14) return 5;
  action = wm_next_move(0, 1, 0);
  if (action->kind != 0 || action->turn != 1 || action->advance != 127) return 6;
  action = wm_next_move(0, 0, 1);
  if (action->kind != 0 || action->turn != 2 || action->advance != -128) return 7;
  action = wm_next_move(0, 0, 0);
  if (action->kind != 1 || logged != 16) return 8;
  return 0;
}
#endif
"#;

fn compiles(command: &mut Command) -> bool {
    match command.output() {
        Ok(output) => {
            let stderr = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{command:?}: {stderr}");
            true
        }
        Err(error) => {
            println!("skipped: {command:?}: {error}");
            false
        }
    }
}

#[test]
fn the_header_is_c_and_cpp() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let include = format!("-I{}", xtask::repository().join("wit").display());
    let strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];
    for (compiler, standard, name) in [
        ("cc", "-std=c11", "robot.c"),
        ("c++", "-std=c++17", "robot.cpp"),
    ] {
        let source = folder.path().join(name);
        fs::write(&source, ROBOT).expect("a file");
        let program = folder.path().join(compiler);
        let mut command = Command::new(compiler);
        command
            .arg(standard)
            .args(strict)
            .arg(&include)
            .arg("-o")
            .arg(&program)
            .arg(&source);
        if compiles(&mut command) {
            let status = Command::new(&program).status().expect("it starts");
            assert_eq!(status.code(), Some(0), "{standard}");
        }
    }
    wasm(folder.path(), &include);
}

/// The same robot in WebAssembly plays, where there is a compiler for it.
fn wasm(folder: &Path, include: &str) {
    let robot = folder.join("robot.wasm");
    let is_there = |name: &&str| {
        let version = Command::new(name).arg("--version").output();
        version.is_ok_and(|it| it.status.success())
    };
    let Some(compiler) = ["clang-22", "clang"].into_iter().find(is_there) else {
        println!("skipped: there is no clang");
        return;
    };
    let mut command = Command::new(compiler);
    command
        .args([
            "--target=wasm32",
            "-O2",
            "-nostdlib",
            "-Wl,--no-entry",
            include,
            "-o",
        ])
        .arg(&robot)
        .arg(folder.join("robot.c"));
    match command.output() {
        Ok(output) if output.status.success() => {}
        output => {
            println!("skipped: {compiler} does not build for WebAssembly: {output:?}");
            return;
        }
    }
    let played = Engine::new(Limits::default()).play(&fs::read(&robot).expect("a module"));
    assert_eq!(played.record.verdict.fault(), None);
}
