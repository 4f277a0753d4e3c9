//! Robots in worker processes: the same results as in this process, whatever happens to
//! the workers.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use wasmouse::contest::{Contest, ContestMaze, Entrant, Played};
use wasmouse::maze::generate::GenSpec;
use wasmouse::robot::bundled::find;
use wasmouse::robot::componentize::componentize;
use wasmouse::robot::{
    Digest, Executable, Frame, Game, HostError, Isolation, PATIENCE, Recorder, Referee, Trust,
    Verdict, Workers,
};
use wasmouse::sim::Ruleset;

use crate::binary;
use crate::hostile::{Module, assert_unharmed, host};

/// A referee whose workers are that program.
fn referee(executable: Executable, patience: Duration) -> Referee {
    let workers = Workers {
        executable,
        patience,
        require_sandbox: false,
    };
    Referee::new(Ruleset::default(), 2, None, Isolation::Workers(workers))
}

fn real() -> Referee {
    referee(Executable::at(binary::path()), PATIENCE)
}

/// A referee whose workers go wrong at certain seeds; see `tests/bin/faulty_worker.rs`.
fn faulty(patience: Duration) -> Referee {
    let program = Executable::at(env!("CARGO_BIN_EXE_faulty-worker"));
    referee(program, patience)
}

const CRASH: u64 = 901;
const CRASH_LATER: u64 = 902;
const HANG: u64 = 903;
const LEAVE: u64 = 904;

/// The bundled robots in ten mazes, with those seeds.
fn contest(referee: &Referee, trust: Trust, robots: &[&str], seeds: &[u64]) -> Contest {
    let rules = Ruleset::default();
    let entrants = robots.iter().map(|name| {
        let component = find(name).expect("a bundled robot").component;
        let admission = referee.admit(component, trust).expect("the host works");
        Entrant {
            name: (*name).to_owned(),
            digest: Digest::of(component),
            setting: 0,
            admission: admission.map(Arc::new).map_err(Arc::new),
        }
    });
    let mazes: GenSpec = "gen:braid:12:1..=10".parse().expect("a specification");
    Contest {
        entrants: entrants.collect(),
        mazes: mazes
            .expand()
            .map(|(name, maze)| ContestMaze::new(name, maze, &rules))
            .collect(),
        seeds: seeds.to_vec(),
        rules,
    }
}

fn play(contest: &Contest, referee: &Referee, threads: usize) -> Played {
    contest
        .run(referee, threads, &AtomicBool::new(false), &|| ())
        .expect("there are threads")
}

/// The results of robots that run in this process.
fn expected(robots: &[&str], seeds: &[u64]) -> Played {
    let referee = Referee::new(Ruleset::default(), 1, None, Isolation::None);
    let contest = contest(&referee, Trust::Trusted, robots, seeds);
    play(&contest, &referee, 1)
}

#[test]
fn workers_give_the_same_results() {
    let robots = ["flood", "random", "minnett", "dfs"];
    let expected = expected(&robots, &[0, 1]);
    let referee = real();
    let contest = contest(&referee, Trust::Stranger, &robots, &[0, 1]);
    for threads in [1, 3] {
        let played = play(&contest, &referee, threads);
        assert_eq!(played.results, expected.results, "{threads} threads");
        assert!(played.failed.is_empty());
    }
}

/// Plays with workers that go wrong at one of the seeds, and requires that everything
/// else is as ever.
#[track_caller]
fn check_rest(seed: u64, patience: Duration, robots: &[&str]) -> Played {
    let expected = expected(robots, &[0, seed, 1]);
    let referee = faulty(patience);
    let contest = contest(&referee, Trust::Stranger, robots, &[0, seed, 1]);
    let played = play(&contest, &referee, 2);
    let others = |played: &Played| {
        let results = played.results.iter();
        let others: Vec<_> = results.filter(|it| it.seed != seed).cloned().collect();
        others
    };
    assert_eq!(others(&played), others(&expected));
    assert_eq!(
        played.results.len() + played.failed.len(),
        contest.matches()
    );
    played
}

#[test]
fn a_robot_is_blamed_for_a_crash_that_repeats_alone() {
    let played = check_rest(CRASH, PATIENCE, &["flood", "dfs"]);
    let crashed = played.results.iter().filter(|it| it.seed == CRASH);
    let mut count = 0;
    for result in crashed {
        count += 1;
        let Verdict::Fault(fault) = &result.outcome.verdict else {
            panic!("{:?}", result.outcome.verdict);
        };
        assert_eq!(fault.kind.name(), "crash");
        assert!(fault.to_string().contains("SIGABRT"), "{fault}");
    }
    assert_eq!(count, 20);
}

#[test]
fn a_crash_that_does_not_repeat_alone_is_nobodys_fault() {
    let played = check_rest(CRASH_LATER, PATIENCE, &["flood", "dfs"]);
    assert_eq!(
        played.results,
        expected(&["flood", "dfs"], &[0, CRASH_LATER, 1]).results
    );
}

#[test]
fn a_worker_that_stands_still_is_a_failure_of_the_host() {
    // One robot and few matches: each waits for the clock twice.
    let referee = faulty(Duration::from_secs(1));
    let mut contest = contest(&referee, Trust::Stranger, &["flood"], &[0, HANG, 1]);
    contest.mazes.truncate(1);
    let played = play(&contest, &referee, 2);
    assert_eq!(played.results.len(), 2);
    let [failed] = &played.failed[..] else {
        panic!("{:?}", played.failed);
    };
    assert_eq!(failed.seed, HANG);
    assert!(
        matches!(failed.error, HostError::Stalled),
        "{}",
        failed.error
    );
}

#[test]
fn a_worker_that_leaves_is_a_failure_of_the_host() {
    let played = check_rest(LEAVE, PATIENCE, &["flood"]);
    assert_eq!(played.failed.len(), 10);
    let error = played.failed[0].error.to_string();
    assert!(error.contains("exit status: 0"), "{error}");
}

/// Another version of wasmouse, or no wasmouse at all, is not believed.
#[test]
fn a_worker_of_another_build_is_refused() {
    for (program, expected) in [
        ("/bin/cat", "the worker that should play failed"),
        ("/bin/false", "the worker that should play failed"),
        ("/nonexistent", "No such file"),
    ] {
        let referee = referee(Executable::at(program), PATIENCE);
        let flood = find("flood").expect("a bundled robot").component;
        match referee.admit(flood, Trust::Stranger) {
            Err(error) => assert!(error.to_string().contains(expected), "{error}"),
            Ok(_) => panic!("{program} is a worker"),
        }
    }
}

/// Killed by somebody else before it has said anything: that is no reason to end.
#[cfg(unix)]
#[test]
fn a_worker_that_is_killed_as_it_starts_is_started_again() {
    use std::os::unix::fs::PermissionsExt as _;

    let folder = tempfile::tempdir().expect("a temporary folder");
    let (script, mark) = (folder.path().join("worker"), folder.path().join("killed"));
    let text = format!(
        "#!/bin/sh\nif [ ! -e '{mark}' ]; then : > '{mark}'; kill -9 $$; fi\nexec '{}' \"$@\"\n",
        binary::path().display(),
        mark = mark.display(),
    );
    std::fs::write(&script, text).expect("a file");
    std::fs::set_permissions(&script, std::fs::Permissions::from_mode(0o755))
        .expect("its own file");
    let referee = referee(Executable::at(&script), PATIENCE);
    let flood = find("flood").expect("a bundled robot").component;
    let player = referee
        .admit(flood, Trust::Stranger)
        .expect("the host works");
    assert!(player.is_ok(), "it is a robot");
    assert!(mark.exists(), "one was killed");
}

#[test]
fn refusals_are_the_same_in_workers() {
    let referee = real();
    let inside = host(Ruleset::default().limits);
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
        &crate::hostile::wasm("(component)"),
    ];
    for file in files {
        let there = referee
            .admit(file, Trust::Stranger)
            .expect("the host works");
        let (Err(here), Err(there)) = (inside.admit(file), there) else {
            panic!("admitted: {file:?}");
        };
        let all = |it: &wasmouse::robot::Refusal| {
            (it.name().to_owned(), it.to_string(), it.hint().to_owned())
        };
        assert_eq!(all(&there), all(&here));
    }
    assert_unharmed(&inside);
}

/// Where a robot fails; the same in workers as in this process.
fn explained(bytes: &[u8]) -> Vec<Frame> {
    let mazes: GenSpec = "gen:braid:12:1".parse().expect("a specification");
    let (_, maze) = mazes.expand().next().expect("one maze");
    let rules = Ruleset::default();
    let game = Game {
        maze: &maze,
        rules: &rules,
        seed: 0,
        setting: 0,
    };
    let referee = real();
    let [here, there] = [Trust::Trusted, Trust::Stranger].map(|trust| {
        let player = referee.admit(bytes, trust).expect("the host works");
        let player = player.unwrap_or_else(|refusal| panic!("refused: {refusal}"));
        let mut recorder = Recorder::default();
        let outcome = referee.record(&player, &game, &mut recorder);
        let Verdict::Fault(fault) = outcome.expect("the host works").verdict else {
            panic!("no fault");
        };
        let frames = referee.explain(&player, bytes, &game, &fault);
        frames.expect("the host works").expect("the same fault")
    });
    assert_eq!(here, there);
    there
}

/// Where a robot fails is told in names, in workers as in this process, and names of any
/// length and kind are only text.
#[test]
fn faults_are_explained_by_the_calls_in_progress() {
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
    let frames = explained(&robot.component());
    let functions: Vec<&str> = frames.iter().map(|it| it.function.as_str()).collect();
    assert_eq!(functions[0], "plan");
    assert_eq!(functions[1], "x".repeat(160));
    assert_eq!(functions.len(), 3, "{functions:?}");
}

/// With debug information also in source lines, whatever else that information says.
#[test]
fn faults_are_explained_in_source_lines() {
    let text = Module {
        rest: "(func $inner unreachable)",
        next: "call $inner i32.const 16",
        ..Module::default()
    };
    let module = text.core_with_lines("src/robot.wat");
    let robot = componentize(&module).expect("a robot");
    let frames = explained(&robot);
    let line_of = |what: &str| text.wat().lines().position(|line| line.contains(what));
    for (frame, what) in frames.iter().zip(["unreachable", "call $inner"]) {
        let line = line_of(what).expect("it is in the text") + 1;
        let source = frame.source.as_deref().unwrap_or_default();
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
            if host(Ruleset::default().limits).admit(&broken).is_ok() {
                assert_eq!(
                    explained(&broken).len(),
                    frames.len(),
                    "byte {at} is {byte}"
                );
                tried += 1;
            }
        }
    }
    assert!(tried > 20, "{tried}");
}
