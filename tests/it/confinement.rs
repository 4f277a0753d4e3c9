//! What workers cannot do, tried from inside.

#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs::File;
use std::os::fd::AsRawFd as _;
use std::process::{Command, Stdio};

/// What the probe says of each attempt; see `tests/bin/confinement_probe.rs`.
fn probe(role: &str) -> BTreeMap<String, String> {
    let inherited = File::open("/etc/passwd").expect("a file that all systems have");
    let mut probe = Command::new(env!("CARGO_BIN_EXE_confinement-probe"));
    probe
        .args(["worker", role])
        .arg(std::process::id().to_string())
        .arg(inherited.as_raw_fd().to_string())
        .stdin(Stdio::null())
        .stderr(Stdio::inherit());
    // The standard library closes files on exec, so it takes a shell to leave one open.
    let shell = format!(
        "exec {fd}</etc/passwd; exec \"$0\" \"$@\"",
        fd = inherited.as_raw_fd()
    );
    let mut command = Command::new("sh");
    command
        .args(["-c", &shell])
        .arg(probe.get_program())
        .args(probe.get_args())
        .stdin(Stdio::null());
    let output = command.output().expect("there is a shell");
    let said = String::from_utf8(output.stdout).expect("text");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}\n{stderr}");
    said.lines()
        .map(|line| {
            let (name, outcome) = line.split_once(": ").expect("NAME: OUTCOME");
            (name.to_owned(), outcome.to_owned())
        })
        .collect()
}

/// All attempts of that role fail but these.
#[track_caller]
fn check(role: &str, allowed: &[&str]) {
    let outcomes = probe(role);
    if outcomes["landlock"] != "true" || outcomes["seccomp"] != "true" {
        println!("skipped: this kernel cannot confine a worker: {outcomes:?}");
        return;
    }
    let attempts = outcomes
        .iter()
        .filter(|(name, _)| !matches!(name.as_str(), "landlock" | "seccomp"));
    let mut count = 0;
    for (name, outcome) in attempts {
        count += 1;
        let done = outcome == "DONE";
        assert_eq!(done, allowed.contains(&name.as_str()), "{name}: {outcome}");
    }
    assert_eq!(count, 16, "{outcomes:?}");
}

#[test]
fn the_worker_that_plays_is_confined() {
    check(
        "play",
        // Compiled robots have to run; but what can be written never can.
        &["map executable memory", "make memory executable"],
    );
}

#[test]
fn the_worker_that_compiles_is_confined() {
    check("compile", &[]);
}

#[test]
fn the_worker_that_explains_is_confined() {
    check(
        "explain",
        &["map executable memory", "make memory executable"],
    );
}
