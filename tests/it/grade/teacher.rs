//! A teacher grades a folder of ten submissions with the commands of the README.

use std::fs;
use std::path::Path;

use super::{command, component, panicking, text, write};
use crate::binary::{Ran, ran, stdout_of, wasmouse};
use crate::hostile::{Module, wasm};

const README: &str = include_str!("../../../README.md");

/// The commands of the README's section about grading.
fn commands() -> Vec<&'static str> {
    let block = README
        .split("```sh grade\n")
        .nth(1)
        .expect("a block of commands");
    let block = block.split("```").next().expect("split yields one part");
    block.lines().filter(|it| !it.is_empty()).collect()
}

/// Ten submissions: five good ones, and five that are not.
fn submissions(folder: &Path) {
    for name in ["flood", "dfs", "champion", "rai"] {
        write(folder, &format!("{name}.wasm"), component(name));
    }
    let hostile = if cfg!(windows) {
        "hostile.wasm"
    } else {
        "::error::=1|<b>`.wasm"
    };
    write(folder, hostile, component("random"));
    write(folder, "ahead.wasm", Module::default().component());
    write(
        folder,
        "panics.wasm",
        panicking("\\1b[31m<b>|::error::x\\0d\\0a##[add-mask]y", 35),
    );
    let trapping = Module {
        next: "unreachable",
        ..Module::default()
    };
    write(folder, "traps.wasm", trapping.component());
    let wasi = r#"(component (import "wasi:cli/environment@0.2.0" (instance)))"#;
    write(folder, "wasi.wasm", wasm(wasi));
    write(folder, "text.wasm", "I am a robot\n");
}

#[test]
fn ten_submissions_are_graded_with_the_commands_of_the_readme() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    submissions(&folder.path().join("submissions"));
    let commands = commands();
    assert!((2..=4).contains(&commands.len()), "{commands:?}");
    for line in commands {
        let arguments = line.strip_prefix("wasmouse ").expect("a call of wasmouse");
        let Ran {
            status,
            stderr,
            stdout,
        } = ran(&mut command(folder.path(), arguments));
        // Some of the robots do not pass, and were rejected or faulted.
        let expected = if arguments.contains("submissions") {
            4
        } else {
            0
        };
        assert_eq!(status.code(), Some(expected), "{line}: {stderr}\n{stdout}");
        let is_command = |it: &str| it.trim_start().starts_with("::") || it.contains("##[");
        assert!(
            !stdout.lines().chain(stderr.lines()).any(is_command),
            "{stdout}{stderr}"
        );
    }
    let grades = folder.path().join("grades");
    let summary = text(&grades.join("summary.csv"));
    let lines: Vec<&str> = summary.lines().collect();
    assert_eq!(lines.len(), 11, "{summary}");
    let result = |robot: &str| {
        let line = lines.iter().find(|it| it.starts_with(&format!("{robot},")));
        let line = line.unwrap_or_else(|| panic!("{robot}: {summary}"));
        line.split(',')
            .nth(1)
            .expect("a second field")
            .trim_matches('"')
    };
    for (robot, expected) in [
        ("flood", "passed"),
        ("champion", "passed"),
        ("ahead", "below the mark"),
        ("panics", "below the mark"),
        ("traps", "below the mark"),
        ("wasi", "rejected"),
        ("text", "rejected"),
    ] {
        assert_eq!(result(robot), expected, "{robot}");
    }
    let folders = fs::read_dir(&grades).expect("a folder").filter(|entry| {
        let path = entry.as_ref().expect("an entry").path();
        path.is_dir()
    });
    assert_eq!(folders.count(), 10);
    for name in [
        "grade.json",
        "junit.xml",
        "grade.md",
        "grade.tap",
        "results.json",
    ] {
        assert!(grades.join("text").join(name).is_file(), "{name}");
    }
}

const GRADING: &str = include_str!("../../../docs/GRADING.md");

#[test]
fn the_rubric_of_the_documentation_can_be_used() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let rubric = GRADING.split("```toml\n").nth(1).expect("a rubric");
    let rubric = rubric.split("```").next().expect("split yields one part");
    write(folder.path(), "rubric.toml", rubric);
    let line = "grade rubric.toml flood --json grade.json";
    let Ran { status, stderr, .. } = ran(&mut command(folder.path(), line));
    assert_eq!(status.code(), Some(0), "{stderr}");
}

/// Every key of the schema is in the documentation, and every file that it names is there.
#[test]
fn the_documentation_has_every_key() {
    let schema = include_str!("../../../host/schema/rubric.schema.json");
    let schema: serde_json::Value = serde_json::from_str(schema).expect("a schema");
    for pointer in [
        "/properties",
        "/$defs/mazes/properties",
        "/$defs/criterion/properties",
    ] {
        let keys = schema
            .pointer(pointer)
            .and_then(serde_json::Value::as_object);
        for key in keys.expect("an object").keys() {
            let is_there = GRADING.contains(&format!("`{key}`"))
                || GRADING.contains(&format!("`[{key}]`"))
                || GRADING.contains(&format!("`[[{key}]]`"));
            assert!(is_there, "{key}");
        }
    }
    let help = stdout_of(wasmouse().args(["grade", "--help"]));
    let options = GRADING.lines().filter_map(|it| it.strip_prefix("| `--"));
    for option in options {
        let option = option.split(['`', ' ']).next().expect("a name");
        assert!(help.contains(&format!("--{option}")), "{option}");
    }
}
