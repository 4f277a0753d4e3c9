//! What happens around the matches: processes killed or stopped at any time, several contests
//! with one cache, a full disk. No result is wrong or lost, no process stays behind, no file is
//! half written.
//!
//! The tests that are ignored by default do the same 200 times; `cargo test --workspace
//! --test it -- --ignored faults` runs them.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use wasmouse::contest::Results;
use wasmouse_engine::bundled::find;
use wasmouse_tests::program::{Program, signal};

use crate::binary;

/// Robots from files, which run in workers, and a bundled one, in enough mazes to be in the
/// middle of a match most of the time.
const CONTEST: [&str; 8] = [
    "run",
    "--json",
    "--jobs=2",
    "flood-file.wasm",
    "dfs-file.wasm",
    "wall-follower",
    "gen:braid:16:1..=40",
    "--repeat=2",
];

/// The program beside the robots of the contest.
fn program() -> Program {
    let program = Program::new(&binary::path()).expect("a folder beside the binary");
    for name in ["flood", "dfs"] {
        let component = find(name).expect("a bundled robot").component;
        let file = program.folder().join(format!("{name}-file.wasm"));
        fs::write(file, component).expect("a file");
    }
    program
}

/// The contest with compiled robots in that folder.
fn contest(program: &Program, cache: &str) -> Command {
    let mut command = program.command();
    command.args(CONTEST).args(["--cache", cache]);
    command
}

fn started(command: &mut Command) -> Child {
    command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts")
}

/// The output of the contest when nothing happens to it, and how long it takes.
fn undisturbed(program: &Program) -> (String, Duration) {
    let begin = Instant::now();
    let output = contest(program, "undisturbed").output().expect("it runs");
    let time = begin.elapsed();
    assert!(output.status.success(), "{}", text(&output.stderr));
    let mut trusted = contest(program, "trusted");
    let trusted = trusted.arg("--trust").output().expect("it runs");
    let stdout = text(&output.stdout);
    assert_eq!(
        stdout,
        text(&trusted.stdout),
        "the same in and out of workers"
    );
    (stdout, time)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("programs print text")
}

#[track_caller]
fn assert_undisturbed(output: &Output, expected: &str, what: &str) {
    let stderr = text(&output.stderr);
    assert!(
        output.status.success(),
        "{what}: {}\n{stderr}",
        output.status
    );
    assert_eq!(text(&output.stdout), expected, "{what}");
    assert_eq!(stderr, "", "{what}");
}

/// Numbers that look random and are the same everywhere.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 33) % end
    }

    /// A part of that time.
    fn part(&mut self, time: Duration) -> Duration {
        Duration::from_micros(self.below(u64::try_from(time.as_micros()).expect("a short time")))
    }
}

/// The current workers of a contest; none when there are none for a while, because it ends.
fn workers_met(program: &Program, contest: &Child) -> Vec<u32> {
    let mut looks = (0..100).map(|_| {
        thread::sleep(Duration::from_millis(1));
        let mut workers = program.processes();
        workers.retain(|process| *process != contest.id());
        workers
    });
    looks.find(|it| !it.is_empty()).unwrap_or_default()
}

/// Kills some worker at some time of a contest.
fn kill_workers(rounds: u64) {
    let program = program();
    let (expected, time) = undisturbed(&program);
    let mut dice = Dice(1);
    let mut killed = 0;
    for round in 0..rounds {
        // Every other round compiles the robots again.
        let cache = if round % 2 == 0 {
            format!("killed-{round}")
        } else {
            "undisturbed".into()
        };
        let child = started(&mut contest(&program, &cache));
        thread::sleep(dice.part(time));
        let workers = workers_met(&program, &child);
        if !workers.is_empty() {
            let which = dice.below(workers.len() as u64);
            signal(workers[usize::try_from(which).expect("a few")], "KILL");
            killed += 1;
        }
        let output = child.wait_with_output().expect("it ends");
        assert_undisturbed(&output, &expected, &format!("round {round}"));
        assert_eq!(program.left_behind(), 0, "round {round}");
    }
    println!("{killed} workers killed in {rounds} rounds");
    assert!(
        killed * 4 > rounds,
        "only {killed} workers were met in {rounds} rounds"
    );
}

#[test]
fn a_killed_worker_changes_nothing() {
    kill_workers(8);
}

#[test]
#[ignore = "takes minutes"]
fn a_killed_worker_changes_nothing_200_times() {
    kill_workers(200);
}

/// Kills the supervisor at some time: its workers end with it, and what it leaves on disk does
/// not affect the next contest.
fn kill_supervisors(rounds: u64) {
    let program = program();
    let (expected, time) = undisturbed(&program);
    let mut dice = Dice(2);
    for round in 0..rounds {
        let mut child = started(&mut contest(&program, "shared"));
        thread::sleep(dice.part(time));
        child.kill().expect("it may have ended");
        child.wait().expect("it ends");
        assert_eq!(program.left_behind(), 0, "round {round}");
        let output = contest(&program, "shared").output().expect("it runs");
        assert_undisturbed(&output, &expected, &format!("round {round}"));
    }
}

#[test]
fn a_killed_supervisor_takes_its_workers_along() {
    kill_supervisors(5);
}

#[test]
#[ignore = "takes minutes"]
fn a_killed_supervisor_takes_its_workers_along_200_times() {
    kill_supervisors(200);
}

#[test]
fn a_page_is_there_as_a_whole_or_not_at_all() {
    let program = program();
    let (_, time) = undisturbed(&program);
    let page = program.folder().join("page.html");
    let command = || {
        let mut command = program.command();
        let arguments = CONTEST.iter().filter(|argument| **argument != "--json");
        command
            .args(arguments)
            .args(["--cache", "undisturbed", "--html", "page.html"]);
        command
    };
    let whole = command().output().expect("it runs");
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    let expected = fs::read(&page).expect("a page");
    let mut dice = Dice(3);
    let mut there = 0;
    for _ in 0..10 {
        fs::remove_file(&page).expect("the page of the round before");
        let mut child = started(&mut command());
        thread::sleep(time * 3 / 4 + dice.part(time / 2));
        child.kill().expect("it may have ended");
        child.wait().expect("it ends");
        match fs::read(&page) {
            Ok(bytes) => {
                there += 1;
                assert!(
                    bytes == expected,
                    "{} of {} bytes",
                    bytes.len(),
                    expected.len()
                );
            }
            Err(_) => fs::write(&page, "").expect("a file for the next round"),
        }
    }
    println!("the page was there {there} times of 10");
}

/// Stopped as a laptop is that goes to sleep: every clock goes on meanwhile.
#[test]
fn a_contest_that_was_stopped_goes_on() {
    let program = program();
    let (expected, time) = undisturbed(&program);
    let mut dice = Dice(4);
    for round in 0..3 {
        let child = started(&mut contest(&program, "undisturbed"));
        thread::sleep(dice.part(time));
        for process in program.processes() {
            signal(process, "STOP");
        }
        thread::sleep(Duration::from_secs(1));
        for process in program.processes() {
            signal(process, "CONT");
        }
        let output = child.wait_with_output().expect("it ends");
        assert_undisturbed(&output, &expected, &format!("round {round}"));
    }
}

/// The same job several times at once, with one cache that is empty at first.
#[test]
fn the_same_contest_at_the_same_time() {
    let program = program();
    let (expected, _) = undisturbed(&program);
    let children: Vec<Child> = (0..4)
        .map(|_| started(&mut contest(&program, "same")))
        .collect();
    for child in children {
        let output = child.wait_with_output().expect("it ends");
        assert_undisturbed(&output, &expected, "at the same time");
    }
    assert_eq!(program.left_behind(), 0);
}

/// A small file system of its own, where this user may make one.
pub struct SmallDisk(PathBuf);

impl SmallDisk {
    /// A disk of that size at a new folder; `None` where this user may not mount one.
    pub fn new(folder: &Path, kilobytes: u32) -> Option<Self> {
        fs::create_dir(folder).expect("a folder");
        let mounted = Command::new("mount")
            .args([
                "-t",
                "tmpfs",
                "-o",
                &format!("size={kilobytes}k,mode=700"),
                "tmpfs",
            ])
            .arg(folder)
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success());
        if !mounted {
            println!("skipped: this user may not mount a small disk");
            return None;
        }
        Some(Self(folder.to_owned()))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// How many files it has.
    pub fn files(&self) -> usize {
        fs::read_dir(&self.0).expect("the disk").count()
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
    }
}

/// There is no place for the compiled code of untrusted robots, so those cannot be admitted. The
/// others play, are played a second time, and are verified.
#[test]
fn a_robot_that_cannot_be_admitted_costs_nobody_else_anything() {
    let program = program();
    let command = |arguments: &[&str]| {
        let mut command = program.command();
        command.args(arguments);
        command
    };
    let robots = ["flood-file.wasm", "wall-follower", "test_maze_01"];
    let run = ["run", "--json", "--jobs=1"];
    let records = |output: &Output, robot: &str| {
        let results: Results = serde_json::from_slice(&output.stdout).expect("complete JSON");
        let mut robots = results.contest.robots.iter();
        let robot = robots.find(|it| it.name.as_guest().starts_with(robot));
        let robot = robot.expect("it was given");
        let failure = robot.failure.clone().unwrap_or_default();
        let matches = results.matches.into_iter();
        let records = matches.filter(|it| it.key.robot == robot.digest);
        (failure, records.collect::<Vec<_>>())
    };
    let both = command(&run)
        .args(robots)
        .args(["--cache", "kept"])
        .output();
    let both = both.expect("it runs");
    assert!(both.status.success(), "{}", text(&both.stderr));

    // Nowhere from the beginning.
    let mut nowhere = command(&run);
    nowhere
        .args(robots)
        .arg("--no-cache")
        .env("TMPDIR", "/nonexistent");
    let nowhere = nowhere.output().expect("it runs");
    let stderr = text(&nowhere.stderr);
    assert_eq!(nowhere.status.code(), Some(5), "{stderr}");
    let message = "error: `flood-file` could not be admitted: failed to store compiled code: ";
    assert!(stderr.contains(message), "{stderr}");
    let (failure, played) = records(&nowhere, "flood-file");
    let failure = failure.as_guest();
    assert!(failure.starts_with("failed to store compiled code: "));
    assert_eq!(played, []);
    assert_eq!(
        records(&nowhere, "wall-follower"),
        records(&both, "wall-follower")
    );

    // The first time there is a cache. The second time is on one job, so that the bundled robot
    // needs no workers.
    let mut again = command(&["run", "--json", "--jobs=2"]);
    again.args(robots).args(["--cache", "kept", "--reproduce"]);
    let again = again
        .env("TMPDIR", "/nonexistent")
        .output()
        .expect("it runs");
    let stderr = text(&again.stderr);
    assert_eq!(again.status.code(), Some(5), "{stderr}");
    assert_eq!(text(&again.stdout), text(&both.stdout));
    assert!(stderr.contains(message), "{stderr}");
    let end = "error: 1 of 2 matches could not be played a second time\n";
    assert!(stderr.ends_with(end), "{stderr}");

    fs::write(program.folder().join("results.json"), &both.stdout).expect("a file");
    let mut verified = command(&["verify", "results.json", "--robot=flood-file.wasm"]);
    verified
        .args(["--no-cache", "--jobs=2"])
        .env("TMPDIR", "/nonexistent");
    let verified = verified.output().expect("it runs");
    let stdout = text(&verified.stdout);
    assert_eq!(verified.status.code(), Some(5), "{stdout}");
    let expected = "`flood-file` could not be admitted: failed to store compiled code: ";
    assert!(stdout.contains(expected), "{stdout}");
}

/// There is no room for results: the command fails with a message and leaves no partial file.
#[test]
fn a_full_disk_for_results_is_a_failure() {
    let program = program();
    let folder = program.folder().join("results");
    let Some(disk) = SmallDisk::new(&folder, 4) else {
        return;
    };
    let mut command = program.command();
    command.args([
        "run",
        "flood-file.wasm",
        "test_maze_01",
        "--no-cache",
        "--html",
    ]);
    let output = command
        .arg(folder.join("page.html"))
        .output()
        .expect("it runs");
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(5), "{stderr}");
    assert!(stderr.contains("No space left"), "{stderr}");
    assert_eq!(disk.files(), 0, "nothing half written stays: {stderr}");
    assert!(
        text(&output.stdout).contains("finished"),
        "the table was printed"
    );
}
