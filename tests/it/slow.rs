//! Robots that take very long for their fuel: they are withdrawn, and cost nobody else anything.

#![cfg(target_os = "linux")]

use std::fs;
use std::ops::ControlFlow;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use tempfile::TempDir;
use wasmouse::contest::{
    Entrant, MatchFailure, MazeSource, Options, Plan, Results, Seeds, Sink, SummaryBuilder, Tee,
    run,
};
use wasmouse_core::Digest;
use wasmouse_core::game::{Fault, SandboxLimits};
use wasmouse_core::record::{MatchRecord, MatchSpec};
use wasmouse_engine::admission::{Inspection, Rejection};
use wasmouse_engine::bundled::find;
use wasmouse_engine::{
    AdmittedRobot, Control, DetailedMatch, Executor, Frame, InProcess, InfrastructureError, Limits,
    Profile, Sandboxed, Sink as MatchSink, Withdrawal,
};
use wasmouse_tests::slow::pointer_chaser;

use crate::binary::{Ran, ran, wasmouse};
use crate::matches::{WORKER, generated_mazes, rules, sandboxed};

const SECOND: Duration = Duration::from_secs(1);

/// A folder with the slow robot, and flood as a file.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("chaser.wasm"), pointer_chaser()).expect("a file");
    let flood = find("flood").expect("a bundled robot").component;
    fs::write(folder.path().join("flood-file.wasm"), flood).expect("a file");
    folder
}

fn contest(folder: &Path, arguments: &[&str]) -> Ran {
    let mut command = wasmouse();
    command.current_dir(folder).args([
        "run",
        "gen:tree:12:1..=10",
        "--json",
        "--no-cache",
        "flood-file.wasm",
    ]);
    ran(command.args(arguments))
}

fn results(ran: &Ran) -> Results {
    let Ran { stdout, stderr, .. } = ran;
    serde_json::from_str(stdout).unwrap_or_else(|error| panic!("{error}\n{stdout}\n{stderr}"))
}

/// The records of flood in a contest with the slow robot are those of flood alone, and its rank
/// is about all mazes.
#[track_caller]
fn check_others(alone: &Results, found: &Results) {
    let digest = alone.contest.robots[0].digest;
    let of_flood = found.matches.iter().filter(|it| it.key.robot == digest);
    let of_flood: Vec<MatchRecord> = of_flood.cloned().collect();
    assert_eq!(of_flood, alone.matches);
    let standings = &found.summary.standings;
    assert_eq!((standings.mazes, standings.partial), (10, false));
    assert_eq!(standings.lines[0], alone.summary.standings.lines[0]);
    assert_eq!(standings.lines[1].rank, None);
    assert!(!found.summary.complete);
}

#[test]
fn a_robot_that_stalls_twice_is_withdrawn() {
    let folder = folder();
    let alone = results(&contest(folder.path(), &[]));
    for mode in [&["--jobs=2"][..], &["--jobs=1"], &["--jobs=2", "--trust"]] {
        let arguments = [&["chaser.wasm", "--match-time=1"], mode].concat();
        let began = Instant::now();
        let ran = contest(folder.path(), &arguments);
        let found = results(&ran);
        assert_eq!(ran.status.code(), Some(5), "{mode:?}: {}", ran.stderr);
        let expected = "withdrawn `chaser`: 2 of its matches did not end in time; ";
        assert!(ran.stderr.contains(expected), "{mode:?}: {}", ran.stderr);
        check_others(&alone, &found);
        let summary = &found.summary;
        let [withdrawn] = &summary.withdrawn[..] else {
            panic!("{mode:?}: {:?}", summary.withdrawn);
        };
        assert_eq!(withdrawn.robot, found.contest.robots[1].digest);
        assert_eq!(withdrawn.matches + summary.failures.len() as u64, 10);
        for failure in &summary.failures {
            let expected = "a match did not end within 1 s of processor time";
            assert_eq!(failure.reason, expected, "{mode:?}");
        }
        // Two seconds of processor time, on a machine that may be busy.
        assert!(began.elapsed() < 60 * SECOND, "{mode:?}");
    }
}

#[test]
fn a_robot_without_time_is_withdrawn() {
    let folder = folder();
    let alone = results(&contest(folder.path(), &[]));
    for mode in ["--require-sandbox", "--trust"] {
        let ran = contest(folder.path(), &["chaser.wasm", "--robot-time=2", mode]);
        let found = results(&ran);
        assert_eq!(ran.status.code(), Some(5), "{mode}: {}", ran.stderr);
        let expected = "withdrawn `chaser`: it has used up its 2 s of processor time; 10 matches \
                        were not played\n";
        assert!(ran.stderr.contains(expected), "{mode}: {}", ran.stderr);
        check_others(&alone, &found);
        assert_eq!(found.summary.failures, []);
    }
}

/// Recorded results with a withdrawn robot are verified: what was not played then is not played.
#[test]
fn results_with_a_withdrawn_robot_are_verified() {
    let folder = folder();
    let ran_contest = contest(folder.path(), &["chaser.wasm", "--match-time=1"]);
    fs::write(folder.path().join("results.json"), &ran_contest.stdout).expect("a file");
    let robots = ["--robot=chaser.wasm", "--robot=flood-file.wasm"];
    let mut command = wasmouse();
    command.current_dir(folder.path());
    let verified = ran(command.args(["verify", "results.json"]).args(robots));
    let (stdout, stderr) = (verified.stdout, verified.stderr);
    assert_eq!(verified.status.code(), Some(0), "{stdout}\n{stderr}");
}

/// Notes in which order matches are played.
struct Noting {
    executor: Box<dyn Executor>,
    order: Mutex<Vec<Digest>>,
}

impl Executor for Noting {
    fn admit(&self, file: &[u8]) -> Result<Result<AdmittedRobot, Rejection>, InfrastructureError> {
        self.executor.admit(file)
    }

    fn inspect(&self, file: &[u8]) -> Result<Inspection, InfrastructureError> {
        self.executor.inspect(file)
    }

    fn execute(
        &self,
        robot: &AdmittedRobot,
        batch: &[MatchSpec],
        sink: &mut MatchSink<'_>,
    ) -> ControlFlow<()> {
        self.executor.execute(robot, batch, &mut |spec, played| {
            let mut order = self.order.lock().unwrap_or_else(PoisonError::into_inner);
            order.push(spec.key.robot);
            drop(order);
            assert!(spec.key.seed != BUG, "panicked on purpose");
            sink(spec, played)
        })
    }

    fn execute_with_details(
        &self,
        robot: &AdmittedRobot,
        spec: &MatchSpec,
    ) -> Result<DetailedMatch, InfrastructureError> {
        self.executor.execute_with_details(robot, spec)
    }

    fn backtrace(
        &self,
        robot: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, InfrastructureError> {
        self.executor.backtrace(robot, file, spec, fault)
    }

    fn profile(
        &self,
        robot: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        played: &DetailedMatch,
    ) -> Result<Result<Profile, String>, InfrastructureError> {
        self.executor.profile(robot, file, spec, played)
    }
}

/// The seed with which playing panics.
const BUG: u64 = 5;

/// Every match that could not be played, or was not because of a withdrawal.
#[derive(Default)]
struct Missing {
    played: u64,
    failed: Vec<MatchFailure>,
    withdrawn: Vec<MatchFailure>,
}

impl Sink for Missing {
    fn played(&mut self, _: &wasmouse::contest::ContestMatch) -> std::io::Result<()> {
        self.played += 1;
        Ok(())
    }

    fn failed(&mut self, failure: &MatchFailure) -> std::io::Result<()> {
        self.failed.push(failure.clone());
        Ok(())
    }

    fn withdrawn(&mut self, failure: &MatchFailure) -> std::io::Result<()> {
        self.withdrawn.push(failure.clone());
        Ok(())
    }
}

/// Plays robots in ten mazes on one thread, and returns what is missing and the order.
fn play(executor: Box<dyn Executor>, robots: &[&[u8]], seeds: Seeds) -> (Missing, Vec<Digest>) {
    let executor = Noting {
        executor,
        order: Mutex::default(),
    };
    let entrants = robots.iter().map(|file| {
        let robot = executor.admit(file).expect("the host works");
        Entrant {
            name: "robot".into(),
            digest: Digest::of(file),
            variant: 0,
            admission: Ok(Arc::new(robot.unwrap_or_else(|it| panic!("{it}")))),
        }
    });
    let mazes = generated_mazes("gen:tree:12:1..=10");
    let plan = Plan {
        entrants: entrants.collect(),
        mazes: mazes
            .map(|(name, maze)| MazeSource::Loaded {
                name: name.into(),
                maze,
            })
            .collect(),
        seeds,
        rules: rules(SandboxLimits::default()),
    };
    let options = Options {
        jobs: 1,
        cancelled: &AtomicBool::new(false),
        wanted: &|_| true,
        ended: &|_, _| Ok(()),
        robot_time: None,
    };
    let (mut missing, mut summary) = (Missing::default(), SummaryBuilder::new());
    let mut sink = Tee(vec![&mut missing, &mut summary]);
    run(&plan, &executor, &options, &mut sink).expect("a contest");
    let order = executor.order.into_inner();
    (missing, order.unwrap_or_else(PoisonError::into_inner))
}

fn in_process(control: Control) -> Box<dyn Executor> {
    let executor = InProcess::new(Limits::default(), 1, None).expect("address space");
    Box::new(executor.with_control(control))
}

/// The slow robot begins, and then waits until the other one has played everything.
#[test]
fn a_slow_robot_plays_last() {
    let flood = find("flood").expect("a bundled robot").component;
    let chaser = pointer_chaser();
    let control = Control {
        match_time: SECOND,
        ..Control::default()
    };
    let (missing, order) = play(
        in_process(control),
        &[&chaser, flood],
        Seeds { first: 0, count: 1 },
    );
    let [chaser, flood] = [&chaser[..], flood].map(Digest::of);
    assert_eq!(order[0], chaser);
    assert_eq!(order[1..=10], [flood; 10]);
    assert_eq!(missing.played, 10);
    // Some match was played for a second time; no third one was begun.
    assert_eq!(missing.failed.len() + missing.withdrawn.len(), 10);
    assert!(missing.withdrawn.len() >= 9, "{:?}", missing.withdrawn);
}

/// A bug that a match brings about costs that match.
#[test]
fn a_panic_costs_one_match() {
    let flood = find("flood").expect("a bundled robot").component;
    let seeds = Seeds {
        first: BUG - 1,
        count: 3,
    };
    let (missing, _) = play(in_process(Control::default()), &[flood], seeds);
    assert_eq!((missing.played, missing.failed.len()), (20, 10));
    for failure in missing.failed {
        assert_eq!(failure.key.seed, BUG);
        assert_eq!(failure.reason, "wasmouse panicked, which is a bug");
    }
}

/// The supervisor measures by itself, whatever its workers do.
#[test]
fn cancelling_ends_matches_in_progress() {
    let control = Control::default();
    let options = wasmouse_engine::sandbox::WorkerOptions {
        executable: wasmouse_engine::sandbox::Executable::at(WORKER),
        patience: wasmouse_engine::sandbox::PATIENCE,
        require_sandbox: false,
        control: control.clone(),
    };
    let rules = rules(SandboxLimits::default());
    let workers = Sandboxed::new(Arc::clone(&rules), Limits::default(), options, None);
    let workers: Box<dyn Executor> = Box::new(workers.expect("a worker starts"));
    let (_, maze) = generated_mazes("gen:tree:12:1").next().expect("one maze");
    let file = pointer_chaser();
    let executors = [workers, in_process(control.clone())];
    let robots = [&executors[0], &executors[1]].map(|executor| {
        let robot = executor.admit(&file).expect("the host works");
        robot.unwrap_or_else(|it| panic!("{it}"))
    });
    let began = Instant::now();
    std::thread::scope(|scope| {
        for (executor, robot) in executors.iter().zip(&robots) {
            let spec = crate::matches::spec(&rules, robot.digest(), &maze, (0, 0));
            scope.spawn(move || {
                let flow = executor.execute(robot, &[spec], &mut |_, played| {
                    panic!("it ended: {played:?}");
                });
                assert_eq!(flow, ControlFlow::Break(()));
            });
        }
        std::thread::sleep(2 * SECOND);
        control.cancel.set();
    });
    assert!(began.elapsed() < 20 * SECOND);
    for robot in &robots {
        let account = robot.account();
        assert!(account.used() > Duration::ZERO);
        account.set_budget(Duration::from_nanos(1));
        let spent = Withdrawal::Spent { seconds: 0 };
        assert_eq!(account.withdrawal(), Some(spent));
    }
    let refused = executors[0].admit(&file).err().expect("it was cancelled");
    assert!(
        matches!(refused, InfrastructureError::Cancelled),
        "{refused}"
    );
}

/// A worker may do its work in a process that it has started, whose time counts too.
#[test]
fn the_time_of_an_inner_process_counts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let script = folder.path().join("worker");
    // The shell waits for the real worker.
    let text = format!("#!/bin/sh\n'{WORKER}' \"$@\"\nexit $?\n");
    fs::write(&script, text).expect("a file");
    let executable = fs::Permissions::from_mode(0o755);
    fs::set_permissions(&script, executable).expect("its own file");
    let executor = sandboxed(&script, None).expect("a worker starts");
    let (_, maze) = generated_mazes("gen:tree:12:1").next().expect("one maze");
    let robot = executor.admit(&pointer_chaser()).expect("the host works");
    let robot = robot.unwrap_or_else(|it| panic!("{it}"));
    robot.account().set_budget(SECOND);
    let rules = rules(SandboxLimits::default());
    let spec = crate::matches::spec(&rules, robot.digest(), &maze, (0, 0));
    let mut outcomes = Vec::new();
    let _ = executor.execute(&robot, &[spec], &mut |_, played| {
        outcomes.push(played.map(|it| it.record));
        ControlFlow::Continue(())
    });
    let [Err(InfrastructureError::Withdrawn(reason))] = &outcomes[..] else {
        panic!("{outcomes:?}");
    };
    assert_eq!(*reason, Withdrawal::Spent { seconds: 1 });
    assert!(robot.account().used() >= SECOND);
}
