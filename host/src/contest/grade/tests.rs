//! Grades of a small matrix that is written by hand.

use std::collections::BTreeMap;

use wasmouse_core::game::{FaultKind, Ruleset, Score, Steps};
use wasmouse_core::record::FuelUse;
use wasmouse_core::{Digest, GuestText};

use super::super::matrix::{MatchScore, MatrixMaze, MatrixRobot, Outcome, ScoreMatrix};
use super::super::plan::{NotAdmitted, Seeds};
use super::*;

/// A match that was finished, in steps of exploration and speed run.
fn finished(exploration: u32, speed: u32) -> Option<MatchScore> {
    Some(MatchScore {
        outcome: Outcome::Finished,
        steps: Steps { exploration, speed },
        fuel: FuelUse {
            start: 1,
            steps: 10 * u64::from(exploration + speed),
            step_max: 25,
        },
        memory_bytes: 65_536,
    })
}

fn fault() -> Option<MatchScore> {
    let score = finished(60, 0).expect("a match");
    Some(MatchScore {
        outcome: Outcome::Fault(FaultKind::Panic),
        ..score
    })
}

/// Ten mazes, and robots with a match in each: one that always scores 22, one that scores 32 and
/// fails in the last maze, one that is rejected, and one without its last match.
struct Played {
    matrix: ScoreMatrix,
    mazes: Vec<GuestText>,
    unplayed: UnplayedMatches,
}

impl Played {
    fn new() -> Self {
        let robot = |name: &str| MatrixRobot::new(name, Digest::of(name.as_bytes()), 0);
        let mut robots = ["good", "bad", "lost", "late"].map(robot).to_vec();
        robots[2].not_admitted = Some(NotAdmitted::Failed("no worker".into()));
        let seeds = Seeds { first: 0, count: 1 };
        let mut matrix = ScoreMatrix::new(Ruleset::default(), seeds, robots);
        let mazes: Vec<GuestText> = (0..10).map(|it| format!("maze-{it}").into()).collect();
        for (index, name) in mazes.iter().enumerate() {
            matrix.push_maze(MatrixMaze {
                name: name.clone(),
                digest: Digest::of(format!("maze-{index}").as_bytes()),
                dimension: 12,
                oracle: Some(Score::new(19, 30, 30)),
                set: 0,
            });
            let is_last = index == 9;
            let bad = if is_last { fault() } else { finished(60, 30) };
            let late = if is_last { None } else { finished(60, 20) };
            for (robot, score) in [(0, finished(60, 20)), (1, bad), (3, late)] {
                if let Some(score) = score {
                    matrix.set(robot, index, 0, score);
                }
            }
        }
        Self {
            matrix,
            mazes,
            unplayed: UnplayedMatches::default(),
        }
    }

    fn grade(&self, criterion: &str, robot: usize) -> Grade {
        let text = format!(
            "version = 1\n[[mazes]]\nset = \"all\"\npaths = \"gen:tree:16:1..=10\"\n\
             [[criteria]]\nname = \"it\"\npoints = 10\n{criterion}\n"
        );
        let rubric = Rubric::read(&text).expect("a rubric");
        let references = BTreeMap::from([("bad".to_owned(), 1), ("good".to_owned(), 0)]);
        let graded = Graded {
            rubric: &rubric,
            matrix: &self.matrix,
            unplayed: &self.unplayed,
            mazes: &self.mazes,
            scopes: &[(0..10).collect()],
            references: &references,
            baselines: &BTreeMap::new(),
            stopped: "interrupted",
        };
        grade(&graded, &Submission::Robot(robot))
    }

    #[track_caller]
    fn check(&self, criterion: &str, robot: usize, value: i64, points: u64) {
        let grade = self.grade(criterion, robot);
        let result = &grade.criteria[0];
        let found = (result.value_thousandths, result.points_thousandths);
        assert_eq!(found, (Some(value), points), "{criterion}: {result:?}");
        let status = match points {
            0 => Status::Failed,
            10_000 => Status::Passed,
            _ => Status::Partial,
        };
        assert_eq!(result.status, status, "{criterion}");
        assert_eq!(grade.is_passed, points == 10_000);
    }
}

#[test]
fn each_expectation_is_measured_exactly() {
    let played = Played::new();
    played.check("finished_percent = 100", 0, 100_000, 10_000);
    played.check("finished_percent = 90", 1, 90_000, 10_000);
    played.check("finished_percent = 90.001", 1, 90_000, 0);
    played.check("mean_score = 22", 0, 22_000, 10_000);
    played.check("mean_score = 21.999", 0, 22_000, 0);
    // Nine matches of 32 and one that counts 1000.
    played.check("mean_score = 128.8", 1, 128_800, 10_000);
    played.check("mean_score = 128.799", 1, 128_800, 0);
    // The oracle needs 20.
    played.check("mean_regret = 2", 0, 2_000, 10_000);
    played.check("mean_regret = 108.8", 1, 108_800, 10_000);
    played.check("faults = 0", 0, 0, 10_000);
    played.check("faults = 0", 1, 1_000, 0);
    played.check("step_fuel_mean = 10", 0, 10_000, 10_000);
    played.check("step_fuel_max = 24", 0, 25_000, 0);
    played.check("memory_bytes_max = 65_536", 0, 65_536_000, 10_000);
    played.check("beats = \"bad\"", 0, 100_000, 10_000);
    played.check("beats = \"good\"", 1, 0, 0);
    played.check("beats = \"good\"\nbeats_percent = 50", 0, 50_000, 10_000);
    played.check("no_worse_than = \"bad\"", 0, -106_800, 10_000);
    played.check("no_worse_than = \"good\"", 1, 106_800, 0);
}

#[test]
fn partial_credit_is_linear_and_rounded_down() {
    let played = Played::new();
    played.check("finished_percent = 100\nnone = 80", 1, 90_000, 5_000);
    played.check("finished_percent = 100\nnone = 90", 1, 90_000, 0);
    played.check("mean_score = 100\nnone = 128.8", 1, 128_800, 0);
    played.check("mean_score = 22\nnone = 52", 0, 22_000, 10_000);
    played.check("mean_score = 19\nnone = 28", 0, 22_000, 6_666);
    played.check("faults = 0\nnone = 3", 1, 1_000, 6_666);
}

#[test]
fn whatever_happened_each_criterion_has_a_reason() {
    let mut played = Played::new();
    let result = |played: &Played, robot| {
        let grade = played.grade("faults = 0", robot);
        assert!(!grade.is_passed && grade.points_thousandths == 0);
        let result = grade.criteria[0].clone();
        (result.status, result.reason.expect("a reason"))
    };
    let lost = "the robot could not be admitted: no worker".into();
    assert_eq!(result(&played, 2), (Status::Skipped, lost));
    let late = "stopped before all of its matches were played: interrupted".into();
    assert_eq!(result(&played, 3), (Status::Skipped, late));
    let key = wasmouse_core::record::MatchKey {
        engine: Digest::of(b""),
        rules: Digest::of(b""),
        robot: played.matrix.robots[3].digest,
        variant: 0,
        maze: Digest::of(b""),
        seed: 0,
    };
    let failure = super::super::sink::MatchFailure {
        key,
        reason: "too slow".into(),
    };
    use super::super::sink::Sink as _;
    played.unplayed.failed(&failure).expect("it keeps it");
    let failed = "not all of its matches could be played: too slow".into();
    assert_eq!(result(&played, 3), (Status::Skipped, failed));
    played.unplayed.withdrawn(&failure).expect("it keeps it");
    let withdrawn = "the robot was withdrawn: too slow".into();
    assert_eq!(result(&played, 3), (Status::Failed, withdrawn));
    // A reference robot that did not play is nobody's fault.
    let grade = played.grade("beats = \"nobody\"", 0);
    assert_eq!(grade.criteria[0].status, Status::Skipped);
    assert!(!grade.is_complete());
}
