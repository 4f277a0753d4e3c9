//! Robots in worker processes: the same results as in this process, whatever happens to the
//! workers.

#[cfg(target_os = "linux")]
use std::ffi::OsStr;
#[cfg(unix)]
use std::fs;
use std::ops::ControlFlow;
#[cfg(target_os = "linux")]
use std::path::Path;
#[cfg(target_os = "linux")]
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::thread;
use std::time::Duration;
#[cfg(target_os = "linux")]
use std::time::Instant;

use wasmouse_core::game::SandboxLimits;
use wasmouse_core::maze::Maze;
#[cfg(target_os = "linux")]
use wasmouse_core::maze::{Cell, Heading, Walls};
use wasmouse_core::record::{MatchRecord, MatchSpec};
#[cfg(target_os = "linux")]
use wasmouse_engine::AdmittedRobot;
use wasmouse_engine::admission::{Rejection, componentize};
use wasmouse_engine::bundled::find;
use wasmouse_engine::sandbox::{Executable, WorkerOptions};
use wasmouse_engine::{
    Control, Executor, Frame, InProcess, InfrastructureError, Limits, Sandboxed,
};
#[cfg(target_os = "linux")]
use wasmouse_tests::program::{Program, signal};

#[cfg(target_os = "linux")]
use crate::binary;
use crate::hostile::{Engine, Module, wasm};
use crate::matches::{WORKER, generated_mazes, rules, sandboxed, spec};

/// Seeds before whose matches the worker fails; see `tests/bin/faulty_worker.rs`.
const CRASH: u64 = 901;
const CRASH_LATER: u64 = 902;
const HANG: u64 = 903;
const LEAVE: u64 = 904;

fn workers() -> Sandboxed {
    sandboxed(WORKER, None).expect("a worker starts")
}

fn in_process() -> InProcess {
    InProcess::new(Limits::default(), 4, None).expect("address space")
}

/// The outcome of a match with that seed.
type Outcome = (u64, Result<MatchRecord, InfrastructureError>);

/// Plays the bundled robots in these mazes with these seeds, each robot on a thread of its own.
fn play(
    executor: &dyn Executor,
    mazes: &[Arc<Maze>],
    robots: &[&str],
    seeds: &[u64],
) -> Vec<Outcome> {
    let play = |name: &str| {
        let component = find(name).expect("a bundled robot").component;
        let robot = executor.admit(component).expect("the host works");
        let robot = robot.expect("a bundled robot");
        let rules = rules(SandboxLimits::default());
        let specs = mazes.iter().flat_map(|maze| {
            let digest = robot.digest();
            let spec = |seed: &u64| spec(&rules, digest, maze, (0, *seed));
            seeds.iter().map(spec).collect::<Vec<_>>()
        });
        let specs: Vec<MatchSpec> = specs.collect();
        let mut outcomes = Vec::new();
        let flow = executor.execute(&robot, &specs, &mut |spec, played| {
            let record = played.map(|it| {
                assert_eq!(it.record.key, spec.key);
                assert_eq!(it.record.transcript, it.transcript.digest());
                it.record
            });
            outcomes.push((spec.key.seed, record));
            ControlFlow::Continue(())
        });
        assert_eq!(
            (flow, outcomes.len()),
            (ControlFlow::Continue(()), specs.len())
        );
        outcomes
    };
    let play = &play;
    thread::scope(|scope| {
        let robots = robots.iter();
        let threads: Vec<_> = robots.map(|it| scope.spawn(move || play(it))).collect();
        let outcomes = threads.into_iter().map(|it| it.join().expect("outcomes"));
        outcomes.flatten().collect()
    })
}

fn mazes() -> Vec<Arc<Maze>> {
    let mazes = generated_mazes("gen:braid:12:1..=10");
    mazes.map(|(_, maze)| maze).collect()
}

#[test]
fn workers_give_the_same_results() {
    let robots = ["flood", "random", "minnett", "dfs"];
    let here = play(&in_process(), &mazes(), &robots, &[0, 1]);
    let there = play(&workers(), &mazes(), &robots, &[0, 1]);
    assert_eq!(records(here, None), records(there, None));
}

/// The records of all matches but those with that seed.
fn records(outcomes: Vec<Outcome>, without: Option<u64>) -> Vec<MatchRecord> {
    let others = outcomes.into_iter().filter(|it| Some(it.0) != without);
    others.map(|it| it.1.expect("it was played")).collect()
}

/// Plays with workers that fail at one of the seeds, requires that all other matches are not
/// affected, and returns the outcomes of that seed.
#[track_caller]
fn outcomes_of(seed: u64, robots: &[&str]) -> Vec<Result<MatchRecord, InfrastructureError>> {
    let expected = play(&in_process(), &mazes(), robots, &[0, 1]);
    let played = play(&workers(), &mazes(), robots, &[0, seed, 1]);
    let (of_seed, others): (Vec<Outcome>, Vec<Outcome>) =
        played.into_iter().partition(|it| it.0 == seed);
    assert_eq!(records(others, None), records(expected, None));
    assert_eq!(of_seed.len(), 10 * robots.len());
    of_seed.into_iter().map(|it| it.1).collect()
}

#[test]
fn a_crash_that_repeats_alone_is_the_robots_fault() {
    for outcome in outcomes_of(CRASH, &["flood", "dfs"]) {
        let verdict = outcome.expect("a verdict").verdict;
        let fault = verdict.fault().expect("a fault");
        assert_eq!(fault.kind.name(), "crash");
        assert!(fault.detail.raw().contains("SIGABRT"), "{fault:?}");
    }
}

#[test]
fn a_crash_that_does_not_repeat_alone_is_nobodys_fault() {
    let outcomes = outcomes_of(CRASH_LATER, &["flood"]);
    let expected = play(&in_process(), &mazes(), &["flood"], &[CRASH_LATER]);
    let outcomes = outcomes.into_iter().map(|it| (CRASH_LATER, it)).collect();
    assert_eq!(records(outcomes, None), records(expected, None));
}

#[test]
fn a_worker_that_exits_is_an_infrastructure_error() {
    for outcome in outcomes_of(LEAVE, &["flood"]) {
        let error = outcome.expect_err("it was not played").to_string();
        assert_eq!(error, "run worker failed: exit status: 0");
    }
}

#[test]
fn a_worker_that_hangs_is_an_infrastructure_error() {
    let options = WorkerOptions {
        executable: Executable::at(WORKER),
        patience: Duration::from_secs(1),
        require_sandbox: false,
        control: Control::default(),
    };
    let rules = rules(SandboxLimits::default());
    let executor = Sandboxed::new(rules, Limits::default(), options, None);
    let executor = executor.expect("a worker starts");
    // One robot and few matches: each waits for the deadline twice.
    let played = play(&executor, &mazes()[..1], &["flood"], &[0, HANG, 1]);
    let error = played[1].1.as_ref().expect_err("it was not played");
    assert!(
        matches!(error, InfrastructureError::Stalled { seconds: 1 }),
        "{error}"
    );
    assert_eq!(records(played, Some(HANG)).len(), 2);
}

/// A robot that has taken over its worker has no other robot there.
#[cfg(target_os = "linux")]
#[test]
fn a_worker_runs_one_robot() {
    let program = Program::new(Path::new(WORKER)).expect("a folder beside the worker");
    let executor = sandboxed(program.folder().join("wasmouse"), None).expect("a worker starts");
    // A worker may consist of two processes.
    let of_one = program.processes().len();
    assert!(of_one > 0);
    for round in 0..2 {
        for (played, robot) in ["flood", "dfs", "random"].into_iter().enumerate() {
            play(&executor, &mazes()[..1], &[robot], &[0]);
            let expected = if round == 0 { played + 1 } else { 3 };
            // What a compile worker has started ends a moment after it.
            let deadline = Instant::now() + Duration::from_secs(30);
            while program.processes().len() != expected * of_one && Instant::now() < deadline {
                thread::sleep(Duration::from_millis(5));
            }
            assert_eq!(program.processes().len(), expected * of_one, "{robot}");
        }
    }
}

/// Stopped from outside, so that it does not read what does not fit into the pipe.
#[cfg(target_os = "linux")]
#[test]
fn a_worker_that_stops_reading_is_killed() {
    let program = Program::new(Path::new(WORKER)).expect("a folder beside the worker");
    let options = WorkerOptions {
        executable: Executable::at(program.folder().join("wasmouse")),
        patience: Duration::from_secs(2),
        require_sandbox: false,
        control: Control::default(),
    };
    let rules = rules(SandboxLimits::default());
    let executor = Sandboxed::new(Arc::clone(&rules), Limits::default(), options, None);
    let executor = executor.expect("a worker starts");
    let flood = find("flood").expect("a bundled robot").component;
    // 4 KB each: more than a pipe holds.
    let mazes: Vec<Arc<Maze>> = (0..64)
        .map(|x| {
            let mut walls = Walls::closed(64);
            walls.set(Cell::new(x, 0), Heading::Up, true);
            Arc::new(Maze::contest(walls).expect("start and goal fit"))
        })
        .collect();
    let play = |executor: &dyn Executor, mazes: &[Arc<Maze>], robot: &AdmittedRobot| {
        let specs = mazes
            .iter()
            .map(|it| spec(&rules, robot.digest(), it, (0, 0)));
        let specs: Vec<MatchSpec> = specs.collect();
        let mut outcomes = Vec::new();
        let _ = executor.execute(robot, &specs, &mut |_, played| {
            outcomes.push(played.map(|it| it.record));
            ControlFlow::Continue(())
        });
        outcomes
    };
    let admit = |executor: &dyn Executor| {
        let robot = executor.admit(flood).expect("the host works");
        robot.expect("a bundled robot")
    };
    let robot = admit(&executor);
    play(&executor, &mazes[..1], &robot)[0]
        .as_ref()
        .expect("the worker works");
    for process in program.processes() {
        signal(process, "STOP");
    }
    let outcomes = play(&executor, &mazes, &robot);
    let here = in_process();
    let expected = play(&here, &mazes, &admit(&here));
    let records = |outcomes: Vec<Result<MatchRecord, InfrastructureError>>| {
        let records = outcomes.into_iter().map(|it| it.expect("it was played"));
        records.collect::<Vec<_>>()
    };
    assert_eq!(records(outcomes), records(expected));
}

/// The number of threads that compile does not depend on the number of cores.
#[cfg(target_os = "linux")]
#[test]
fn a_compile_worker_has_the_same_threads_everywhere() {
    let program = Program::new(&binary::path()).expect("a folder beside the binary");
    let functions: String = (0..3000)
        .map(|number| {
            let step = format!("(global.set $g (i32.xor (global.get $g) (i32.const {number})))");
            format!("(func {})", step.repeat(40))
        })
        .collect();
    let rest = format!("(global $g (mut i32) (i32.const 0)) {functions}");
    let robot = Module {
        rest: &rest,
        ..Module::default()
    };
    let file = program.folder().join("large.wasm");
    fs::write(&file, robot.component()).expect("a file");
    let path = program.folder().join("wasmouse");
    let threads = |prefix: &[&str]| {
        let mut words = prefix
            .iter()
            .map(AsRef::<OsStr>::as_ref)
            .chain([path.as_os_str()]);
        let mut command = Command::new(words.next().expect("a program"));
        command
            .args(words)
            .args(["inspect", "--no-cache", "--json"])
            .arg(&file);
        let mut child = command.stdout(Stdio::piped()).spawn().expect("it starts");
        let mut most = 0;
        while child.try_wait().expect("its own child").is_none() {
            for process in program.processes() {
                let folder = format!("/proc/{process}");
                let line = fs::read_to_string(format!("{folder}/cmdline")).unwrap_or_default();
                if line.ends_with("compile\0") {
                    let threads = fs::read_dir(format!("{folder}/task")).map_or(0, Iterator::count);
                    most = most.max(threads);
                }
            }
            thread::sleep(Duration::from_millis(1));
        }
        let output = child.wait_with_output().expect("it ended");
        assert!(output.status.success());
        (most, output.stdout)
    };
    let (everywhere, report) = threads(&[]);
    // The first one, the one that reads the file, and two that compile.
    assert_eq!(everywhere, 4);
    if Command::new("taskset").arg("-V").output().is_err() {
        println!("skipped: there is no `taskset`");
        return;
    }
    let (on_one_core, same_report) = threads(&["taskset", "-c", "0"]);
    assert_eq!(on_one_core, 4);
    assert!(same_report == report, "the report depends on the cores");
}

/// Modules that are never instantiated and need more than the pool has: the engine does not load
/// them, which is about this file and not about the host.
#[test]
fn code_that_does_not_load_is_a_rejection() {
    let memories = format!("(module {})", "(memory 1)".repeat(9));
    let tables = format!("(module {})", "(table 1 funcref)".repeat(17));
    let modules = [
        &memories,
        &tables,
        "(module (table 100001 funcref))",
        "(module (memory 65536))",
    ];
    let (here, there) = (in_process(), workers());
    for text in modules {
        let module = wasm(text);
        let length = u8::try_from(module.len()).expect("a short module");
        assert!(length < 128, "its length is one byte");
        let mut file = Module::default().component();
        file.extend([1, length]);
        file.extend(module);
        let [here, there] = [&here as &dyn Executor, &there].map(|executor| {
            let inspection = executor.inspect(&file).expect("the host works");
            let admission = executor.admit(&file).expect("the host works");
            let rejection = admission.err().expect("it cannot be loaded");
            let inspected = inspection.rejection.expect("it cannot be loaded");
            assert_eq!(inspected.to_string(), rejection.to_string());
            rejection
        });
        assert_eq!(here.name(), there.name(), "{text}: {here}; {there}");
    }
    let played = play(&there, &mazes()[..1], &["flood"], &[0]);
    assert_eq!(records(played, None).len(), 1);
}

/// Another version of wasmouse, or another program, is not trusted.
#[cfg(unix)]
#[test]
fn a_worker_of_another_build_is_not_used() {
    for (program, expected) in [
        ("/bin/cat", "run worker failed: "),
        ("/bin/false", "run worker failed: "),
        ("/nonexistent", "run worker failed: No such file"),
    ] {
        let error = sandboxed(program, None).err().expect("not a worker");
        assert!(error.to_string().starts_with(expected), "{error}");
    }
}

/// Killed by somebody else before it has sent anything.
#[cfg(unix)]
#[test]
fn a_worker_that_is_killed_as_it_starts_is_started_again() {
    use std::os::unix::fs::PermissionsExt as _;

    let folder = tempfile::tempdir().expect("a temporary folder");
    let (script, mark) = (folder.path().join("worker"), folder.path().join("killed"));
    let text = format!(
        "#!/bin/sh\nif [ ! -e '{mark}' ]; then : > '{mark}'; kill -9 $$; fi\n\
         exec '{WORKER}' \"$@\"\n",
        mark = mark.display(),
    );
    fs::write(&script, text).expect("a file");
    let executable = fs::Permissions::from_mode(0o755);
    fs::set_permissions(&script, executable).expect("its own file");
    sandboxed(&script, None).expect("the second worker works");
    assert!(mark.exists(), "one was killed");
}

#[test]
fn rejections_are_the_same_in_workers() {
    let (here, there) = (in_process(), workers());
    let foreign = Module {
        imports: r#"(import "env" "f" (func))"#,
        ..Module::default()
    };
    let files: [&[u8]; 6] = [
        b"",
        b"(module)",
        b"\x7fELF rest",
        b"\0asm\x0d\0\x01\0\xff",
        &foreign.core(),
        &wasm("(component)"),
    ];
    for file in files {
        let rejection = |executor: &dyn Executor| {
            let admission = executor.admit(file).expect("the host works");
            let inspection = executor.inspect(file).expect("the host works");
            let rejections = [admission.err(), inspection.rejection];
            rejections.map(|it| {
                let it: Rejection = it.expect("it is not a robot");
                (
                    it.name().raw().to_owned(),
                    it.reason(),
                    it.hint().raw().to_owned(),
                )
            })
        };
        assert_eq!(rejection(&there), rejection(&here));
    }
}

/// The backtrace of a robot that fails, the same in workers as in this process.
fn backtrace(bytes: &[u8]) -> Vec<Frame> {
    let (_, maze) = generated_mazes("gen:braid:12:1").next().expect("one maze");
    let rules = rules(SandboxLimits::default());
    let executors: [&dyn Executor; 2] = [&in_process(), &workers()];
    let [here, there] = executors.map(|executor| {
        let robot = executor.admit(bytes).expect("the host works");
        let robot = robot.unwrap_or_else(|rejection| panic!("rejected: {rejection}"));
        let spec = spec(&rules, robot.digest(), &maze, (0, 0));
        let played = executor.execute_with_details(&robot, &spec);
        let verdict = played.expect("the host works").record.verdict;
        let fault = verdict.fault().expect("a fault");
        let frames = executor.backtrace(&robot, bytes, &spec, fault);
        frames.expect("the host works").expect("the same fault")
    });
    assert_eq!(here, there);
    there
}

/// Functions are named, and names of any length and kind are only text.
#[test]
fn a_backtrace_names_the_functions() {
    let hostile = format!("{}\u{1b}[31m", "x".repeat(10_000));
    let robot = Module {
        rest: &format!(
            "(func $inner (@name \"plan\") unreachable)
             (func $outer (@name {hostile:?}) call $inner)"
        )
        .replace("\\u{1b}", "\\1b"),
        next: "call $outer i32.const 16",
        ..Module::default()
    };
    let frames = backtrace(&robot.component());
    let functions: Vec<&str> = frames.iter().map(|it| it.function.raw()).collect();
    assert_eq!(functions[0], "plan");
    assert_eq!(functions[1], "x".repeat(160));
    assert_eq!(functions.len(), 3, "{functions:?}");
}

/// With debug information also source lines, whatever else that information says.
#[test]
fn a_backtrace_has_source_lines() {
    let text = Module {
        rest: "(func $inner unreachable)",
        next: "call $inner i32.const 16",
        ..Module::default()
    };
    let module = text.core_with_lines("src/robot.wat");
    let robot = componentize(&module).expect("a robot");
    let frames = backtrace(&robot);
    let line_of = |what: &str| text.wat().lines().position(|line| line.contains(what));
    for (frame, what) in frames.iter().zip(["unreachable", "call $inner"]) {
        let line = line_of(what).expect("it is in the text") + 1;
        let source = frame.source.as_ref().map_or("", |it| it.raw());
        assert!(
            source.starts_with(&format!("src/robot.wat:{line}:")),
            "{frames:?}"
        );
    }
    assert_eq!(frames[0].function, "inner");

    // Any byte of the debug information may be anything.
    let sections = [".debug_info", ".debug_abbrev", ".debug_line", ".debug_str"];
    let places = sections.iter().filter_map(|name| {
        let found = robot
            .windows(name.len())
            .position(|it| it == name.as_bytes());
        Some(found? + name.len())
    });
    let mut tried = 0;
    for place in places {
        for (at, byte) in (place..place + 60)
            .step_by(7)
            .zip([0, 0xff, 0x7f, 0x80].into_iter().cycle())
        {
            let mut broken = robot.clone();
            broken[at] = byte;
            // Where debug information ends, other sections may begin.
            if Engine::new(Limits::default()).admit(&broken).is_ok() {
                let found = backtrace(&broken).len();
                assert_eq!(found, frames.len(), "byte {at} is {byte}");
                tried += 1;
            }
        }
    }
    assert!(tried > 20, "{tried}");
}
