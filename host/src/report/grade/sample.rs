//! Grades for the tests of this folder: every status, and untrusted text.

use wasmouse_core::game::Ruleset;
use wasmouse_core::{Digest, GuestText};

use super::sentence::Report;
use crate::contest::Seeds;
use crate::contest::grade::{
    Criterion, CriterionGrade, Expectation, FaultLine, Grade, Mark, MatchCounts, Participation,
    Rubric, RubricSet, Status, Target, Threshold,
};

/// Text that is a command, markup, an element and a formula, and controls a terminal.
pub const HOSTILE: &str =
    "=<b>\u{1b}[31m\u{0}\u{fffe}|`*\r\n::error::x%0A ##[add-mask]y, \"q\" @me";

/// A report.
pub struct Sample {
    pub rubric: Rubric,
    pub grades: Vec<Grade>,
}

impl Sample {
    pub fn new() -> Self {
        let criterion = |name: &str, points, expectation| Criterion {
            name: name.to_owned(),
            points,
            mazes: Vec::new(),
            expectation,
        };
        let at = |full| Threshold { full, none: None };
        let criteria = vec![
            criterion(
                "finishes",
                4,
                Expectation::Measure(Target::FinishedPercent, at(95_000)),
            ),
            criterion(
                HOSTILE,
                3,
                Expectation::Beats {
                    robot: "flood".to_owned(),
                    percent: Threshold {
                        full: 50_000,
                        none: Some(0),
                    },
                },
            ),
            criterion("faults", 3, Expectation::Measure(Target::Faults, at(0))),
            criterion(
                "baseline",
                0,
                Expectation::Baseline {
                    file: "baseline.json".to_owned(),
                    robot: None,
                    steps: at(-1_500),
                },
            ),
        ];
        let result =
            |status, points_thousandths, value_thousandths, reason: Option<&str>| CriterionGrade {
                status,
                points_thousandths,
                value_thousandths,
                matches: 20,
                reason: reason.map(GuestText::from),
            };
        let grade = |robot: &str, participation, criteria: Vec<CriterionGrade>| Grade {
            robot: robot.into(),
            digest: Some(Digest::of(robot.as_bytes())),
            variant: 0,
            points_thousandths: criteria.iter().map(|it| it.points_thousandths).sum(),
            points_max: 10,
            is_passed: false,
            participation,
            criteria,
            matches: MatchCounts {
                planned: 20,
                played: 19,
                finished: 18,
                faults: 1,
            },
            faults: vec![FaultLine {
                kind: "panic",
                count: 1,
                maze: HOSTILE.into(),
                seed: 7,
                message: HOSTILE.into(),
            }],
        };
        let played = vec![
            result(Status::Passed, 4_000, Some(95_000), None),
            result(Status::Partial, 1_500, Some(25_000), None),
            result(Status::Failed, 0, Some(1_000), None),
            result(Status::Skipped, 0, None, Some(HOSTILE)),
        ];
        let rejected = vec![result(Status::Failed, 0, None, Some(HOSTILE)); 4];
        let rejection = Participation::Rejected {
            kind: "unknown-import".into(),
            reason: HOSTILE.into(),
            hint: "build it without".into(),
        };
        Self {
            rubric: Rubric {
                name: "Sample".to_owned(),
                digest: Digest::of(b""),
                rules: Ruleset::default(),
                seeds: Seeds { first: 0, count: 2 },
                sets: vec![RubricSet {
                    name: "all".to_owned(),
                    mazes: vec!["gen:tree:16:1..=10".to_owned()],
                    is_lenient: false,
                }],
                criteria,
                mark: Mark::Percent(60_000),
            },
            grades: vec![
                grade("a", Participation::Admitted, played),
                grade(HOSTILE, rejection, rejected),
            ],
        }
    }

    pub fn report(&self) -> Report<'_> {
        Report {
            rubric: &self.rubric,
            engine: "wasmtime-1",
            grades: &self.grades,
        }
    }
}
