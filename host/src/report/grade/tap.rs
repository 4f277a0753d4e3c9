//! [`tap`]: grades in the Test Anything Protocol, version 14.

use std::fmt::Write as _;

use wasmouse_core::{GuestText, guest_text};

use super::super::escape::for_terminal;
use super::super::json;
use super::sentence::{Report, points, sentence, verdict};
use crate::contest::grade::Status;

/// A test point for each criterion of each robot, and one for each robot that says whether it
/// passes.
///
/// What could not be measured is `not ok`, because a directive `SKIP` would make it a success.
pub fn tap(report: &Report<'_>) -> String {
    let mut text = String::new();
    let mut count = 0;
    let mut point = |is_ok: bool, description: &GuestText, entries: &[(&str, GuestText)]| {
        count += 1;
        let not = if is_ok { "" } else { "not " };
        writeln!(text, "{not}ok {count} - {}", escaped(description))
            .expect("writing to a string cannot fail");
        text.push_str("  ---\n");
        for (key, value) in entries {
            // A string of JSON is one of YAML.
            writeln!(text, "  {key}: {}", json::line(&for_terminal(value)))
                .expect("writing to a string cannot fail");
        }
        text.push_str("  ...\n");
    };
    for grade in report.grades {
        for (criterion, result) in report.criteria(grade) {
            let earned = points(result.points_thousandths);
            point(
                result.status == Status::Passed,
                &guest_text!("{}: {}", grade.robot, criterion.name),
                &[
                    ("message", sentence(criterion, result)),
                    ("status", result.status.name().into()),
                    ("points", format!("{earned} of {}", criterion.points).into()),
                ],
            );
        }
        let earned = points(grade.points_thousandths);
        point(
            grade.is_passed,
            &guest_text!("{} passes", grade.robot),
            &[
                ("result", verdict(grade).into()),
                ("points", format!("{earned} of {}", grade.points_max).into()),
            ],
        );
    }
    format!("TAP version 14\n1..{count}\n{text}")
}

/// A description of a test point, in which `#` begins no directive.
fn escaped(text: &GuestText) -> String {
    for_terminal(text).replace('\\', "\\\\").replace('#', "\\#")
}
