//! Exit codes and results, whatever becomes of a robot.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use wasmouse_tests::slow::pointer_chaser;

use super::{RUBRIC, command, component, folder, json, panicking, text, write};
use crate::binary::{Ran, ran};
use crate::hostile::Module;

/// Grades one robot, and returns its entry in the JSON document.
#[track_caller]
fn check(robot: &[u8], options: &str, exit: i32, participation: &str) -> (Value, String) {
    let folder = folder();
    write(folder.path(), "bot.wasm", robot);
    let line = format!("grade rubric.toml bot.wasm --no-cache --json grade.json {options}");
    let Ran { status, stderr, .. } = ran(&mut command(folder.path(), &line));
    assert_eq!(status.code(), Some(exit), "{stderr}");
    let document = json(&folder.path().join("grade.json"));
    let robot = document["robots"][0].clone();
    assert_eq!(robot["robot"], "bot");
    assert_eq!(robot["participation"], participation, "{stderr}");
    assert_eq!(robot["criteria"].as_array().map(Vec::len), Some(4));
    for criterion in robot["criteria"].as_array().expect("a list") {
        let message = criterion["message"].as_str().expect("a text");
        assert!(!message.is_empty());
    }
    (robot, stderr)
}

fn statuses(robot: &Value) -> Vec<&str> {
    let criteria = robot["criteria"].as_array().expect("a list");
    let statuses = criteria.iter().map(|it| it["status"].as_str());
    statuses.map(|it| it.expect("a text")).collect()
}

#[test]
fn a_good_robot_passes() {
    let (robot, _) = check(component("flood"), "", 0, "admitted");
    assert_eq!(robot["passed"], true);
    assert_eq!(statuses(&robot), ["passed", "partial", "passed", "passed"]);
    let counts = json!({"planned": 7, "played": 7, "finished": 7, "faults": 0});
    assert_eq!(robot["matches"], counts);
    let points = robot["points_thousandths"].as_u64().expect("a number");
    assert!((7_000..10_000).contains(&points), "{points}");
}

#[test]
fn a_robot_that_never_arrives_is_below_the_mark() {
    let (robot, _) = check(&Module::default().component(), "", 1, "admitted");
    assert_eq!(statuses(&robot), ["failed", "failed", "passed", "failed"]);
    assert_eq!(robot["points_thousandths"], 2000);
    assert_eq!(robot["faults"], json!([]));
}

#[test]
fn a_robot_that_faults_is_told_from_one_that_is_slow() {
    let robot = panicking("\\1b[31m<b>::error::\\0a##[x]", 22);
    let (robot, stderr) = check(&robot, "", 4, "admitted");
    assert_eq!(statuses(&robot), ["failed"; 4]);
    assert_eq!(robot["faults"][0]["kind"], "panic");
    assert_eq!(robot["faults"][0]["matches"], 7);
    assert!(!stderr.contains(['\u{1b}']), "{stderr}");
}

#[test]
fn a_rejected_file_gets_no_points_and_the_reason() {
    let (robot, stderr) = check(b"I am no robot", "", 4, "rejected");
    assert_eq!(statuses(&robot), ["failed"; 4]);
    let reason = robot["reason"].as_str().expect("a reason");
    let message = robot["criteria"][0]["message"].as_str().expect("a text");
    assert_eq!(message, format!("the robot is rejected: {reason}"));
    assert!(robot["hint"].is_string());
    assert!(stderr.starts_with("rejected `bot`: "), "{stderr}");
    assert!(stderr.contains("\n  hint: "), "{stderr}");
}

#[test]
fn a_robot_that_takes_too_long_is_withdrawn_and_graded() {
    let options = "--match-time 1 --robot-time 2 --jobs 1";
    let (robot, _) = check(&pointer_chaser(), options, 5, "withdrawn");
    assert_eq!(statuses(&robot), ["failed"; 4]);
    let message = robot["criteria"][0]["message"].as_str().expect("a text");
    assert!(
        message.starts_with("the robot was withdrawn: "),
        "{message}"
    );
}

/// In CI, a robot that was not built is a file that is not there.
#[test]
fn a_robot_that_is_not_there_is_graded() {
    let folder = folder();
    let line =
        "grade rubric.toml lost.wasm --json grade.json --junit junit.xml --gradescope results.json";
    let Ran {
        status,
        stderr,
        stdout,
    } = ran(&mut command(folder.path(), line));
    assert_eq!(status.code(), Some(3), "{stderr}");
    assert!(
        stderr.contains("missing `lost`: failed to read robot `lost.wasm`: "),
        "{stderr}"
    );
    assert!(
        stdout.starts_with("lost: missing, 0 of 10 points\n"),
        "{stdout}"
    );
    let robot = &json(&folder.path().join("grade.json"))["robots"][0];
    assert_eq!(
        (&robot["participation"], &robot["digest"]),
        (&json!("missing"), &Value::Null)
    );
    assert_eq!(statuses(robot), ["failed"; 4]);
    let results = json(&folder.path().join("results.json"));
    assert_eq!(results["tests"].as_array().map(Vec::len), Some(4));
    assert!(text(&folder.path().join("junit.xml")).contains("failures=\"4\""));
}

#[test]
fn wrong_command_lines_write_nothing() {
    let folder = folder();
    write(folder.path(), "old.json", "old");
    for (line, exit, expected) in [
        ("grade rubric.toml", 2, "ROBOT"),
        (
            "grade rubric.toml flood --json old.json",
            3,
            "already exists",
        ),
        (
            "grade rubric.toml flood --json none/a.json",
            3,
            "does not exist",
        ),
        (
            "grade rubric.toml flood dfs --gradescope a.json",
            2,
            "--output-dir writes",
        ),
        (
            "grade rubric.toml flood --classroom a.json",
            2,
            "CLASSROOM, ASSIGNMENT",
        ),
        (
            "grade rubric.toml flood --step-summary",
            2,
            "GITHUB_STEP_SUMMARY",
        ),
        (
            "grade rubric.toml flood:nosuch --json a.json",
            2,
            "no variant `nosuch`",
        ),
        (
            "grade rubric.toml flood --output-dir old.json",
            5,
            "old.json",
        ),
        ("grade rubric.toml flood --output-dir .", 3, "is not empty"),
        ("grade --init rubric.toml", 3, "already exists"),
        ("grade --init --json a.json", 2, "cannot be used"),
    ] {
        let Ran { status, stderr, .. } = ran(&mut command(folder.path(), line));
        assert_eq!(status.code(), Some(exit), "{line}: {stderr}");
        assert!(stderr.contains(expected), "{line}: {stderr}");
    }
    let mut names: Vec<_> = fs::read_dir(folder.path())
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name())
        .collect();
    names.retain(|it| it != "home");
    names.sort();
    assert_eq!(names, ["old.json", "rubric.toml"]);
    assert_eq!(text(&folder.path().join("old.json")), "old");
    assert_eq!(text(&folder.path().join("rubric.toml")), RUBRIC);
}

/// Equal grades are equal bytes, on any number of threads.
#[test]
fn grades_are_the_same_bytes_again() {
    let folder = folder();
    for (name, jobs) in [("one", "1"), ("two", "3")] {
        let line = format!("grade rubric.toml flood random --jobs {jobs} --output-dir {name}");
        let Ran { stderr, .. } = ran(&mut command(folder.path(), &line));
        assert!(stderr.contains("wrote grades"), "{stderr}");
    }
    let read = |name: &str, file: &str| {
        let path = folder.path().join(name).join(file);
        fs::read(&path).unwrap_or_else(|error| panic!("{path:?}: {error}"))
    };
    for file in [
        "summary.csv",
        "summary.md",
        "grade.json",
        "junit.xml",
        "grade.tap",
        "flood_reset/results.json",
        "random/grade.md",
    ] {
        assert_eq!(read("one", file), read("two", file), "{file}");
    }
}

/// A baseline is what `run` records; a changed robot, maze or seed is noticed.
#[test]
fn baselines_are_results_of_run() {
    let folder = folder();
    let rubric = |path: &Path, first: u32, entry: &str| {
        let text = format!(
            "version = 1\n[seeds]\nfirst = {first}\ncount = 2\n[[mazes]]\nset = \"all\"\n\
             paths = [\"test_maze_01\", \"gen:tree:12:1..=2\"]\n[[criteria]]\nname = \"it\"\n{entry}\n"
        );
        write(path, "rubric.toml", text);
    };
    let run = "run flood dfs test_maze_01 gen:tree:12:1..=2 --repeat 2 --force -o";
    for name in ["base.json", "base.jsonl"] {
        let Ran { status, stderr, .. } = ran(&mut command(folder.path(), &format!("{run} {name}")));
        assert!(status.success(), "{stderr}");
    }
    let check_from = |first: u32, entry: &str, robot: &str, exit: i32, expected: &str| {
        rubric(folder.path(), first, entry);
        let line = format!("grade rubric.toml {robot} --json grade.json --force");
        let Ran {
            status,
            stdout,
            stderr,
        } = ran(&mut command(folder.path(), &line));
        let all = format!("{stdout}{stderr}");
        assert_eq!(status.code(), Some(exit), "{entry}: {all}");
        assert!(all.contains(expected), "{entry}: {all}");
    };
    let check = |entry: &str, robot: &str, exit: i32, expected: &str| {
        check_from(0, entry, robot, exit, expected);
    };
    let base = "baseline = \"base.json\"\nbaseline_robot =";
    check(
        &format!("{base} \"flood:reset\""),
        "flood",
        0,
        "0 higher than the baseline",
    );
    check(
        &format!("{base} \"flood:reset\""),
        "random",
        1,
        "expected no more",
    );
    check(
        &format!("{base} \"nobody\""),
        "flood",
        3,
        "no matches of a robot `nobody`",
    );
    check(
        "baseline = \"base.json\"",
        "flood",
        3,
        "it has matches of 2 robots",
    );
    let digest = wasmouse_core::Digest::of(component("flood")).to_string();
    let lines = format!("baseline = \"base.jsonl\"\nbaseline_robot = \"{digest}\"");
    check(&lines, "flood", 0, "0 higher than the baseline");
    let flood = format!("{base} \"flood:reset\"");
    let missing = "it has no match in maze `test_maze_01` with seed 2";
    check_from(1, &flood, "flood", 3, missing);
    fs::write(folder.path().join("base.json"), "{}").expect("a file");
    check(
        &format!("{base} \"flood\""),
        "flood",
        3,
        "the baseline cannot be used: ",
    );
}

#[test]
fn thresholds_of_run_need_no_rubric() {
    let folder = folder();
    write(folder.path(), "panics.wasm", panicking("oh", 2));
    write(folder.path(), "text.wasm", "no robot");
    for (line, exit, expected) in [
        (
            "run flood test_maze_01 --fail-under finished=100%,regret=50,faults=0",
            0,
            "",
        ),
        (
            "run flood test_maze_01 --fail-under score=1,finished=100",
            1,
            "below the threshold: `flood:reset`: a mean score of ",
        ),
        (
            "run panics.wasm test_maze_01 --fail-under faults=0",
            1,
            "below the threshold: `panics`: 1 fault; expected at most 0",
        ),
        (
            "run panics.wasm test_maze_01 --fail-under faults=1",
            0,
            "fault: `panics`",
        ),
        (
            "run panics.wasm test_maze_01 --fail-under score=1000",
            4,
            "fault: `panics`",
        ),
        (
            "run text.wasm flood test_maze_01 --fail-under finished=50",
            4,
            "below the threshold: `text`: nothing was measured; expected at least 50 %",
        ),
        ("run flood --fail-under finish=1", 2, "unknown key `finish`"),
    ] {
        let Ran { status, stderr, .. } = ran(&mut command(folder.path(), line));
        assert_eq!(status.code(), Some(exit), "{line}: {stderr}");
        assert!(stderr.contains(expected), "{line}: {stderr}");
    }
}
