//! [`json`]: grades as a JSON document, which `host/schema/grade.schema.json` describes.

use serde::Serialize;
use wasmouse_core::GuestText;

use super::super::json;
use super::sentence::{Report, sentence};
use crate::contest::Seeds;
use crate::contest::grade::{Grade, Mark, Participation};

/// The version of the document; raised when a reader of the old one would go wrong.
pub const GRADE_VERSION: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    wasmouse: &'static str,
    engine: &'a str,
    rubric: RubricEntry<'a>,
    complete: bool,
    passed: bool,
    robots: Vec<RobotEntry<'a>>,
}

#[derive(Serialize)]
struct RubricEntry<'a> {
    name: &'a str,
    digest: String,
    rules: &'a str,
    seeds: Seeds,
    points_max: u32,
    pass_points_thousandths: u64,
    criteria: Vec<CriterionEntry<'a>>,
}

#[derive(Serialize)]
struct CriterionEntry<'a> {
    name: &'a str,
    points: u32,
    mazes: &'a [String],
    kind: &'static str,
    full_thousandths: Option<i64>,
    none_thousandths: Option<i64>,
    reference: Option<&'a str>,
}

#[derive(Serialize)]
struct RobotEntry<'a> {
    robot: &'a GuestText,
    digest: Option<String>,
    variant: u32,
    participation: &'static str,
    reason: Option<&'a GuestText>,
    hint: Option<&'a GuestText>,
    complete: bool,
    passed: bool,
    points_thousandths: u64,
    matches: Counts,
    criteria: Vec<ResultEntry<'a>>,
    faults: Vec<FaultEntry<'a>>,
}

#[derive(Serialize)]
struct Counts {
    planned: u64,
    played: u64,
    finished: u64,
    faults: u64,
}

#[derive(Serialize)]
struct ResultEntry<'a> {
    name: &'a str,
    status: &'static str,
    points_thousandths: u64,
    value_thousandths: Option<i64>,
    matches: u64,
    message: GuestText,
}

#[derive(Serialize)]
struct FaultEntry<'a> {
    kind: &'static str,
    matches: u64,
    maze: &'a GuestText,
    seed: u64,
    message: &'a GuestText,
}

/// The document.
pub fn json(report: &Report<'_>) -> String {
    let rubric = report.rubric;
    let points_max = rubric.points_max();
    let criteria = rubric.criteria.iter().map(|it| {
        let threshold = it.expectation.threshold();
        CriterionEntry {
            name: &it.name,
            points: it.points,
            mazes: &it.mazes,
            kind: it.expectation.name(),
            full_thousandths: threshold.map(|it| it.full),
            none_thousandths: threshold.and_then(|it| it.none),
            reference: it.expectation.reference(),
        }
    });
    json::document(&Document {
        version: GRADE_VERSION,
        wasmouse: env!("CARGO_PKG_VERSION"),
        engine: report.engine,
        rubric: RubricEntry {
            name: &rubric.name,
            digest: rubric.digest.to_string(),
            rules: &rubric.rules.name,
            seeds: rubric.seeds,
            points_max,
            pass_points_thousandths: pass_points(rubric.mark, points_max),
            criteria: criteria.collect(),
        },
        complete: report.grades.iter().all(Grade::is_complete),
        passed: report.grades.iter().all(|it| it.is_passed),
        robots: report.grades.iter().map(|it| robot(report, it)).collect(),
    })
}

/// The least points that pass, in thousandths.
fn pass_points(mark: Mark, points_max: u32) -> u64 {
    match mark {
        Mark::Points(points) => u64::from(points) * 1000,
        Mark::Percent(percent) => {
            let percent = u64::try_from(percent).unwrap_or(0);
            (percent * u64::from(points_max)).div_ceil(100)
        }
    }
}

fn robot<'a>(report: &Report<'a>, grade: &'a Grade) -> RobotEntry<'a> {
    let criteria = report
        .criteria(grade)
        .map(|(criterion, result)| ResultEntry {
            name: &criterion.name,
            status: result.status.name(),
            points_thousandths: result.points_thousandths,
            value_thousandths: result.value_thousandths,
            matches: result.matches,
            message: sentence(criterion, result),
        });
    let faults = grade.faults.iter().map(|it| FaultEntry {
        kind: it.kind,
        matches: it.count,
        maze: &it.maze,
        seed: it.seed,
        message: &it.message,
    });
    let counts = grade.matches;
    RobotEntry {
        robot: &grade.robot,
        digest: grade.digest.map(|it| it.to_string()),
        variant: grade.variant,
        participation: grade.participation.name(),
        reason: grade.participation.reason(),
        hint: match &grade.participation {
            Participation::Rejected { hint, .. } => Some(hint),
            _ => None,
        },
        complete: grade.is_complete(),
        passed: grade.is_passed,
        points_thousandths: grade.points_thousandths,
        matches: Counts {
            planned: counts.planned,
            played: counts.played,
            finished: counts.finished,
            faults: counts.faults,
        },
        criteria: criteria.collect(),
        faults: faults.collect(),
    }
}
