//! [`table`]: grades for people, as text.

use std::fmt::Write as _;

use super::super::escape::for_terminal;
use super::sentence::{Report, faults, points, sentence, verdict};
use crate::report::number::counted;

/// A block for each robot: its points, and a line for each criterion; a summary when there is
/// more than one robot.
pub fn table(report: &Report<'_>) -> String {
    let mut text = String::new();
    for grade in report.grades {
        writeln!(
            text,
            "{}: {}, {} of {} points",
            for_terminal(&grade.robot),
            verdict(grade),
            points(grade.points_thousandths),
            grade.points_max
        )
        .expect("writing to a string cannot fail");
        for (criterion, result) in report.criteria(grade) {
            writeln!(
                text,
                "  {:<7} {:>7} / {:<4} {}: {}",
                result.status.name(),
                points(result.points_thousandths),
                criterion.points,
                for_terminal(&criterion.name),
                for_terminal(&sentence(criterion, result))
            )
            .expect("writing to a string cannot fail");
        }
        for fault in faults(grade) {
            writeln!(text, "  fault: {}", for_terminal(&fault))
                .expect("writing to a string cannot fail");
        }
    }
    if report.grades.len() > 1 {
        let passed = report.grades.iter().filter(|it| it.is_passed).count();
        writeln!(
            text,
            "{passed} of {} passed",
            counted(report.grades.len(), "robot")
        )
        .expect("writing to a string cannot fail");
    }
    text
}
