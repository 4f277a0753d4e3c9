//! A contest for the tests of reports: every state of a robot, every outcome, hidden mazes, ties,
//! and untrusted text wherever text can come from.

use std::sync::Arc;

use wasmouse_core::Digest;
use wasmouse_core::game::{
    Action, Counts, Fault, FaultKind, FuelLimit, Phase, Ruleset, Run, Score, Steps, Verdict,
};
use wasmouse_core::journal::JournalCounts;
use wasmouse_core::maze::{Cell, Maze, Turn, Walls};
use wasmouse_core::record::{EngineId, FuelUse, MatchKey, MatchRecord, RecordVersion, Transcript};
use wasmouse_engine::admission::Rejection;

use super::document::{ContestReport, ReportOptions};
use super::picture::{MatchPicture, Pictures};
use crate::contest::{
    MatchScore, MatrixFault, MatrixMaze, MatrixRobot, MazeSet, NotAdmitted, Outcome, ScoreMatrix,
    Scoring, Seeds,
};

/// Text that would be markup, a formula or a control sequence wherever it is not escaped.
pub(super) const HOSTILE: &str =
    "=<b>\u{1b}[31m|`*_[x](y)@me\u{202e}\"'&\\\n\r\u{2028}</script><script>alert(1)</script>";

/// The parts of a report that borrows them.
pub(super) struct Sample {
    pub(super) matrix: ScoreMatrix,
    pub(super) scoring: Scoring,
    pub(super) engine: EngineId,
    pub(super) name: String,
}

/// The maze whose pictures are drawn.
fn open_maze() -> Maze {
    Maze::contest(Walls::open(12)).expect("start and goal fit")
}

fn finished(exploration: u32, speed: u32) -> Option<MatchScore> {
    score(Outcome::Finished, exploration, speed)
}

fn score(outcome: Outcome, exploration: u32, speed: u32) -> Option<MatchScore> {
    Some(MatchScore {
        outcome,
        steps: Steps { exploration, speed },
        fuel: FuelUse {
            start: 10,
            steps: u64::from(exploration + speed) * 100,
            step_max: 150,
        },
        memory_bytes: 65_536,
    })
}

impl Sample {
    /// Five robots in five mazes of two sets.
    ///
    /// `untrusted` is part of every text that is not ours.
    pub(super) fn new(untrusted: &str) -> Self {
        let rules = Ruleset::default();
        let engine = EngineId::new("wasmtime-1");
        let names = ["flood", untrusted, "looper", "rejected", "unlucky"];
        let robots = names.map(|name| MatrixRobot::new(name, Digest::of(name.as_bytes()), 0));
        let mut matrix =
            ScoreMatrix::new(rules.clone(), Seeds { first: 7, count: 1 }, robots.into());
        matrix.sets = vec![
            MazeSet {
                name: "public".to_owned(),
                is_hidden: false,
                weight: 1,
            },
            MazeSet {
                name: format!("hidden {untrusted}"),
                is_hidden: true,
                weight: 2,
            },
        ];
        let maze = open_maze();
        let oracle = rules.game.oracle_score(&maze);
        let mazes = [
            ("open", 0, oracle),
            (untrusted, 0, Some(Score::new(17, 18, 30))),
            ("secret-1", 1, Some(Score::new(20, 21, 30))),
            ("secret-2", 1, Some(Score::new(9, 10, 30))),
            ("no way", 0, None),
        ];
        let budget = Outcome::BudgetUsedUp { goal_reached: true };
        let fault = Outcome::Fault(FaultKind::OutOfFuel(FuelLimit::Step));
        let cells = [
            [finished(30, 4), finished(45, 4), finished(200, 4)],
            [finished(110, 17), finished(110, 18), score(fault, 5, 0)],
            [finished(90, 22), score(budget, 960, 40), None],
            [finished(60, 9), finished(95, 9), None],
            [
                score(
                    Outcome::BudgetUsedUp {
                        goal_reached: false,
                    },
                    1000,
                    0,
                ),
                score(fault, 5, 0),
                None,
            ],
        ];
        for ((name, set, oracle), cells) in mazes.into_iter().zip(cells) {
            let digest = if name == "open" {
                maze.digest()
            } else {
                Digest::of(name.as_bytes())
            };
            let name = name.into();
            let maze = matrix.push_maze(MatrixMaze {
                name,
                digest,
                dimension: 12,
                oracle,
                set,
            });
            for (robot, cell) in cells.into_iter().enumerate() {
                if let Some(cell) = cell {
                    matrix.set(robot, maze, 0, cell);
                }
            }
        }
        let mut sample = Self {
            matrix,
            scoring: Scoring::default(),
            engine,
            name: format!("Spring cup {untrusted}"),
        };
        sample.add_states(untrusted);
        sample
    }

    fn add_states(&mut self, untrusted: &str) {
        let [no_way, hostile] = [4, 1].map(|maze| self.record(1, maze, untrusted));
        let fault = |count, first| MatrixFault { count, first };
        let kind = FaultKind::OutOfFuel(FuelLimit::Step).name();
        self.matrix.robots[1].faults.insert(kind, fault(1, no_way));
        self.matrix.robots[2].faults.insert(kind, fault(1, hostile));
        let hidden = self.record(2, 2, untrusted);
        self.matrix.robots[2]
            .faults
            .insert(FaultKind::Panic.name(), fault(1, hidden));
        self.matrix.robots[1].author = Some(format!("Ann {untrusted}").into());
        self.matrix.robots[0].class = Some("small".into());
        self.matrix.robots[1].class = Some(format!("class {untrusted}").into());
        let reason = format!("too slow: {untrusted}");
        self.matrix.robots[2].unplayed.insert(reason.into(), 3);
        let rejection = Rejection::UnknownImport(untrusted.into());
        self.matrix.robots[3].not_admitted = Some(NotAdmitted::Rejected(Arc::new(rejection)));
        let failed = NotAdmitted::Failed(format!("no process: {untrusted}").into());
        self.matrix.robots[4].not_admitted = Some(failed);
    }

    fn record(&self, robot: usize, maze: usize, untrusted: &str) -> MatchRecord {
        MatchRecord {
            version: RecordVersion,
            key: MatchKey {
                engine: self.engine.digest(),
                rules: self.matrix.rules.digest(),
                robot: self.matrix.robots[robot].digest,
                variant: 0,
                maze: self.matrix.mazes[maze].digest,
                seed: 7,
            },
            verdict: Verdict::Fault {
                fault: Fault {
                    kind: FaultKind::OutOfFuel(FuelLimit::Step),
                    phase: Phase::NextMove,
                    run: Run::Exploration,
                    step: 6,
                    cell: Cell::new(0, 3),
                    detail: format!("exceeded the fuel limit: {untrusted}").into(),
                },
            },
            steps: Steps {
                exploration: 5,
                speed: 0,
            },
            counts: Counts::default(),
            fuel: FuelUse {
                start: 10,
                steps: 500,
                step_max: 150,
            },
            memory_bytes: 65_536,
            journal: JournalCounts::default(),
            transcript: Digest::of(&[1]),
        }
    }

    /// The report of the sample, with pictures in the first maze.
    pub(super) fn report(&self, options: ReportOptions) -> ContestReport<'_> {
        let mut transcript = Transcript::default();
        for advance in [3, 1] {
            let turn = Turn::Right;
            transcript.push(Action::Move { turn, advance });
        }
        let mut rules = self.matrix.rules.game;
        rules.budget = 2;
        let maze = open_maze();
        let picture = |robot| {
            MatchPicture::new((robot, 0, 0), &maze, &rules, &transcript).expect("two steps")
        };
        let pictures = Pictures {
            best: vec![picture(1), picture(0)],
            hardest: vec![picture(0), picture(1)],
        };
        ContestReport::new(
            &self.name,
            &self.matrix,
            &self.scoring,
            &self.engine,
            15,
            options,
        )
        .with_pictures(pictures)
        .with_results_digest(Digest::of(b"results"))
    }
}
