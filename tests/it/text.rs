//! WebAssembly text as a robot: `run`, `inspect`, `build`, folders and contests take it.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::binary::{Ran, ran, wasmouse};
use crate::contest_text::ContestText;

/// Follows the left wall, in plain names.
const LEFT: &str = r#";; follows the left wall
(module
  (import "journal" "paint" (func $paint (param i32 i32 i32)))
  (memory (export "memory") 1)
  (global $x (mut i32) (i32.const 0))
  (func (export "start") (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32)
    (global.set $x (local.get 1)))
  (func $turn (param $left i32) (param $front i32) (result i32)
    (if (local.get $left) (then (return (i32.const 0))))
    (select (i32.const 1) (i32.const 2) (local.get $front)))
  (func (export "next_move") (param $left i32) (param $front i32) (param $right i32)
    (result i32)
    (call $paint (global.get $x) (i32.const 0) (i32.const 1))
    (i32.store8 (i32.const 1) (call $turn (local.get $left) (local.get $front)))
    ;; in a dead end it turns on the spot
    (i32.store8 (i32.const 2)
      (i32.ne (i32.const 0)
        (i32.or (local.get $left) (i32.or (local.get $front) (local.get $right)))))
    (i32.const 0)))
"#;

/// Runs a command in a folder, and returns its exit code and both outputs.
fn run(folder: &Path, arguments: &str) -> (Option<i32>, String, String) {
    let mut command = wasmouse();
    command
        .args(arguments.split_whitespace())
        .current_dir(folder)
        .env("WASMOUSE_CACHE", folder.join("cache"));
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(&mut command);
    (status.code(), stdout, stderr)
}

#[test]
fn text_plays_as_what_is_built_from_it() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    fs::write(folder.join("left.wat"), LEFT).expect("a file");
    let (code, stdout, stderr) = run(folder, "build left.wat");
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stdout.starts_with("left.component.wasm\n"), "{stdout}");
    assert!(stdout.contains("wasmouse:robot/journal@"), "{stdout}");
    let play = |robot: &str, more: &str| {
        let line = format!("run bot={robot} gen:tree:12:1..=3 --json {more}");
        let (_, stdout, stderr) = run(folder, &line);
        let results: Value = serde_json::from_str(&stdout).expect(&stderr);
        let matches = results["matches"].as_array().expect("matches");
        let facts = matches.iter().map(|it| {
            let steps = it["verdict"].to_string();
            (steps, it["fuel"].to_string(), it["transcript"].to_string())
        });
        facts.collect::<Vec<_>>()
    };
    let of_text = play("left.wat", "");
    assert_eq!(of_text.len(), 3);
    assert_eq!(of_text, play("left.component.wasm", ""));
    assert_eq!(of_text, play("left.wat", "--trust"), "in this process");
}

#[test]
fn text_is_inspected_by_content() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    // The name of the file says nothing.
    for name in ["left.wat", "left.wasm", "left"] {
        fs::write(folder.join(name), LEFT).expect("a file");
        let (code, stdout, stderr) = run(folder, &format!("inspect {name}"));
        assert_eq!(code, Some(0), "{stdout}{stderr}");
        assert!(
            stdout.starts_with(&format!("`{name}` is admitted")),
            "{stdout}"
        );
        assert!(stdout.contains("kind      text, "), "{stdout}");
    }
    fs::write(
        folder.join("typo.wat"),
        LEFT.replace("i32.or", "i32.and_or"),
    )
    .expect("a file");
    let (code, stdout, _) = run(folder, "inspect typo.wat");
    assert_eq!(code, Some(4), "{stdout}");
    let reason = "malformed WebAssembly text: line 18, column 10: unknown operator or unexpected \
                  token, at `i32.and_or (local.get $left) (i32.and_or...`";
    assert!(stdout.contains(reason), "{stdout}");
}

#[test]
fn folders_and_contests_have_robots_in_text() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    fs::create_dir(folder.join("bots")).expect("a folder");
    fs::write(folder.join("bots/left.wat"), LEFT).expect("a file");
    fs::write(folder.join("bots/wrong.wat"), "(module").expect("a file");
    let (_, stdout, stderr) = run(folder, "run bots test_maze_01");
    assert!(stdout.contains("left "), "{stdout}{stderr}");
    assert!(
        stderr.contains("malformed WebAssembly text: line 1, column 8: expected `)`"),
        "{stdout}{stderr}"
    );
    ContestText::of(&[])
        .with("[[robots]]\npath = \"bots\"")
        .mazes("mazes", &["gen:tree:12:1"])
        .write(folder);
    let (_, stdout, stderr) = run(folder, "contest run contest.toml");
    assert!(stdout.contains("left"), "{stdout}{stderr}");
}

/// A fault of a robot in text has the line of the text.
#[test]
fn a_fault_names_the_line_of_the_text() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let failing = LEFT.replace("(call $paint", "(unreachable)\n(call $paint");
    fs::write(folder.join("failing.wat"), failing).expect("a file");
    let (_, stdout, stderr) = run(folder, "run failing.wat test_maze_01");
    assert!(stderr.contains("robot.wat:14:15"), "{stdout}{stderr}");
}
