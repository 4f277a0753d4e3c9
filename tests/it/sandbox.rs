//! What workers cannot do, tried from inside, and what is reported where the kernel cannot
//! sandbox them.

#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs::{self, File, Permissions};
use std::os::fd::AsRawFd as _;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::{Command, Stdio};

use wasmouse_core::game::SandboxLimits;
use wasmouse_engine::bundled::find;
use wasmouse_engine::sandbox::{Executable, PATIENCE, WorkerOptions};
use wasmouse_engine::{Executor as _, InfrastructureError, Limits, Sandboxed};
use wasmouse_tests::binary::{self, Ran, ran};

use crate::matches::{WORKER, bundled_mazes, rules, sandboxed, spec};

/// What the probe reports of each attempt; see `tests/bin/sandbox_probe.rs`.
fn probe(role: &str) -> BTreeMap<String, String> {
    let inherited = File::open("/etc/passwd").expect("a file that all systems have");
    // The standard library closes files on exec, so it takes a shell to leave one open.
    let shell = format!(
        "exec {fd}</etc/passwd; exec \"$0\" \"$@\"",
        fd = inherited.as_raw_fd()
    );
    let mut command = Command::new("sh");
    command
        .args(["-c", &shell, env!("CARGO_BIN_EXE_sandbox-probe")])
        .args(["worker", role])
        .arg(std::process::id().to_string())
        .arg(inherited.as_raw_fd().to_string())
        .stdin(Stdio::null());
    let output = command.output().expect("there is a shell");
    let stdout = String::from_utf8(output.stdout).expect("text");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stdout}\n{stderr}");
    let lines = stdout.lines().map(|line| {
        let (name, outcome) = line.split_once(": ").expect("NAME: OUTCOME");
        (name.to_owned(), outcome.to_owned())
    });
    lines.collect()
}

/// All attempts of that role fail but these.
#[track_caller]
fn check(role: &str, allowed: &[&str]) {
    let mut outcomes = probe(role);
    let layers = ["landlock", "seccomp"].map(|it| outcomes.remove(it).expect("a layer"));
    if layers != ["true", "true"] {
        println!("skipped: this kernel cannot sandbox a worker: {layers:?}");
        return;
    }
    for (name, outcome) in &outcomes {
        let done = outcome == "DONE";
        assert_eq!(done, allowed.contains(&name.as_str()), "{name}: {outcome}");
    }
    assert_eq!(outcomes.len(), 16, "{outcomes:?}");
}

/// Compiled robots must run; but memory that can be written is never executable.
const EXECUTION: [&str; 2] = ["map executable memory", "make memory executable"];

#[test]
fn the_run_worker_is_sandboxed() {
    check("run", &EXECUTION);
}

#[test]
fn the_compile_worker_is_sandboxed() {
    check("compile", &[]);
}

#[test]
fn the_backtrace_worker_is_sandboxed() {
    check("backtrace", &EXECUTION);
}

/// Features of a kernel, and what is reported to be missing without them.
const FEATURES: [(&str, &str); 3] = [
    ("landlock", "landlock"),
    ("seccomp", "seccomp"),
    ("landlock seccomp", "landlock and no seccomp"),
];

/// Writes a worker program that runs as on a kernel without those features.
fn worker_without(features: &str, program: &Path) {
    let kernel_without = env!("CARGO_BIN_EXE_kernel-without");
    let script = format!("#!/bin/sh\nexec '{kernel_without}' {features} -- '{WORKER}' \"$@\"\n");
    fs::write(program, script).expect("a file");
    fs::set_permissions(program, Permissions::from_mode(0o755)).expect("its own file");
}

#[test]
fn an_incomplete_sandbox_is_reported_and_changes_nothing() {
    let record = |executor: &Sandboxed| {
        let component = find("flood").expect("a bundled robot").component;
        let robot = executor.admit(component).expect("the host works");
        let robot = robot.expect("a bundled robot");
        let (_, maze) = &bundled_mazes()[0];
        let rules = rules(SandboxLimits::default());
        let spec = spec(&rules, robot.digest(), maze, (0, 0));
        let played = executor.execute_with_details(&robot, &spec);
        played.expect("the host works").record
    };
    let complete = sandboxed(WORKER, None).expect("a worker starts");
    if !complete.sandbox().is_complete() {
        let missing = complete.sandbox().missing();
        println!("skipped: this kernel has no {missing} itself");
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (features, missing) in FEATURES {
        let program = folder.path().join(missing);
        worker_without(features, &program);
        let incomplete = sandboxed(&program, None).expect("a worker starts");
        assert_eq!(incomplete.sandbox().missing(), missing);
        assert_eq!(record(&incomplete), record(&complete), "without {missing}");

        let required = WorkerOptions {
            executable: Executable::at(&program),
            patience: PATIENCE,
            require_sandbox: true,
        };
        let rules = rules(SandboxLimits::default());
        let error = Sandboxed::new(rules, Limits::default(), required, None).err();
        assert!(
            matches!(error, Some(InfrastructureError::IncompleteSandbox { missing: it }) if it == missing),
            "{error:?}"
        );
    }
}

/// `wasmouse` in a folder with an untrusted robot, as on a kernel without those features.
fn run_without(features: &[&str], arguments: &[&str]) -> Ran {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let flood = find("flood").expect("a bundled robot").component;
    fs::write(folder.path().join("untrusted.wasm"), flood).expect("a file");
    let mut command = Command::new(env!("CARGO_BIN_EXE_kernel-without"));
    command.args(features).arg("--").arg(binary::path());
    command.args(arguments).arg("--no-cache");
    ran(command.current_dir(folder.path()))
}

/// The program warns once, or fails when a complete sandbox is required; robots that run in its
/// own process need none.
#[test]
fn the_program_reports_an_incomplete_sandbox() {
    let run = ["run", "untrusted.wasm", "dfs", "test_maze_01", "--json"];
    let complete = run_without(&[], &run);
    if !complete.stderr.is_empty() {
        println!(
            "skipped: this kernel is incomplete itself: {}",
            complete.stderr
        );
        return;
    }
    for features in [&["landlock"][..], &["seccomp"]] {
        let incomplete = run_without(features, &run);
        assert_eq!(incomplete.stdout, complete.stdout, "without {features:?}");
        assert_eq!(incomplete.stderr.matches("warning: ").count(), 1);
        let required = ["run", "untrusted.wasm", "test_maze_01", "--require-sandbox"];
        assert_eq!(run_without(features, &required).status.code(), Some(5));
        let inspect = ["inspect", "untrusted.wasm", "--require-sandbox"];
        assert_eq!(run_without(features, &inspect).status.code(), Some(5));
        let trusted = ["run", "flood", "test_maze_01", "--require-sandbox"];
        assert_eq!(run_without(features, &trusted).status.code(), Some(0));
    }
}
