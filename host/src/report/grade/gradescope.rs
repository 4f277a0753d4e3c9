//! [`gradescope`]: the grade of a robot as `results.json` of a Gradescope autograder.

use serde::Serialize;

use super::super::escape::for_terminal;
use super::super::json;
use super::sentence::{Report, faults, points, sentence, verdict};
use crate::contest::grade::{Grade, Status};
use crate::report::number::counted;

#[derive(Serialize)]
struct Document {
    output: String,
    output_format: &'static str,
    visibility: &'static str,
    /// What is printed is for the teacher.
    stdout_visibility: &'static str,
    tests: Vec<Test>,
    leaderboard: Vec<Entry>,
    extra_data: Extra,
}

#[derive(Serialize)]
struct Test {
    score: f64,
    max_score: u32,
    status: &'static str,
    name: String,
    name_format: &'static str,
    number: String,
    output: String,
    output_format: &'static str,
    visibility: &'static str,
}

#[derive(Serialize)]
struct Entry {
    name: &'static str,
    value: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    order: Option<&'static str>,
}

#[derive(Serialize)]
struct Extra {
    wasmouse: &'static str,
    engine: String,
    rubric: String,
    robot: Option<String>,
}

/// The document of one robot.
pub fn gradescope(report: &Report<'_>, grade: &Grade) -> String {
    let tests = report
        .criteria(grade)
        .zip(1..)
        .map(|((criterion, result), number)| Test {
            score: of_thousandths(result.points_thousandths),
            max_score: criterion.points,
            status: if result.status == Status::Passed {
                "passed"
            } else {
                "failed"
            },
            name: for_terminal(&criterion.name),
            name_format: "text",
            number: i32::to_string(&number),
            output: for_terminal(&sentence(criterion, result)),
            output_format: "text",
            visibility: "visible",
        });
    let counts = grade.matches;
    let finished = match counts.planned {
        0 => 0,
        planned => counts.finished * 100_000 / planned,
    };
    json::document(&Document {
        output: overview(report, grade),
        output_format: "text",
        visibility: "visible",
        stdout_visibility: "hidden",
        tests: tests.collect(),
        leaderboard: vec![
            Entry {
                name: "Points",
                value: of_thousandths(grade.points_thousandths),
                order: None,
            },
            Entry {
                name: "Finished (%)",
                value: of_thousandths(finished),
                order: None,
            },
            Entry {
                name: "Faults",
                value: counts.faults as f64,
                order: Some("asc"),
            },
        ],
        extra_data: Extra {
            wasmouse: env!("CARGO_PKG_VERSION"),
            engine: report.engine.to_owned(),
            rubric: report.rubric.digest.to_string(),
            robot: grade.digest.map(|it| it.to_string()),
        },
    })
}

fn overview(report: &Report<'_>, grade: &Grade) -> String {
    let mut lines = vec![format!(
        "{}: {}, {} of {} points",
        for_terminal(&report.rubric.name),
        verdict(grade),
        points(grade.points_thousandths),
        grade.points_max
    )];
    let counts = grade.matches;
    lines.push(format!(
        "{} of {} finished, {} ended in a fault",
        counts.finished,
        counted(counts.planned, "match"),
        counts.faults
    ));
    if let Some(reason) = grade.participation.reason() {
        lines.push(format!(
            "{}: {}",
            grade.participation.name(),
            for_terminal(reason)
        ));
    }
    lines.extend(faults(grade).map(|it| for_terminal(&it)));
    lines.join("\n")
}

/// Gradescope has numbers with decimals.
fn of_thousandths(thousandths: u64) -> f64 {
    thousandths as f64 / 1000.0
}
