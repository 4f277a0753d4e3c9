//! Good robots in a contest with every hostile one: the good robots get exactly the results that
//! they get alone, and every hostile one gets an outcome of its own.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};
use wasmouse_engine::bundled::bundled;
use wasmouse_tests::corpus::{Case, cases};

use crate::binary::{ran, wasmouse};

/// Kinds of hostile robots, at least.
const BAD_MIN: usize = 60;

/// Good robots, at least.
const GOOD_MIN: usize = 10;

/// The exit code of a contest with a rejection or a fault.
const EXIT_ROBOT: i32 = 4;

/// Hostile robots with the same outcome that use up their fuel, at most.
const OUT_OF_FUEL_MAX: u32 = 1;

const MAZES: [&str; 1] = ["test_maze_01"];

/// The bundled robots as files, which makes them untrusted, in all variants.
fn write_good_robots(folder: &Path) -> Vec<String> {
    let mut arguments = Vec::new();
    for robot in bundled() {
        let path = folder.join(format!("good-{}.wasm", robot.name));
        fs::write(&path, robot.component).expect("a temporary file");
        let path = path.to_str().expect("the path is text");
        arguments.push(path.to_owned());
        // Variant 0 is the robot itself.
        let variants = robot.variants.iter().filter(|variant| variant.value > 0);
        arguments.extend(variants.map(|variant| format!("{path}:{}", variant.value)));
    }
    assert!(arguments.len() >= GOOD_MIN, "{arguments:?}");
    arguments
}

/// One file of each case that is over within seconds. Of those that run out of fuel, which takes
/// a second each, only a few.
fn write_hostile_robots(folder: &Path) -> Vec<String> {
    let is_slow = |case: &Case| {
        let flood = case.name.starts_with("flood-of-") && !case.name.contains("long");
        case.is_long || flood
    };
    let mut out_of_fuel = BTreeMap::new();
    let cases = cases().into_iter().filter(|case| !is_slow(case));
    let cases = cases.filter(|case| {
        let expected = Value::from(case.expected.clone()).to_string();
        if !expected.contains("fuel") {
            return true;
        }
        let count = out_of_fuel.entry(expected).or_insert(0);
        *count += 1;
        *count <= OUT_OF_FUEL_MAX
    });
    let arguments: Vec<String> = cases
        .map(|case| {
            let path = folder.join(format!("{}.wasm", case.name));
            let files = case.files();
            fs::write(&path, &files[files.len() / 2]).expect("a temporary file");
            path.to_str().expect("the path is text").to_owned()
        })
        .collect();
    assert!(arguments.len() >= BAD_MIN, "{} cases", arguments.len());
    arguments
}

fn contest(robots: &[&[String]], options: &[&str]) -> Command {
    let mut command = wasmouse();
    command.args(["run", "--json", "--no-cache", "--seed=3"]);
    command.args(options);
    command.args(MAZES.map(|maze| format!("--maze={maze}")));
    for robot in robots.iter().copied().flatten() {
        command.arg(format!("--robot={robot}"));
    }
    command
}

/// The results of a contest, and its exit code.
fn document(mut command: Command) -> (Value, Option<i32>) {
    let ran = ran(&mut command);
    let document = serde_json::from_str(&ran.stdout);
    let document = document.unwrap_or_else(|error| panic!("{error}: {}", ran.stderr));
    (document, ran.status.code())
}

/// The matches of robots with these digests.
fn matches<'a>(document: &'a Value, robots: &BTreeSet<&str>) -> Vec<&'a Value> {
    let matches = document["matches"].as_array().expect("a list").iter();
    matches
        .filter(|it| robots.contains(it["key"]["robot"].as_str().expect("a digest")))
        .collect()
}

fn digests(document: &Value) -> BTreeSet<&str> {
    let robots = document["contest"]["robots"].as_array().expect("a list");
    let digest = |robot: &'_ Value| robot["digest"].as_str().map(str::to_owned);
    assert!(robots.iter().all(|robot| digest(robot).is_some()));
    robots
        .iter()
        .filter_map(|robot| robot["digest"].as_str())
        .collect()
}

#[track_caller]
fn check(modes: &[&[&str]]) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let good = write_good_robots(folder.path());
    let bad = write_hostile_robots(folder.path());
    let (alone, status) = document(contest(&[&good], &[]));
    assert_eq!(status, Some(0));
    let good_digests = digests(&alone);
    let expected = matches(&alone, &good_digests);
    assert_eq!(expected.len(), good.len() * MAZES.len());
    for options in modes {
        // The good robots play last, so that with one job they play where the others did.
        let (mixed, status) = document(contest(&[&bad, &good], options));
        assert_eq!(status, Some(EXIT_ROBOT), "{options:?}");
        let found = matches(&mixed, &good_digests);
        assert_eq!(found, expected, "{options:?}");

        let summary = &mixed["summary"];
        assert_eq!(summary["failures"], json!([]), "{options:?}");
        assert_eq!(summary["complete"], json!(true), "{options:?}");
        let robots = mixed["contest"]["robots"].as_array().expect("a list");
        assert_eq!(robots.len(), bad.len() + good.len());
        for robot in robots {
            let digest = robot["digest"].as_str().expect("a digest");
            let played = !matches(&mixed, &BTreeSet::from([digest])).is_empty();
            let is_rejected = robot.get("rejection").is_some();
            assert!(played != is_rejected, "{options:?}: {robot}");
        }
    }
}

#[test]
fn good_robots_are_not_affected_by_hostile_ones() {
    check(&[&["--jobs=2"], &["--jobs=2", "--trust"]]);
}

#[test]
#[ignore = "takes minutes: `cargo xtask test --long`"]
fn good_robots_are_not_affected_by_hostile_ones_in_any_mode() {
    check(&[
        &["--jobs=1"],
        &["--jobs=8"],
        &["--jobs=1", "--trust"],
        &["--jobs=8", "--trust"],
    ]);
}
