//! A match leaves nothing behind but its result: memory does not grow faster than the results.

#![cfg(target_os = "linux")]

use std::fs;
use std::io::Read as _;
use std::process::Stdio;

use crate::binary::wasmouse;

/// What a match may leave behind in the process, in bytes: its result, its part of
/// the JSON document, and room that a growing text has not used yet. The trace of a
/// match alone would be more, and so would its store.
const MATCH_BYTES_MAX: u64 = 2500;

/// The largest resident memory of a contest with that many matches, in bytes, when
/// all are played and the report is written.
fn peak_bytes(matches: u32) -> u64 {
    let mut child = wasmouse()
        .args(["run", "flood", "test_maze_01", "--json", "--no-cache"])
        .args(["--jobs", "2", "--repeat", &matches.to_string()])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdout = child.stdout.take().expect("it is piped");
    // The report is larger than a pipe, so the process waits to be read to the end.
    let mut beginning = [0];
    stdout.read_exact(&mut beginning).expect("a report");
    let status = fs::read_to_string(format!("/proc/{}/status", child.id()))
        .expect("the process is still there");
    let mut rest = Vec::new();
    stdout.read_to_end(&mut rest).expect("the report");
    assert!(rest.len() > 1 << 17, "a short report: {} bytes", rest.len());
    assert!(child.wait().expect("the program ends").success());

    let line = status.lines().find(|line| line.starts_with("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1));
    let kilobytes: u64 = kilobytes
        .and_then(|number| number.parse().ok())
        .expect("`VmHWM:` and a number");
    kilobytes << 10
}

#[test]
fn only_results_are_kept_of_matches() {
    let (few, many) = (500, 10_500);
    let (small, large) = (peak_bytes(few), peak_bytes(many));
    let each = large.saturating_sub(small) / u64::from(many - few);
    println!("{few} matches: {small} bytes, {many}: {large}, {each} for each more");
    assert!(each <= MATCH_BYTES_MAX, "{each} bytes for each match");
}
