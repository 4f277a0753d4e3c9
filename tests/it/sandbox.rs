//! What workers cannot do, tried from inside, and what is reported where the kernel cannot
//! sandbox them.

#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs::{self, File, Permissions};
use std::io::{BufRead as _, BufReader};
use std::os::fd::AsRawFd as _;
use std::os::unix::fs::PermissionsExt as _;
use std::os::unix::process::ExitStatusExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use wasmouse_core::game::SandboxLimits;
use wasmouse_engine::bundled::find;
use wasmouse_engine::sandbox::{Executable, PATIENCE, Role, SandboxStatus, WorkerOptions};
use wasmouse_engine::{Control, Executor as _, InfrastructureError, Limits, Sandboxed};
use wasmouse_tests::binary::{self, Ran, ran};
use wasmouse_tests::program::signal;

use crate::matches::{WORKER, bundled_mazes, rules, sandboxed, spec};

/// The probe, which is to try that in that role; see `tests/bin/sandbox_probe.rs`.
fn probe(role: &str, what: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sandbox-probe"));
    command.args(["worker", role]).args(what);
    command.stdin(Stdio::null());
    command
}

/// What it prints.
#[track_caller]
fn lines(command: &mut Command) -> BTreeMap<String, String> {
    let output = command.output().expect("the probe starts");
    let stdout = String::from_utf8(output.stdout).expect("text");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stdout}\n{stderr}");
    let lines = stdout.lines().map(|line| {
        let (name, outcome) = line.split_once(": ").expect("NAME: OUTCOME");
        (name.to_owned(), outcome.to_owned())
    });
    lines.collect()
}

/// What the probe reports of each attempt, as on a kernel without those features.
fn attempts(role: &str, without: &[&str]) -> BTreeMap<String, String> {
    let inherited = File::open("/etc/passwd").expect("a file that all systems have");
    let descriptor = inherited.as_raw_fd().to_string();
    // The standard library closes files on exec, so it takes a shell to leave one open.
    let shell = format!("exec {descriptor}</etc/passwd; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command
        .args(["-c", &shell, env!("CARGO_BIN_EXE_kernel-without")])
        .args(without)
        .args(["--", env!("CARGO_BIN_EXE_sandbox-probe")])
        .args(["worker", role, "attempts"])
        .arg(std::process::id().to_string())
        .arg(descriptor)
        .stdin(Stdio::null());
    lines(&mut command)
}

/// The layers among those lines, or `None` with a message where the kernel lacks one of those
/// that are tested here.
fn layers(lines: &mut BTreeMap<String, String>) -> Option<BTreeMap<&'static str, bool>> {
    let layers = SandboxStatus::default().layers().map(|(name, _)| {
        let there = lines.remove(name).expect("a layer");
        (name, there == "yes")
    });
    let layers = BTreeMap::from(layers);
    if layers["landlock"] && layers["seccomp"] {
        return Some(layers);
    }
    println!("skipped: this kernel cannot sandbox a worker: {layers:?}");
    None
}

/// All attempts of that role fail but these, with and without namespaces.
#[track_caller]
fn check(role: &str, allowed: &[&str]) {
    for without in [&[][..], &["namespaces"]] {
        check_without(without, role, allowed);
    }
}

#[track_caller]
fn check_without(without: &[&str], role: &str, allowed: &[&str]) {
    let mut outcomes = attempts(role, without);
    let Some(layers) = layers(&mut outcomes) else {
        return;
    };
    assert!(layers["no capabilities"]);
    if !without.is_empty() {
        assert!(!layers["namespaces"]);
    }
    for (name, outcome) in &outcomes {
        let done = outcome == "DONE";
        assert_eq!(done, allowed.contains(&name.as_str()), "{name}: {outcome}");
    }
    assert_eq!(outcomes.len(), 25, "{outcomes:?}");
}

/// Compiled robots must run, and their memory begins as a copy of a file that is in memory. But
/// memory that can be written is never executable, and no memory is mapped twice.
const EXECUTION: [&str; 3] = [
    "make memory executable",
    "make a memory file",
    "map a memory file for itself",
];

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

/// Whether workers can be sandboxed here.
fn sandboxes() -> bool {
    layers(&mut attempts("run", &[])).is_some()
}

/// Every system call that is not in the lists of SECURITY.md is tried.
#[test]
fn calls_that_are_not_listed_fail() {
    if !sandboxes() {
        return;
    }
    for role in Role::ALL.map(Role::name) {
        let output = probe(role, &["others"]).output().expect("the probe starts");
        assert!(output.status.success(), "{role}: {output:?}");
        let stdout = String::from_utf8(output.stdout).expect("text");
        assert_eq!(stdout, "", "{role}: system calls by number");
    }
}

/// Every system call that is listed as fatal is tried, in a process of its own.
#[test]
fn fatal_calls_end_the_worker() {
    const SIGSYS: i32 = 31;
    let output = Command::new(env!("CARGO_BIN_EXE_sandbox-probe"))
        .arg("list")
        .output();
    let names = String::from_utf8(output.expect("the probe starts").stdout).expect("text");
    let security = include_str!("../../SECURITY.md");
    for name in names.lines() {
        assert!(security.contains(&format!("`{name}`")), "{name}");
    }
    assert!(names.lines().count() > 60, "{names}");
    if !sandboxes() {
        return;
    }
    for role in Role::ALL.map(Role::name) {
        for name in names.lines() {
            let output = probe(role, &["fatal", name]).output();
            let output = output.expect("the probe starts");
            let signal = output.status.signal();
            assert_eq!(signal, Some(SIGSYS), "{role}: {name}: {output:?}");
        }
    }
}

/// A probe that waits, with the process that its code runs in.
struct Waiting {
    child: Child,
    layers: BTreeMap<&'static str, bool>,
    worker: u32,
}

impl Waiting {
    /// Starts one; `None` with a message where the kernel lacks layers.
    fn start(role: &str) -> Option<Self> {
        let mut child = probe(role, &["wait"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the probe starts");
        let stdout = BufReader::new(child.stdout.take().expect("a pipe"));
        let mut lines = BTreeMap::new();
        for line in stdout.lines() {
            let line = line.expect("text");
            let (name, there) = line.split_once(": ").expect("NAME: OUTCOME");
            lines.insert(name.to_owned(), there.to_owned());
            if name == "waiting" {
                break;
            }
        }
        let pid = child.id();
        let children = fs::read_to_string(format!("/proc/{pid}/task/{pid}/children"));
        let children = children.unwrap_or_default();
        let inside = children.split_whitespace().next();
        let inside = inside.and_then(|number| number.parse().ok());
        let mut waiting = Self {
            child,
            layers: BTreeMap::new(),
            worker: inside.unwrap_or(pid),
        };
        waiting.layers = layers(&mut lines)?;
        Some(waiting)
    }

    fn status(&self) -> String {
        fs::read_to_string(format!("/proc/{}/status", self.worker)).unwrap_or_default()
    }

    /// A field of the process's status.
    fn field(&self, name: &str) -> String {
        let status = self.status();
        let mut lines = status.lines();
        let value = lines.find_map(|line| line.strip_prefix(name)?.strip_prefix(':'));
        value
            .unwrap_or_else(|| panic!("{name}: {status}"))
            .trim()
            .to_owned()
    }

    /// Whether the worker is gone, after a while.
    fn ends(&self) -> bool {
        let begin = Instant::now();
        while begin.elapsed() < Duration::from_secs(10) {
            let status = self.status();
            if status.is_empty() || status.contains("\nState:\tZ") {
                return true;
            }
            thread::sleep(Duration::from_millis(1));
        }
        false
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// What a worker has, seen from outside.
#[test]
fn a_worker_has_no_privileges() {
    for role in Role::ALL.map(Role::name) {
        let Some(waiting) = Waiting::start(role) else {
            return;
        };
        for set in ["CapInh", "CapPrm", "CapEff", "CapAmb"] {
            assert_eq!(waiting.field(set), "0000000000000000", "{role}: {set}");
        }
        assert!(waiting.layers["no capabilities"], "{role}");
        assert_eq!(waiting.field("NoNewPrivs"), "1", "{role}");
        assert_eq!(waiting.field("Seccomp"), "2", "{role}");
        let score = fs::read_to_string(format!("/proc/{}/oom_score_adj", waiting.worker));
        assert_eq!(score.expect("it runs").trim(), "1000", "{role}");
        if !waiting.layers["namespaces"] {
            println!("{role}: this system allows no namespaces");
            assert_eq!(waiting.worker, waiting.child.id(), "{role}");
            continue;
        }
        assert!(waiting.layers["empty root"], "{role}");
        assert_eq!(waiting.field("CapBnd"), "0000000000000000", "{role}");
        // Its number outside, and the one inside.
        let numbers = format!("{}\t1", waiting.worker);
        assert_eq!(waiting.field("NSpid"), numbers, "{role}");
        // It cannot be traced by others of its user, so only root can look further.
        for kind in ["user", "pid", "net", "ipc", "mnt", "uts", "cgroup"] {
            let own = fs::read_link(format!("/proc/self/ns/{kind}")).expect("a namespace");
            let worker = fs::read_link(format!("/proc/{}/ns/{kind}", waiting.worker));
            if let Ok(worker) = worker {
                assert_ne!(worker, own, "{role}");
            }
        }
        if let Ok(root) = fs::read_dir(format!("/proc/{}/root", waiting.worker)) {
            assert_eq!(root.count(), 0, "{role}");
        }
    }
}

/// What a file needs to be compiled does not depend on how many cores there are: the number of
/// threads is the same everywhere, and stacks and arenas that are reserved do not count.
#[test]
fn the_limits_of_a_worker_do_not_depend_on_the_machine() {
    // The first thread, one that works, one that keeps time, and two that compile.
    let roles = [
        (Role::Compile, "4", "2147483648"),
        (Role::Run, "3", "4294967296"),
        (Role::Backtrace, "5", "4294967296"),
    ];
    for (role, threads, data) in roles.map(|(role, threads, data)| (role.name(), threads, data)) {
        let Some(waiting) = Waiting::start(role) else {
            return;
        };
        assert_eq!(waiting.field("Threads"), threads, "{role}");
        let limit = |process: &str, name: &str| {
            let limits = fs::read_to_string(format!("/proc/{process}/limits"));
            let limits = limits.expect("it runs");
            let mut lines = limits.lines();
            let values = lines.find_map(|line| line.strip_prefix(name));
            let value = values.and_then(|values| values.split_whitespace().next());
            value
                .unwrap_or_else(|| panic!("{name}: {limits}"))
                .to_owned()
        };
        let worker = waiting.worker.to_string();
        assert_eq!(limit(&worker, "Max data size"), data, "{role}");
        assert_eq!(limit(&worker, "Max core file size"), "0", "{role}");
        let own = limit("self", "Max address space");
        assert_eq!(limit(&worker, "Max address space"), own, "{role}");
    }
}

/// The process that the supervisor knows is not always the one with the worker's code.
#[test]
fn a_worker_ends_with_the_process_that_was_started() {
    for role in Role::ALL.map(Role::name) {
        let Some(mut waiting) = Waiting::start(role) else {
            return;
        };
        waiting.child.kill().expect("it runs");
        assert!(waiting.ends(), "{role}");
    }
}

/// And the other way round: the supervisor has to learn of it.
#[test]
fn the_process_that_was_started_ends_as_the_worker_does() {
    const SIGKILL: i32 = 9;
    for role in Role::ALL.map(Role::name) {
        let Some(mut waiting) = Waiting::start(role) else {
            return;
        };
        signal(waiting.worker, "KILL");
        let status = waiting.child.wait().expect("it is a child");
        assert_eq!(status.signal(), Some(SIGKILL), "{role}");
    }
}

/// The supervisor tells a worker that took too long from one that crashed by its signal, which a
/// process that is the first of its namespace does not end by.
#[test]
fn a_worker_without_time_ends_by_the_signal_for_that() {
    const SIGXCPU: i32 = 24;
    let mut command = Command::new("sh");
    command
        .args(["-c", "ulimit -St 1; exec \"$0\" worker run spin"])
        .arg(env!("CARGO_BIN_EXE_sandbox-probe"))
        .stdin(Stdio::null());
    let output = command.output().expect("the probe starts");
    assert_eq!(output.status.signal(), Some(SIGXCPU), "{output:?}");
}

/// A control group that limits nothing, below the one of this process.
struct Delegated(PathBuf);

impl Delegated {
    /// Makes one; `None` with a message where that is not possible.
    fn new() -> Option<Self> {
        let own = fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
        let own = own.lines().find_map(|line| line.strip_prefix("0::/"));
        let own = Path::new("/sys/fs/cgroup").join(own.unwrap_or_default());
        let control = fs::read_to_string(own.join("cgroup.subtree_control")).unwrap_or_default();
        let name = format!("wasmouse-test-{}", std::process::id());
        let folder = own.join(name);
        let limits = ["memory", "pids"].map(|it| control.split_whitespace().any(|x| x == it));
        if limits != [true, true] || fs::create_dir(&folder).is_err() {
            println!("skipped: no control group here may have children: {control:?}");
            return None;
        }
        Some(Self(folder))
    }

    /// A command in it, or, once it has children, in the one that is the program's own.
    fn command(&self) -> Command {
        const SHELL: &str = "(echo $$ > \"$0/cgroup.procs\") 2>/dev/null || \
             echo $$ > \"$0/wasmouse-supervisor/cgroup.procs\" && exec \"$@\"";
        let mut command = Command::new("sh");
        command.args(["-c", SHELL]).arg(&self.0).arg(binary::path());
        command
    }

    fn groups(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("a group");
        let folders = entries.filter_map(|entry| {
            let entry = entry.expect("a group");
            let is_group = entry.file_type().expect("a group").is_dir();
            is_group.then(|| entry.file_name().into_string().expect("text"))
        });
        folders.collect()
    }
}

impl Drop for Delegated {
    fn drop(&mut self) {
        for group in self.groups() {
            let _ = fs::remove_dir(self.0.join(group));
        }
        let _ = fs::remove_dir(&self.0);
    }
}

/// Where this process may arrange control groups, workers are in groups that limit them, and none
/// stays behind.
#[test]
fn a_worker_has_a_control_group() {
    let Some(delegated) = Delegated::new() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let flood = find("flood").expect("a bundled robot").component;
    fs::write(folder.path().join("untrusted.wasm"), flood).expect("a file");
    let mut command = delegated.command();
    command.args(["inspect", "untrusted.wasm", "--measures", "--no-cache"]);
    let inspected = ran(command.current_dir(folder.path()));
    let line = inspected.stdout.lines().find(|it| it.contains("  sandbox"));
    let line = line.unwrap_or_else(|| panic!("{}", inspected.stderr));
    let there = line.split(';').next().expect("a part");
    assert!(there.contains("control group"), "{line}");
    assert_eq!(delegated.groups(), ["wasmouse-supervisor"]);

    let mut command = delegated.command();
    let matches = ["run", "untrusted.wasm", "gen:tree:16:1", "--repeat=1000000"];
    command.args(matches).arg("--no-cache");
    let mut contest = command
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let begin = Instant::now();
    let worker = loop {
        let groups = delegated.groups();
        let worker = groups
            .iter()
            .find(|name| name.starts_with("wasmouse-worker-"));
        if let Some(worker) = worker {
            let worker = delegated.0.join(worker);
            let processes = fs::read_to_string(worker.join("cgroup.procs")).unwrap_or_default();
            // The process that was started, and the one inside the namespace, if there is one.
            if !processes.is_empty() {
                break worker;
            }
        }
        assert!(begin.elapsed() < Duration::from_secs(60), "{groups:?}");
        thread::sleep(Duration::from_millis(5));
    };
    for file in ["memory.max", "pids.max"] {
        let limit = fs::read_to_string(worker.join(file)).expect("a limit");
        assert_ne!(limit.trim(), "max", "{file}");
    }
    contest.kill().expect("it runs");
    contest.wait().expect("it is a child");
    let empty = || {
        let processes = fs::read_to_string(worker.join("cgroup.procs"));
        processes.is_ok_and(|it| it.is_empty())
    };
    while !empty() {
        assert!(begin.elapsed() < Duration::from_secs(120), "{worker:?}");
        thread::sleep(Duration::from_millis(5));
    }
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
            control: Control::default(),
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
