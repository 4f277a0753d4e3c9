//! Every format, checked by something that we did not write where there is such a thing, with
//! robots that try to break it.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use jsonschema::Validator as JsonValidator;
use serde_json::{Value, json};
use tempfile::TempDir;
use xtask::repository;
use xtask::validators::Validator;

use super::{command, component, folder, json, panicking, text, write};
use crate::binary::{Ran, ran};

/// Robots that pass, fault and are rejected, with names and messages that are markup, commands
/// and control characters.
fn robots(folder: &Path) -> Vec<&'static str> {
    let names = if cfg!(windows) {
        ["flood.wasm", "panics.wasm", "text.wasm"]
    } else {
        [
            "flood.wasm",
            "::error::%0A#|*`<b>.wasm",
            "=1+1,\"q\"\\x.wasm",
        ]
    };
    write(folder, names[0], component("flood"));
    let message = "\\1b[31m\\00<b>&amp;]]>|`*\\0d\\0a::error::x %0A ##[add-mask]y # SKIP \\5c \\22 \
                   \\ef\\bf\\be @me";
    write(folder, names[1], panicking(message, 65));
    write(folder, names[2], "no robot");
    names.to_vec()
}

/// Everything that is written for those robots.
fn graded() -> TempDir {
    let folder = folder();
    let names = robots(folder.path());
    let mut command = command(
        folder.path(),
        "grade rubric.toml --output-dir grades --annotations",
    );
    command.arg("--csv").arg("grades.csv").args(names);
    // What the runner of Classroom 50 sets.
    for (name, value) in CLASSROOM {
        command.env(name, value);
    }
    let summary = folder.path().join("step.md");
    fs::write(&summary, "before\n").expect("a file");
    command
        .arg("--step-summary")
        .env("GITHUB_STEP_SUMMARY", &summary);
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(&mut command);
    assert_eq!(status.code(), Some(4), "{stderr}");
    fs::write(folder.path().join("stdout"), stdout).expect("a file");
    folder
}

const CLASSROOM: [(&str, &str); 6] = [
    ("CLASSROOM", "cs101"),
    ("ASSIGNMENT", "mouse"),
    ("OWNER", "ann"),
    ("SUBMISSION_TAG", "submit/2026-09-01T10-00-00Z-abc1234"),
    ("COMMIT_URL", "https://example.com/commit/abc1234"),
    ("RELEASE_URL", "https://example.com/releases/1"),
];

/// The folders of the robots.
fn folders(grades: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(grades).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let folders: Vec<PathBuf> = paths.filter(|it| it.is_dir()).collect();
    assert_eq!(folders.len(), 3);
    folders
}

#[track_caller]
fn check_schema(schema: &str, value: &Value) {
    let schema: Value = serde_json::from_str(schema).expect("a schema");
    let validator = JsonValidator::new(&schema).expect("a schema");
    let errors = validator.iter_errors(value);
    let errors: Vec<String> = errors
        .map(|it| format!("{}: {it}", it.instance_path()))
        .collect();
    assert!(errors.is_empty(), "{errors:#?}\n{value:#}");
}

const GRADE_SCHEMA: &str = include_str!("../../../host/schema/grade.schema.json");
const RUBRIC_SCHEMA: &str = include_str!("../../../host/schema/rubric.schema.json");

#[test]
fn json_is_what_its_schema_says() {
    let folder = graded();
    let grades = folder.path().join("grades");
    let document = json(&grades.join("grade.json"));
    check_schema(GRADE_SCHEMA, &document);
    assert_eq!(document["robots"].as_array().map(Vec::len), Some(3));
    for robot in folders(&grades) {
        let own = json(&robot.join("grade.json"));
        check_schema(GRADE_SCHEMA, &own);
        assert_eq!(own["robots"].as_array().map(Vec::len), Some(1));
    }
    // Every field is required, and none is added.
    let schema: Value = serde_json::from_str(GRADE_SCHEMA).expect("a schema");
    let validator = JsonValidator::new(&schema).expect("a schema");
    for pointer in [
        "",
        "/rubric",
        "/rubric/criteria/0",
        "/robots/0",
        "/robots/0/criteria/0",
    ] {
        let fields = document
            .pointer(pointer)
            .and_then(Value::as_object)
            .expect("an object");
        for name in fields.keys() {
            let mut changed = document.clone();
            let object = changed.pointer_mut(pointer).and_then(Value::as_object_mut);
            object.expect("an object").remove(name);
            assert!(!validator.is_valid(&changed), "{pointer} without {name}");
        }
        let mut changed = document.clone();
        changed.pointer_mut(pointer).expect("an object")["added"] = Value::Null;
        assert!(!validator.is_valid(&changed), "{pointer}: added");
    }
}

#[test]
fn rubrics_are_what_their_schema_says() {
    let template = include_str!("../../../host/templates/grade/rubric.toml");
    for text in [template, super::RUBRIC] {
        let value: toml::Value = toml::from_str(text).expect("TOML");
        let value = serde_json::to_value(value).expect("JSON");
        check_schema(RUBRIC_SCHEMA, &value);
    }
    let schema: Value = serde_json::from_str(RUBRIC_SCHEMA).expect("a schema");
    let validator = JsonValidator::new(&schema).expect("a schema");
    let mut refused = 0;
    for (name, text) in super::bad_rubrics::RUBRICS {
        let Ok(value) = toml::from_str::<toml::Value>(text) else {
            continue;
        };
        let value = serde_json::to_value(value).expect("JSON");
        refused += usize::from(!validator.is_valid(&value));
        if name.starts_with("unknown key") || name.starts_with("no ") {
            assert!(!validator.is_valid(&value), "{name}");
        }
    }
    // The others are wrong in what they name, or between values.
    assert!(refused >= 20, "{refused}");
}

#[test]
fn junit_xml_is_valid_for_jenkins() {
    let Some(program) = Validator::XmlSchema.find(&repository(), "junit_xml_is_valid_for_jenkins")
    else {
        return;
    };
    let folder = graded();
    let grades = folder.path().join("grades");
    let mut files = vec![grades.join("junit.xml")];
    files.extend(folders(&grades).iter().map(|it| it.join("junit.xml")));
    let schema = repository().join("tests/it/grade/junit-10.xsd");
    let validate = |file: &Path| {
        let mut command = Command::new(&program);
        command.arg("--schema").arg(&schema).arg(file);
        command.output().expect("the validator can be run")
    };
    for file in &files {
        let output = validate(file);
        assert!(output.status.success(), "{output:?}\n{}", text(file));
    }
    // The validator finds what it is there for.
    let bad = text(&files[0]).replacen("<testsuites ", "<testsuites skipped=\"1\" ", 1);
    let bad = write(folder.path(), "bad.xml", bad);
    assert!(!validate(&bad).status.success());
}

#[test]
fn tap_is_parsed() {
    let Some(program) = Validator::Tap.find(&repository(), "tap_is_parsed") else {
        return;
    };
    let folder = graded();
    let grades = folder.path().join("grades");
    let parse = |bytes: &[u8]| {
        let child = Command::new(&program)
            .args(["--strict", "--json=0"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn();
        let mut child = child.expect("the parser can be run");
        let mut stdin = child.stdin.take().expect("a pipe");
        stdin.write_all(bytes).expect("the parser reads");
        drop(stdin);
        let output = child.wait_with_output().expect("the parser ends");
        let events: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let events = events.as_array().expect("a list").clone();
        let of = |kind: &str| -> Vec<Value> {
            let events = events.iter().filter(|it| it[0] == kind);
            events.map(|it| it[1].clone()).collect()
        };
        (of("assert"), of("complete"), of("extra"))
    };
    // Of 3 robots with 4 criteria and a mark: flood misses one criterion, the others all of them.
    let file = fs::read(grades.join("grade.tap")).expect("a file");
    let (points, complete, extra) = parse(&file);
    let counts = ["count", "pass", "fail", "skip", "todo"].map(|it| complete[0][it].as_u64());
    assert_eq!(counts, [15, 4, 11, 0, 0].map(Some), "{complete:#?}");
    assert!(extra.is_empty(), "{extra:#?}");
    for point in points {
        assert!(point["diag"].is_object(), "{point:#}");
    }
    // The parser finds what it is there for.
    for (stream, is_ok) in [
        ("TAP version 14\n1..1\nok 1 - a\n", true),
        ("TAP version 14\n1..2\nok 1 - a\n", false),
        ("TAP version 14\n1..1\nok 1 - a\nno TAP\n", false),
    ] {
        let (_, complete, _) = parse(stream.as_bytes());
        assert_eq!(complete[0]["ok"], is_ok, "{stream}");
    }
}

/// The fields that <https://gradescope-autograders.readthedocs.io/en/latest/specs/> describes.
#[test]
fn gradescope_results_have_the_fields_that_are_documented() {
    let folder = graded();
    let known = |value: &Value, names: &[&str]| {
        let found: BTreeSet<&str> = value
            .as_object()
            .expect("an object")
            .keys()
            .map(String::as_str)
            .collect();
        let names: BTreeSet<&str> = names.iter().copied().collect();
        assert!(found.is_subset(&names), "{found:?}");
    };
    let visibilities = ["hidden", "after_due_date", "after_published", "visible"];
    let formats = ["text", "html", "simple_format", "md", "ansi"];
    let is_one = |value: &Value, of: &[&str]| {
        assert!(value.as_str().is_some_and(|it| of.contains(&it)), "{value}");
    };
    for robot in folders(&folder.path().join("grades")) {
        let document = json(&robot.join("results.json"));
        known(
            &document,
            &[
                "score",
                "execution_time",
                "output",
                "output_format",
                "test_output_format",
                "test_name_format",
                "visibility",
                "stdout_visibility",
                "extra_data",
                "tests",
                "leaderboard",
            ],
        );
        is_one(&document["visibility"], &visibilities);
        is_one(&document["stdout_visibility"], &visibilities);
        is_one(&document["output_format"], &formats);
        assert!(document["output"].is_string() && document["extra_data"].is_object());
        let tests = document["tests"].as_array().expect("a list");
        assert_eq!(tests.len(), 4);
        for test in tests {
            known(
                test,
                &[
                    "score",
                    "max_score",
                    "status",
                    "name",
                    "name_format",
                    "number",
                    "output",
                    "output_format",
                    "tags",
                    "visibility",
                    "extra_data",
                ],
            );
            is_one(&test["status"], &["passed", "failed"]);
            is_one(&test["visibility"], &visibilities);
            is_one(&test["name_format"], &formats);
            is_one(&test["output_format"], &formats);
            let (score, max) = (test["score"].as_f64(), test["max_score"].as_f64());
            assert!(score.expect("a number") <= max.expect("a number"));
            assert!(test["number"].is_string() && test["name"].is_string());
        }
        for entry in document["leaderboard"].as_array().expect("a list") {
            known(entry, &["name", "value", "order"]);
            assert!(entry["name"].is_string() && entry["value"].is_number());
        }
    }
}

/// What the published schema of `classroom50/result/v1` and its runner require.
#[test]
fn classroom_50_results_keep_their_contract() {
    let folder = graded();
    for robot in folders(&folder.path().join("grades")) {
        let document = json(&robot.join("result.json"));
        let fields = document.as_object().expect("an object");
        let mut names: Vec<&str> = fields.keys().map(String::as_str).collect();
        names.sort_unstable();
        let required = [
            "assignment",
            "assignment_type",
            "classroom",
            "commit",
            "datetime",
            "max-score",
            "owner",
            "release",
            "review",
            "schema",
            "score",
            "submission",
            "tests",
        ];
        assert_eq!(names, required);
        assert_eq!(document["schema"], "classroom50/result/v1");
        assert_eq!(document["assignment_type"], "individual");
        for (name, key) in [
            ("CLASSROOM", "classroom"),
            ("ASSIGNMENT", "assignment"),
            ("OWNER", "owner"),
            ("SUBMISSION_TAG", "submission"),
            ("COMMIT_URL", "commit"),
            ("RELEASE_URL", "release"),
            ("COMMIT_URL", "review"),
        ] {
            let (_, value) = CLASSROOM
                .into_iter()
                .find(|it| it.0 == name)
                .expect("it is set");
            assert_eq!(document[key], value);
        }
        let datetime = document["datetime"].as_str().expect("a text");
        let shape: String = datetime
            .chars()
            .map(|it| if it.is_ascii_digit() { '0' } else { it })
            .collect();
        assert_eq!(shape, "0000-00-00T00:00:00Z");
        let (mut score, mut max) = (0, 0);
        for test in document["tests"].as_array().expect("a list") {
            assert!(test["test-name"].as_str().is_some_and(|it| !it.is_empty()));
            assert!(test["passed"].is_boolean() && test["message"].is_string());
            let points =
                [&test["score"], &test["max-score"]].map(|it| it.as_u64().expect("an integer"));
            assert!(points[0] <= points[1]);
            score += points[0];
            max += points[1];
        }
        assert_eq!(
            (&document["score"], &document["max-score"]),
            (&json!(score), &json!(max))
        );
        assert_eq!(max, 10);
    }
}

#[test]
fn nothing_that_a_robot_says_is_a_command_or_markup() {
    let folder = graded();
    let stdout = text(&folder.path().join("stdout"));
    let commands: Vec<&str> = stdout
        .lines()
        .filter(|it| it.trim_start().starts_with("::"))
        .collect();
    // A notice for each robot, and what was missed: 1, 4 and 4 criteria.
    assert_eq!(commands.len(), 3 + 9, "{stdout}");
    for command in commands {
        let is_ours = ["::error title=", "::warning title=", "::notice title="];
        assert!(
            is_ours.iter().any(|it| command.starts_with(it)),
            "{command}"
        );
    }
    let summary = text(&folder.path().join("step.md"));
    assert!(
        summary.starts_with("before\n\n## Test: 1 of 3 robots passed\n"),
        "{summary}"
    );
    for text in [&stdout, &summary] {
        assert!(!text.contains("##["), "{text}");
        assert!(
            !text.contains(|it: char| it.is_control() && it != '\n'),
            "{text:?}"
        );
    }
    assert!(!summary.contains("<b>"), "{summary}");
    let table = summary.lines().filter(|it| it.starts_with("| "));
    for row in table {
        let cells = row.matches('|').count();
        assert!(cells == 5 || cells == 6, "{row}");
    }
    let csv = text(&folder.path().join("grades.csv"));
    assert!(!csv.lines().any(|it| it.starts_with('=')), "{csv}");
    assert_eq!(csv, text(&folder.path().join("grades/summary.csv")));
}
