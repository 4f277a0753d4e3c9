//! Contests on a host that lacks memory, descriptors or cores: a match has the result that it has
//! elsewhere, or none, and a robot is never blamed for the host.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use wasmouse_engine::bundled::bundled;
use wasmouse_tests::corpus::cases;
use wasmouse_tests::module::Module;

use crate::binary::{self, ran};

/// Hostile cases that depend most on what the host has: memory, tables, the stack.
const CASES: &[&str] = &[
    "grow", "memor", "table", "recurs", "segment", "stack", "frame",
];

/// Cases of that kind, at least.
const CASES_MIN: usize = 20;

/// Bundled robots, and hostile ones that end within moments.
fn write_robots(folder: &Path) -> Vec<PathBuf> {
    let bundled = bundled().iter().map(|robot| {
        let component = robot.component.to_vec();
        (format!("good-{}", robot.name), component)
    });
    let is_meant = |name: &str| CASES.iter().any(|part| name.contains(part));
    let hostile = cases().into_iter().filter(|case| {
        let expected = Value::from(case.expected.clone()).to_string();
        !case.is_long && is_meant(&case.name) && !expected.contains("fuel")
    });
    let hostile: Vec<_> = hostile
        .map(|case| (case.name.clone(), case.files().swap_remove(0)))
        .collect();
    assert!(hostile.len() >= CASES_MIN, "{} cases", hostile.len());
    let write = |(name, file): (String, Vec<u8>)| {
        let path = folder.join(format!("{name}.wasm"));
        fs::write(&path, file).expect("a temporary file");
        path
    };
    bundled.chain(hostile).map(write).collect()
}

/// A contest of these robots after a shell has set limits.
fn contest(limits: &str, robots: &[PathBuf], options: &[&str]) -> Command {
    let mut command = Command::new("sh");
    // When memory runs out while it prints a backtrace, the standard library waits for ever.
    command.env("RUST_BACKTRACE", "0");
    command.args(["-c", &format!("{limits} exec \"$@\""), "sh"]);
    command.arg(binary::path());
    command.args(["run", "--json", "--no-cache", "--maze=test_maze_01"]);
    command.args(options);
    for robot in robots {
        command.arg("--robot").arg(robot);
    }
    command
}

/// What a document says about each robot: its rejection, and its match.
type Outcomes = BTreeMap<String, (Value, Value)>;

fn outcomes(document: &Value) -> Outcomes {
    let list = |value: &Value| value.as_array().expect("a list").clone();
    let matches = list(&document["matches"]);
    let robots = list(&document["contest"]["robots"]);
    let outcome = |robot: Value| {
        let of_robot = |it: &&Value| it["key"]["robot"] == robot["digest"];
        let played = matches.iter().find(of_robot).cloned();
        let name = robot["name"].as_str().expect("a name").to_owned();
        (
            name,
            (robot["rejection"].clone(), played.unwrap_or_default()),
        )
    };
    robots.into_iter().map(outcome).collect()
}

/// Plays under each limit and returns how many matches were played under all of them together.
#[track_caller]
fn check(limits: &[String], options: &[&str]) -> usize {
    let folder = tempfile::tempdir().expect("a temporary folder");
    check_robots(&write_robots(folder.path()), limits, options)
}

#[track_caller]
fn check_robots(robots: &[PathBuf], limits: &[String], options: &[&str]) -> usize {
    let undisturbed = ran(&mut contest("", robots, options));
    let expected = outcomes(&serde_json::from_str(&undisturbed.stdout).expect("a document"));
    let mut played = 0;
    for limit in limits {
        let ran = ran(&mut contest(&format!("{limit};"), robots, options));
        let status = ran.status.code();
        let place = format!("{limit} {options:?}: {status:?}");
        assert_ne!(status, Some(101), "{place}\n{}", ran.stderr);
        // With very little memory, the program cannot even begin, and a signal ends it.
        if ran.stdout.is_empty() {
            assert_ne!(status, Some(0), "{place}\n{}", ran.stderr);
            continue;
        }
        // An allocation that fails ends the program, and what it has written by then is cut short.
        if status.is_none() {
            continue;
        }
        let document = serde_json::from_str(&ran.stdout);
        let document = document.unwrap_or_else(|error| panic!("{place}: {error}\n{}", ran.stderr));
        for (name, (rejection, record)) in outcomes(&document) {
            let expected = &expected[&name];
            assert!(
                rejection.is_null() || rejection == expected.0,
                "{place}: {name}: {rejection}\n{}",
                ran.stderr
            );
            assert!(
                record.is_null() || record == expected.1,
                "{place}: {name}: {record}\nexpected {}",
                expected.1
            );
            played += usize::from(!record.is_null());
        }
    }
    played
}

fn limits(flag: char, values: impl IntoIterator<Item = u64>) -> Vec<String> {
    let values = values.into_iter();
    values
        .map(|value| format!("ulimit -{flag} {value}"))
        .collect()
}

#[test]
fn few_descriptors_change_no_result() {
    let limits = limits('n', [8, 12, 16, 20, 24, 32, 64]);
    let workers = check(&limits, &["--jobs=2"]);
    let trusted = check(&limits, &["--jobs=2", "--trust"]);
    assert!(workers > 0 && trusted > 0, "{workers} {trusted}");
}

/// Limits in KiB on what a process may write, and on its address space.
#[test]
fn little_memory_changes_no_result() {
    let mut all = limits('d', (4..=18).map(|power| 1 << power));
    all.extend(limits('v', (17..=40).step_by(2).map(|power| 1 << power)));
    let workers = check(&all, &["--jobs=2"]);
    let trusted = check(&all, &["--jobs=2", "--trust"]);
    assert!(workers > 0 && trusted > 0, "{workers} {trusted}");
}

/// Address space for the program and for some of its threads: a document is complete, or nothing of
/// it is printed.
#[test]
fn too_few_threads_leave_no_part_of_a_document() {
    let robots = ["flood", "random"].map(PathBuf::from);
    // In KiB; without a limit, the trusted robots have address space for their memories, too.
    let mut all = limits('v', (128_000..=140_000).step_by(250));
    all.push(String::from("ulimit -v unlimited"));
    let played = check_robots(&robots, &all, &["--jobs=8", "--trust"]);
    assert!(played >= robots.len(), "{played}");
}

/// Sixty-four jobs on however many cores there are, and eight jobs on one.
#[test]
fn the_number_of_cores_changes_no_result() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let robots = write_robots(folder.path());
    let play = |limits: &str, options: &[&str]| ran(&mut contest(limits, &robots, options)).stdout;
    let expected = play("", &["--jobs=1"]);
    assert!(!expected.is_empty());
    for (limits, options) in [
        ("", &["--jobs=2"] as &[_]),
        ("", &["--jobs=8", "--trust"]),
        ("", &["--jobs=64"]),
        ("", &["--jobs=64", "--trust"]),
    ] {
        let found = play(limits, options);
        assert!(found == expected, "{limits} {options:?}: other bytes");
    }
}

/// A compile worker that an inherited limit on processor time kills says nothing about the robot:
/// that is recorded as a failure of the host, and the others play.
#[cfg(target_os = "linux")]
#[test]
fn a_limit_on_processor_time_is_no_rejection() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    // Takes seconds to compile, less than admission allows.
    let calls = "(call_indirect (i32.const 0))".repeat(12_000);
    let slow = Module {
        rest: &format!("(table 1 funcref) (func {calls})"),
        ..Module::default()
    };
    let robots = [("good", Module::default()), ("slow", slow)].map(|(name, robot)| {
        let path = folder.path().join(format!("{name}.wasm"));
        fs::write(&path, robot.component()).expect("a temporary file");
        path
    });
    let ran = ran(&mut contest("ulimit -t 1;", &robots, &["--jobs=2"]));
    assert_eq!(ran.status.code(), Some(5), "{}", ran.stderr);
    let document: Value = serde_json::from_str(&ran.stdout).expect("a document");
    let robots = document["contest"]["robots"].as_array().expect("a list");
    let slow = robots.iter().find(|robot| robot["name"] == "slow");
    let slow = slow.expect("the robot is listed");
    assert_eq!(slow["rejection"], Value::Null, "{slow}");
    assert_ne!(slow["failure"], Value::Null, "{slow}");
    let good = &outcomes(&document)["good"];
    assert_ne!(good.1, Value::Null, "the other robot plays");
}
