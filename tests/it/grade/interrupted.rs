//! Ctrl-C while robots are graded.

#![cfg(target_os = "linux")]

use std::fs;
use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};

use wasmouse_tests::program::signal;

use super::{command, folder, json, text, write};

#[test]
fn an_interrupted_grade_is_complete_and_says_so() {
    let folder = folder();
    // 30,000 matches: minutes.
    let rubric = super::RUBRIC.replace("gen:tree:12:1..=6", "gen:tree:20:1..=30000");
    write(folder.path(), "rubric.toml", rubric);
    let line = "grade rubric.toml random --no-cache --jobs 2 --json grade.json --junit junit.xml \
                --tap grade.tap";
    let child = command(folder.path(), line)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let begin = Instant::now();
    let has_begun = || {
        let tasks = fs::read_dir(format!("/proc/{}/task", child.id())).expect("the process runs");
        let mut names =
            tasks.filter_map(|it| fs::read_to_string(it.ok()?.path().join("comm")).ok());
        names.any(|it| it.starts_with("matches-"))
    };
    while !has_begun() {
        assert!(begin.elapsed() < Duration::from_secs(60), "it never plays");
        thread::sleep(Duration::from_millis(20));
    }
    thread::sleep(Duration::from_secs(1));
    signal(child.id(), "INT");
    let output = child.wait_with_output().expect("the program ends");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    let document = json(&folder.path().join("grade.json"));
    assert_eq!(document["complete"], false);
    let criteria = document["robots"][0]["criteria"]
        .as_array()
        .expect("a list");
    assert_eq!(criteria.len(), 4);
    let skipped = criteria
        .iter()
        .filter(|it| it["status"] == "skipped")
        .count();
    assert!(skipped >= 3, "{document:#}");
    assert!(text(&folder.path().join("junit.xml")).contains("were played: interrupted"));
    assert!(text(&folder.path().join("grade.tap")).contains("not ok 5 - random passes"));
}
