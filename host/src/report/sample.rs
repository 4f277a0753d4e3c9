//! Results for the tests of reports: every kind of verdict, untrusted text, and a contest that
//! was interrupted.

use wasmouse_core::Digest;
use wasmouse_core::game::{Counts, Fault, FaultKind, Phase, Ruleset, Run, Score, Steps, Verdict};
use wasmouse_core::journal::JournalCounts;
use wasmouse_core::maze::Cell;
use wasmouse_core::record::{EngineId, FuelUse, MatchKey, MatchRecord, RecordVersion};

use crate::contest::{
    ContestInfo, MatchFailure, MazeEntry, RESULTS_VERSION, RejectionEntry, Results, RobotEntry,
    Seeds, Standing, Standings, Summary, WithdrawalEntry, records_digest,
};

/// Text that controls a terminal, ends a string, a line and an element.
pub(super) const HOSTILE: &str = "<b>\u{1b}[31m\u{9b}\"\\\n\r\u{2028}\u{202e}\u{e0041}\u{1f9ff}";

/// The verdicts of the matches, which are the robots `a` and [`HOSTILE`] by turns.
fn verdicts() -> [Verdict; 4] {
    let fault = Fault {
        kind: FaultKind::Panic,
        phase: Phase::NextMove,
        run: Run::Exploration,
        step: 5,
        cell: Cell::new(0, 3),
        detail: format!("panicked: {HOSTILE}").into(),
    };
    [
        Verdict::Finished {
            score: Score::new(17, 110, 30),
        },
        Verdict::Fault { fault },
        Verdict::BudgetUsedUp { goal_reached: true },
        Verdict::BudgetUsedUp {
            goal_reached: false,
        },
    ]
}

/// The results of a contest of three robots, of which one was rejected, in 2 of 200 mazes.
pub(super) fn results() -> Results {
    let robots = ["a", HOSTILE, "rejected"].map(|name| RobotEntry {
        name: name.into(),
        digest: Digest::of(name.as_bytes()),
        variant: 0,
        rejection: (name == "rejected").then(|| RejectionEntry {
            kind: "unknown-import".into(),
            reason: format!("it imports {HOSTILE}").into(),
            hint: "build it without".into(),
        }),
        failure: None,
    });
    let mazes = ["test_maze_01", HOSTILE].map(|name| MazeEntry {
        name: name.into(),
        digest: Digest::of(name.as_bytes()),
        dimension: 12,
        oracle: (name != HOSTILE).then(|| Score::new(17, 18, 30)),
    });
    let engine = EngineId::new("wasmtime-1");
    let rules = Ruleset::default();
    let key = |robot: usize, maze: usize| MatchKey {
        engine: engine.digest(),
        rules: rules.digest(),
        robot: robots[robot].digest,
        variant: 0,
        maze: mazes[maze].digest,
        seed: u64::MAX,
    };
    let matches = verdicts()
        .into_iter()
        .enumerate()
        .map(|(index, verdict)| MatchRecord {
            version: RecordVersion,
            key: key(index % 2, index / 2),
            verdict,
            steps: Steps {
                exploration: 110,
                speed: 17,
            },
            counts: Counts::default(),
            fuel: FuelUse {
                start: 1,
                steps: u64::MAX - 1,
                step_max: 7,
            },
            memory_bytes: 65_536,
            journal: JournalCounts::default(),
            transcript: Digest::of(&[1]),
        });
    let matches: Vec<MatchRecord> = matches.collect();
    let failures = vec![MatchFailure {
        key: key(0, 1),
        reason: format!("a worker exited: {HOSTILE}").into(),
    }];
    let line = |rank, robot: &str, finished, mean| Standing {
        rank,
        robot: robot.into(),
        matches: u64::from(rank.is_some()),
        finished,
        goal_reached: 0,
        faults: 0,
        mean_score_thousandths: mean,
        mean_regret_thousandths: mean.map(|mean| mean - 20_000),
    };
    let standings = Standings {
        mazes: 1,
        partial: true,
        lines: vec![
            line(Some(1), "a", 1, Some(19_999)),
            line(Some(2), HOSTILE, 0, None),
            line(None, "rejected", 0, None),
        ],
    };
    Results {
        version: RESULTS_VERSION,
        contest: ContestInfo {
            wasmouse: "0.1.0".to_owned(),
            engine,
            rules,
            seeds: Seeds {
                first: u64::MAX,
                count: 2,
            },
            robots: robots.into(),
            matches_planned: 800,
        },
        summary: Summary {
            matches: matches.len() as u64,
            complete: false,
            mazes: mazes.into(),
            failures,
            withdrawn: vec![WithdrawalEntry {
                robot: Digest::of(HOSTILE.as_bytes()),
                variant: 0,
                reason: format!("too slow: {HOSTILE}").into(),
                matches: 7,
            }],
            standings,
            digest: records_digest(&matches),
        },
        matches,
    }
}
