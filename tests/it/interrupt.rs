//! Ctrl-C, SIGTERM and SIGHUP: a contest ends soon and writes what it has, generating ends at once or between two
//! files, and the exit code says so.

#![cfg(target_os = "linux")]

use std::collections::HashMap;
use std::fs;
use std::os::unix::process::CommandExt as _;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;
use wasmouse::contest::Results;
use wasmouse_core::Digest;

use wasmouse_tests::slow::pointer_chaser;

use crate::binary::{stdout_of, wasmouse};

/// Waits until something is so.
fn wait(what: &str, mut is_so: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !is_so() {
        assert!(begin.elapsed() < Duration::from_secs(60), "never: {what}");
        thread::sleep(Duration::from_millis(20));
    }
}

/// Whether the process has a thread whose name begins like that.
fn has_thread(pid: u32, name: &str) -> bool {
    let threads = fs::read_dir(format!("/proc/{pid}/task")).expect("the process runs");
    let mut names = threads.filter_map(|thread| {
        // A thread may end while they are listed.
        fs::read_to_string(thread.ok()?.path().join("comm")).ok()
    });
    names.any(|it| it.starts_with(name))
}

/// Whether the process handles SIGTERM.
fn handles_signals(pid: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).expect("the process runs");
    let caught = status.lines().find_map(|it| it.strip_prefix("SigCgt:"));
    let caught = u64::from_str_radix(caught.expect("signals").trim(), 16).expect("a mask");
    caught & (1 << (libc::SIGTERM - 1)) != 0
}

fn start(arguments: &[&str]) -> Child {
    let mut command = wasmouse();
    // The tests themselves may run under `nohup`.
    let take_hangups = || {
        // SAFETY: the call takes numbers, and may be made between fork and exec.
        unsafe { libc::signal(libc::SIGHUP, libc::SIG_DFL) };
        Ok(())
    };
    // SAFETY: the closure only makes that call.
    unsafe { command.pre_exec(take_hangups) };
    command
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts")
}

/// Sends what Ctrl-C sends.
fn interrupt(child: &Child) {
    send(child, "-INT");
}

fn send(child: &Child, signal: &str) {
    let kill = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(kill.expect("there is `kill`").success());
}

#[test]
fn generating_mazes_ends_at_once() {
    // 100,000 mazes in debug mode: minutes.
    let mazes = "gen:stretches:12..=20:1..=20000";
    let child = start(&["maze", "check", "--summary", mazes]);
    wait("signals are handled", || handles_signals(child.id()));
    thread::sleep(Duration::from_millis(300));
    let interrupted = Instant::now();
    interrupt(&child);
    let output = child.wait_with_output().expect("the program ends");
    assert!(interrupted.elapsed() < Duration::from_secs(20));
    assert_eq!(output.status.code(), Some(130), "{output:?}");
    assert!(output.stdout.is_empty(), "{output:?}");
}

#[test]
fn an_interrupted_folder_of_mazes_holds_whole_files() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let target = folder.path().join("mazes");
    let path = target.to_str().expect("UTF-8");
    let child = start(&["maze", "generate", "gen:tree:20:1..=50000", "-o", path]);
    let files = || fs::read_dir(&target).map_or(0, Iterator::count);
    wait("some files are written", || files() > 20);
    interrupt(&child);
    let output = child.wait_with_output().expect("the program ends");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    let expected = format!("interrupted: wrote {} of 50000 mazes to {path}\n", files());
    assert_eq!(stderr, expected);
    for file in fs::read_dir(&target).expect("the folder") {
        let file = file.expect("an entry").path();
        let text = fs::read_to_string(&file).expect("a file");
        assert!(
            wasmouse_core::maze::format::parse(&text).is_ok(),
            "{file:?}"
        );
    }
}

/// A picture of a thousand large frames takes minutes in debug mode.
#[test]
fn an_interrupted_animated_picture_leaves_no_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let kept = folder.path().join("kept");
    let path = kept.to_str().expect("UTF-8");
    let args = ["run", "wall-follower", "tree-16", "--replays", path];
    // It never finishes, and uses all of its 1,000 steps.
    wasmouse().args(args).output().expect("the program runs");
    let replay = fs::read_dir(&kept).expect("a folder").next();
    let replay = replay.expect("a replay").expect("an entry").path();
    let target = folder.path().join("out");
    fs::create_dir(&target).expect("a folder");
    let file = target.join("a.gif");
    let child = start(&[
        "picture",
        replay.to_str().expect("UTF-8"),
        "--output",
        file.to_str().expect("UTF-8"),
        "--width",
        "1200",
    ]);
    let files = || fs::read_dir(&target).map_or(0, Iterator::count);
    wait("it is being written", || files() > 0);
    interrupt(&child);
    let output = child.wait_with_output().expect("the program ends");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    let expected = format!("interrupted: `{}` is not written\n", file.display());
    assert_eq!((stderr.as_ref(), files()), (expected.as_str(), 0));
}

/// Two robots of very different speed in many mazes: when the contest is interrupted, both have
/// played about the same mazes, and the standings cover those that both have played.
#[test]
fn an_interrupted_contest_is_ranked_over_the_mazes_that_all_have_played() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("results.json");
    fs::write(&path, "old").expect("a file");
    let path = path.to_str().expect("UTF-8");
    // 60,000 matches: minutes.
    let robots = ["run", "random", "wall-follower", "gen:tree:20:1..=30000"];
    let options = ["--json", "--no-cache", "--jobs=2", "--force", "-o", path];
    let child = start(&[&robots[..], &options].concat());
    wait("matches begin", || has_thread(child.id(), "matches-"));
    thread::sleep(Duration::from_secs(2));
    let interrupted = Instant::now();
    interrupt(&child);
    let output = child.wait_with_output().expect("the program ends");

    let waited = interrupted.elapsed();
    assert!(waited < Duration::from_secs(20), "it took {waited:?}");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    let results: Results = serde_json::from_slice(&output.stdout).expect("complete JSON");
    let file = fs::read(path).expect("the file was replaced");
    assert!(file == output.stdout, "the file has what was printed");
    let played = results.matches.len() as u64;
    assert!((1..60_000).contains(&played), "{played} matches");
    let summary = &results.summary;
    assert_eq!((summary.matches, summary.complete), (played, false));

    let standings = &summary.standings;
    assert!(standings.partial);
    // The mazes that both have played.
    let mut by_maze: HashMap<Digest, u64> = HashMap::new();
    for record in &results.matches {
        *by_maze.entry(record.key.maze).or_default() += 1;
    }
    let both = by_maze.values().filter(|&&matches| matches == 2).count() as u64;
    assert_eq!(standings.mazes, both);
    assert!(
        both * 2 + 1024 > played,
        "{both} of {played} matches are comparable"
    );
    for line in &standings.lines {
        assert_eq!(line.matches, both, "{:?}", line.robot);
    }
    let message = format!(
        "interrupted after {played} of 60000 matches; standings cover the {both} of 30000 mazes \
         that every robot has played\n"
    );
    assert!(stderr.ends_with(&message), "{stderr}");
}

/// A service manager, `timeout`, `kill`; the terminal that was closed. The exit code is the one that
/// a shell reports for the signal.
#[test]
fn a_contest_that_is_terminated_writes_what_it_has() {
    for (signal, code) in [("-TERM", 143), ("-HUP", 129)] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("results.json");
        let path = path.to_str().expect("UTF-8");
        let robots = ["run", "random", "gen:tree:20:1..=30000"];
        let options = ["--json", "--no-cache", "--jobs=2", "-o", path];
        let child = start(&[&robots[..], &options].concat());
        wait("matches begin", || has_thread(child.id(), "matches-"));
        thread::sleep(Duration::from_secs(1));
        send(&child, signal);
        let output = child.wait_with_output().expect("the program ends");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{signal}: {stderr}");
        let results: Results = serde_json::from_slice(&output.stdout).expect("complete JSON");
        assert!(!results.summary.complete, "{signal}");
        let file = fs::read(path).expect("the file was written");
        assert!(
            file == output.stdout,
            "{signal}: the file has what was printed"
        );
    }
}

/// Nobody reads what the first signal has it write.
#[test]
fn the_second_signal_ends_at_once() {
    let robots = ["run", "random", "gen:tree:20:1..=30000"];
    let mut child = start(&[&robots[..], &["--json", "--no-cache", "--jobs=2"]].concat());
    wait("matches begin", || has_thread(child.id(), "matches-"));
    // More than a pipe takes.
    thread::sleep(Duration::from_secs(2));
    send(&child, "-TERM");
    thread::sleep(Duration::from_secs(1));
    let ended = child.try_wait().expect("a child");
    assert_eq!(ended, None, "it waits for its reader");
    send(&child, "-HUP");
    let status = child.wait().expect("the program ends");
    assert_eq!(status.code(), Some(129));
}

/// `nohup` is for going on when the terminal is closed.
#[test]
fn an_ignored_hangup_stays_ignored() {
    let mazes = "gen:stretches:12..=20:1..=20000";
    let child = Command::new("nohup")
        .arg(wasmouse().get_program())
        .args(["maze", "check", "--summary", mazes])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("there is `nohup`");
    wait("signals are handled", || handles_signals(child.id()));
    send(&child, "-HUP");
    thread::sleep(Duration::from_secs(1));
    send(&child, "-TERM");
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(143), "{output:?}");
}

/// The first time is on one job and so in process; the second is on two, and so in workers.
#[test]
fn an_interrupted_reproduction_says_so() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("results.json");
    let robot = ["run", "random", "gen:tree:20:1..=2", "--repeat", "3000"];
    let options = ["--no-cache", "--jobs=1", "--reproduce", "-o"];
    let file = path.to_str().expect("the path is text");
    let child = start(&[&robot[..], &options, &[file]].concat());
    wait("the second time begins", || {
        has_thread(child.id(), "worker-monitor")
    });
    interrupt(&child);
    let output = child.wait_with_output().expect("the program ends");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    let last = stderr.lines().last().unwrap_or_default();
    let message = last.strip_prefix("interrupted: ").expect("it says so");
    let (count, rest) = message.split_once(' ').expect("a number of matches");
    assert_eq!(rest, "matches were not played a second time");
    let count: u32 = count.parse().expect("a number");
    assert!((1..=6000).contains(&count), "{count}");
    // The first time was played to its end.
    let json = fs::read(&path).expect("results");
    let results: Results = serde_json::from_slice(&json).expect("complete JSON");
    assert!(results.summary.complete);
}

#[test]
fn an_interrupted_verification_does_not_verify() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("result.json");
    let robot = [
        "run",
        "random",
        "gen:tree:20:1..=2",
        "--repeat",
        "3000",
        "--json",
    ];
    let recorded = stdout_of(wasmouse().args(robot));
    fs::write(&path, recorded).expect("a file");
    let path = path.to_str().expect("UTF-8");
    let child = start(&["verify", path, "--json", "--no-cache"]);
    wait("matches begin", || has_thread(child.id(), "matches-"));
    interrupt(&child);
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(130), "{output:?}");
    let report: Value = serde_json::from_slice(&output.stdout).expect("complete JSON");
    assert_eq!(report["verified"], false);
    let file = &report["files"][0];
    assert_eq!(file["status"], "incomplete");
    let reason = file["reason"].as_str().expect("a reason");
    assert!(reason.starts_with("interrupted after "), "{reason}");
    assert_eq!(file["differences"].as_array().map(Vec::len), Some(0));
}

/// The slow robot plays for minutes; workers are killed, and matches in this process end.
#[test]
fn a_match_in_progress_is_not_waited_for() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let robot = folder.path().join("chaser.wasm");
    fs::write(&robot, pointer_chaser()).expect("a file");
    let robot = robot.to_str().expect("UTF-8");
    for mode in ["--require-sandbox", "--trust"] {
        let arguments = ["run", robot, "gen:tree:12:1..=3", "--json", "--no-cache"];
        let child = start(&[&arguments[..], &["--jobs=2", mode]].concat());
        wait("matches begin", || has_thread(child.id(), "matches-"));
        thread::sleep(Duration::from_secs(1));
        let interrupted = Instant::now();
        interrupt(&child);
        let output = child.wait_with_output().expect("the program ends");
        let waited = interrupted.elapsed();
        assert!(
            waited < Duration::from_secs(15),
            "{mode}: it took {waited:?}"
        );
        println!("{mode}: ended {waited:?} after Ctrl-C");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(130), "{mode}: {stderr}");
        let results: Results = serde_json::from_slice(&output.stdout).expect("complete JSON");
        assert_eq!(results.matches.len(), 0, "{mode}");
        assert_eq!(results.summary.failures.len(), 0, "{mode}");
    }
}
