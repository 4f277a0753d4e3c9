//! What workers cannot do, tried from inside, and what is said and done where the kernel
//! cannot confine them.

#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs::File;
use std::os::fd::AsRawFd as _;
use std::process::{Command, Stdio};

use wasmouse::robot::bundled::find;

use crate::binary::{self, Ran, ran};

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

/// `wasmouse` in a folder with a stranger's robot, as on a kernel without those features.
fn run_without(features: &[&str], arguments: &[&str]) -> Ran {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let flood = find("flood").expect("a bundled robot").component;
    std::fs::write(folder.path().join("stranger.wasm"), flood).expect("a file");
    let mut command = Command::new(env!("CARGO_BIN_EXE_kernel-without"));
    command.args(features).arg("--").arg(binary::path());
    command.args(arguments).arg("--cache").arg("cache");
    ran(command.current_dir(folder.path()))
}

#[test]
fn an_incomplete_kernel_is_told_once_and_changes_nothing() {
    let run = [
        "run",
        "stranger.wasm",
        "flood",
        "stranger.wasm",
        "test_maze_01",
        "--json",
    ];
    let complete = run_without(&[], &run);
    if !complete.stderr.is_empty() {
        println!(
            "skipped: this kernel is incomplete itself: {}",
            complete.stderr
        );
        return;
    }
    for (features, named) in [
        (&["landlock"][..], "landlock"),
        (&["seccomp"], "seccomp"),
        (&["landlock", "seccomp"], "landlock and seccomp"),
    ] {
        let incomplete = run_without(features, &run);
        assert_eq!(incomplete.status.code(), Some(0), "{}", incomplete.stderr);
        assert!(incomplete.stdout == complete.stdout, "without {named}");
        assert_eq!(
            incomplete.stderr,
            format!(
                "warning: this system has no {named}, so strangers' robots are kept apart by \
                 processes with fewer restrictions; --require-sandbox refuses to go on\n"
            )
        );
    }
}

#[test]
fn a_sandbox_that_is_required_and_missing_ends_it() {
    let check = |features: &[&str], arguments: &[&str], code: i32, expected: &str| {
        let told = run_without(features, &[arguments, &["--require-sandbox"]].concat());
        let what = format!("{features:?} {arguments:?}: {}{}", told.stdout, told.stderr);
        assert_eq!(told.status.code(), Some(code), "{what}");
        assert!(told.stderr.contains(expected), "{what}");
    };
    let hint = "hint: use Linux 5.13 or later with landlock and seccomp, or leave \
                --require-sandbox out\n";
    let run = ["run", "stranger.wasm", "test_maze_01"];
    for features in [&["landlock"][..], &["seccomp"]] {
        check(features, &run, 5, hint);
        check(features, &["inspect", "stranger.wasm"], 5, hint);
    }
    // Robots of our own need none.
    check(&["landlock"], &["run", "flood", "test_maze_01"], 0, "");
}
