//! Ctrl-C: a contest ends soon and prints what it has.

#![cfg(target_os = "linux")]

use std::fs;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::binary::wasmouse;

/// Waits until the threads that play matches have started.
fn wait_for_matches(pid: u32) {
    let begin = Instant::now();
    let plays = || {
        let threads = fs::read_dir(format!("/proc/{pid}/task")).expect("the process runs");
        let mut names = threads.filter_map(|thread| {
            // A thread may end while they are listed.
            fs::read_to_string(thread.ok()?.path().join("comm")).ok()
        });
        names.any(|name| name.starts_with("matches-"))
    };
    while !plays() {
        assert!(begin.elapsed() < Duration::from_secs(60), "no match begins");
        thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn an_interrupted_contest_prints_what_was_played() {
    // 100,000 matches of up to 1000 steps: minutes.
    let child = wasmouse()
        .args(["run", "random", "gen:tree:20:1..=2", "--repeat", "50000"])
        .args(["--json", "--no-cache"])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let pid = child.id();
    wait_for_matches(pid);
    thread::sleep(Duration::from_secs(1));
    let interrupted = Instant::now();
    let kill = Command::new("kill")
        .args(["-INT", &pid.to_string()])
        .status();
    assert!(kill.expect("there is `kill`").success());
    let output = child.wait_with_output().expect("the program ends");

    let waited = interrupted.elapsed();
    assert!(waited < Duration::from_secs(20), "it took {waited:?}");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    println!("ended {waited:?} after the signal");
    let report: Value = serde_json::from_slice(&output.stdout).expect("complete JSON");
    assert_eq!(report["complete"], false);
    let played = report["matches"].as_array().expect("matches").len();
    assert!((1..100_000).contains(&played), "{played} matches");
    assert_eq!(report["standings"][0]["matches"], played);
    let told = format!("interrupted: {} matches were not played", 100_000 - played);
    assert!(stderr.contains(&told), "{stderr}");
}
