//! [`annotations`]: what was missed, as commands of a GitHub workflow.
//!
//! The runner takes every line of the log that begins with `::` for a command, and also the older
//! form `##[...]`, wherever it is in a line.

use std::fmt::Write as _;

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::{GuestText, guest_text};

use super::super::escape;
use super::sentence::{Report, points, sentence, verdict};
use crate::contest::grade::Status;

/// An error for each criterion that is failed, a warning for one that is met in part or could
/// not be measured, and a notice with the points of each robot.
pub fn annotations(report: &Report<'_>) -> String {
    let mut text = String::new();
    for grade in report.grades {
        for (criterion, result) in report.criteria(grade) {
            let level = match result.status {
                Status::Passed => continue,
                Status::Failed => "error",
                Status::Partial | Status::Skipped => "warning",
            };
            let title = guest_text!("{}: {}", grade.robot, criterion.name);
            line(&mut text, level, &title, &sentence(criterion, result));
        }
        let earned = points(grade.points_thousandths);
        let message = format!(
            "{}: {earned} of {} points",
            verdict(grade),
            grade.points_max
        );
        line(&mut text, "notice", &grade.robot, &message);
    }
    text
}

fn line<'a>(text: &mut String, level: &str, title: &GuestText, message: impl Into<GuestStr<'a>>) {
    let (title, message) = (property(title), data(message));
    writeln!(text, "::{level} title={title}::{message}").expect("writing to a string cannot fail");
}

/// The message of a command. Line breaks and control characters have been escaped.
fn data<'a>(text: impl Into<GuestStr<'a>>) -> String {
    old_form(&escape::for_terminal(text).replace('%', "%25"))
}

/// The value of a property of a command.
fn property(text: &GuestText) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

/// Lines for the log of a workflow, of which none is a command. The text must have been escaped
/// for terminals.
///
/// ```
/// use wasmouse::report::grade::for_workflow;
/// assert_eq!(for_workflow("a::b\n  ::error::x"), "a::b\n  \\::error::x");
/// assert_eq!(for_workflow("x ##[add-mask]y"), "x #\\#[add-mask]y");
/// ```
pub fn for_workflow(lines: &str) -> String {
    let lines = lines.split('\n').map(|line| {
        let begin = line.len() - line.trim_start().len();
        let (space, rest) = line.split_at(begin);
        let backslash = if rest.starts_with("::") { "\\" } else { "" };
        format!("{space}{backslash}{}", old_form(rest))
    });
    let lines: Vec<String> = lines.collect();
    lines.join("\n")
}

fn old_form(text: &str) -> String {
    text.replace("##[", "#\\#[")
}

#[cfg(test)]
mod tests {
    use super::super::sample::{HOSTILE, Sample};
    use super::*;

    #[test]
    fn nothing_that_a_robot_says_is_a_command() {
        let sample = Sample::new();
        let text = annotations(&sample.report());
        for line in text.lines() {
            let rest = line.strip_prefix("::").expect("each line is a command");
            let (level, rest) = rest.split_once(" title=").expect("with a title");
            assert!(["error", "warning", "notice"].contains(&level), "{line}");
            let (title, message) = rest.split_once("::").expect("and a message");
            assert!(!title.contains([':', ',']), "{title}");
            assert!(!line.contains("##["), "{line}");
            assert!(!message.is_empty());
        }
        assert!(text.contains("title=a"), "{text}");
        assert!(HOSTILE.contains("##[") && text.contains("#\\#["), "{text}");
        assert!(text.contains("%25"), "{text}");
    }
}
