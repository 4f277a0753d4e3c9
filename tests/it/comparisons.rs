//! `compare` and `study`: their documents against the JSON Schemas, and the figures of the
//! reference page.

use std::process::Command;

use serde_json::Value;

use crate::binary::{Ran, ran, wasmouse};
use crate::pointers::objects;

const COMPARISON: &str = include_str!("../../host/schema/comparison.schema.json");
const STUDY: &str = include_str!("../../host/schema/study.schema.json");

/// The page that `cargo xtask reference` writes, with another program.
const REFERENCE: &str = include_str!("../../docs/REFERENCE.md");

fn output(arguments: &str) -> String {
    let mut command: Command = wasmouse();
    command.args(arguments.split_whitespace()).arg("--no-cache");
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(&mut command);
    assert!(status.success(), "{arguments}: {stderr}");
    stdout
}

/// Checks that the document is valid, and that none is that lacks a field or has another one.
#[track_caller]
fn check(schema: &str, arguments: &str) {
    let schema: Value = serde_json::from_str(schema).expect("the schema is JSON");
    jsonschema::draft202012::meta::validate(&schema).expect("the schema is a schema");
    let validator = jsonschema::draft202012::new(&schema).expect("the schema can be used");
    let document: Value = serde_json::from_str(&output(arguments)).expect("the output is JSON");
    if let Err(error) = validator.validate(&document) {
        panic!("{arguments}: {} at {}", error, error.instance_path());
    }
    let mut changed = 0;
    for pointer in objects(&document) {
        let fields = document.pointer(&pointer).and_then(Value::as_object);
        for field in fields.expect("an object").keys() {
            let mut other = document.clone();
            let object = other.pointer_mut(&pointer).and_then(Value::as_object_mut);
            let value = object.expect("an object").remove(field);
            let is_optional = field == "histogram";
            assert_eq!(
                validator.is_valid(&other),
                is_optional,
                "{pointer} without {field}"
            );
            let object = other.pointer_mut(&pointer).and_then(Value::as_object_mut);
            let object = object.expect("an object");
            object.insert(format!("{field}_"), value.unwrap_or_default());
            assert!(!validator.is_valid(&other), "{pointer} with {field}_");
            changed += 1;
        }
    }
    assert!(changed > 30, "only {changed} fields");
}

#[test]
fn documents_are_valid() {
    let mazes = "--mazes gen:tree:12:1..=3 gen:tree:14:1 --json";
    check(COMPARISON, &format!("compare flood dfs {mazes}"));
    // One maze has no interval.
    check(
        COMPARISON,
        "compare flood dfs random --mazes test_maze_01 --json",
    );
    check(STUDY, &format!("study flood random {mazes}"));
}

/// The study of 500 mazes has the figures of the reference page.
#[test]
fn the_study_agrees_with_the_reference_page() {
    let row = |title: &str, after: &str| {
        let (_, page) = REFERENCE.split_once(after).expect("the page has that part");
        let row = page
            .lines()
            .find(|line| line.starts_with(&format!("| {title} |")));
        let cells: Vec<&str> = row.expect("a row").split('|').map(str::trim).collect();
        cells[3].to_owned()
    };
    let part = "### Minnett's generated mazes";
    let beaten = row("of these, beats the lower benchmark", part);
    let lower = row("mean margin", part);
    let upper = row("mean margin to the upper benchmark", part);
    let beaten = beaten.replace(" of 500", "");
    let study = output("study minnett:final --ascii");
    let expected = format!(
        "minnett:final: finished 500 of 500 matches\n  \
         beats the lower benchmark in {beaten}, mean margin {lower}\n  "
    );
    assert!(study.starts_with(&expected), "{expected}\n{study}");
    let summary = study
        .lines()
        .nth(2)
        .expect("a line for the upper benchmark");
    assert!(
        summary.ends_with(&format!("mean margin {upper}")),
        "{summary}"
    );
}
