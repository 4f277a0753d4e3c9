//! [`markdown`]: grades as GitHub's Markdown, for the summary of a job or a comment.

use wasmouse_core::guest_text::GuestStr;

use super::super::escape::for_terminal;
use super::sentence::{Report, points, sentence, verdict};
use crate::contest::grade::{Grade, Status};
use crate::report::number::counted;

/// What the summary of a step may have, in bytes: GitHub shows nothing of a larger one.
pub const STEP_SUMMARY_BYTES_MAX: usize = 1 << 20;

/// A heading, a table of the robots when there is more than one, and a table for each robot, in
/// at most that many bytes. What does not fit is left out, and the end says so.
pub fn markdown(report: &Report<'_>, bytes_max: usize) -> String {
    /// Room for the line that says what was left out.
    const END: usize = 100;
    let passed = report.grades.iter().filter(|it| it.is_passed).count();
    let name = plain(&report.rubric.name);
    let mut text = match report.grades {
        [grade] => format!("## {name}: {}\n\n", verdict(grade)),
        grades => format!(
            "## {name}: {passed} of {} passed\n\n",
            counted(grades.len(), "robot")
        ),
    };
    let mut parts = Vec::new();
    if report.grades.len() > 1 {
        parts.push(
            "| robot | result | points | finished | faults |\n|---|---|---|---|---|\n".to_owned(),
        );
        parts.extend(report.grades.iter().map(row));
        parts.push("\n".to_owned());
    }
    parts.extend(report.grades.iter().map(|it| section(report, it)));
    let mut left_out = 0;
    for part in parts {
        if left_out == 0 && text.len() + part.len() + END <= bytes_max {
            text.push_str(&part);
        } else {
            left_out += 1;
        }
    }
    if left_out > 0 {
        text.push_str("\nThe rest does not fit and was left out.\n");
    }
    text
}

fn row(grade: &Grade) -> String {
    format!(
        "| {} | {} | {} / {} | {} of {} | {} |\n",
        code(&grade.robot),
        verdict(grade),
        points(grade.points_thousandths),
        grade.points_max,
        grade.matches.finished,
        grade.matches.planned,
        grade.matches.faults
    )
}

fn section(report: &Report<'_>, grade: &Grade) -> String {
    let mut text = format!(
        "### {}\n\n**{}**, {} of {} points\n\n| | points | criterion | found |\n|---|---|---|---|\n",
        code(&grade.robot),
        verdict(grade),
        points(grade.points_thousandths),
        grade.points_max
    );
    for (criterion, result) in report.criteria(grade) {
        let mark = match result.status {
            Status::Passed => "✅ passed",
            Status::Partial => "🔶 partial",
            Status::Failed => "❌ failed",
            Status::Skipped => "⚪ skipped",
        };
        let found = sentence(criterion, result);
        // Without a value, it may quote the robot.
        let found = match result.value_thousandths {
            Some(_) => plain(&found),
            None => code(&found),
        };
        text += &format!(
            "| {mark} | {} / {} | {} | {found} |\n",
            points(result.points_thousandths),
            criterion.points,
            plain(&criterion.name)
        );
    }
    for fault in &grade.faults {
        text += &format!(
            "\nFault {} in {} of {}, first in {} with seed {}: {}\n",
            plain(fault.kind),
            fault.count,
            counted(grade.matches.played, "match"),
            code(&fault.maze),
            fault.seed,
            code(&fault.message)
        );
    }
    text + "\n"
}

/// Text that is no markup, because every character that could be is a numeric entity.
fn plain<'a>(text: impl Into<GuestStr<'a>>) -> String {
    let text = for_terminal(text);
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_ascii_punctuation() && !matches!(character, ',' | '.' | '%' | ';') {
            escaped += &format!("&#{};", u32::from(character));
        } else {
            escaped.push(character);
        }
    }
    escaped
}

/// Text in an element in which GitHub sees neither markup nor mentions of people.
fn code<'a>(text: impl Into<GuestStr<'a>>) -> String {
    let text = plain(text).replace("www.", "www&#46;");
    format!("<code>{text}</code>")
}

#[cfg(test)]
mod tests {
    use super::super::sample::{HOSTILE, Sample};
    use super::*;

    #[test]
    fn text_of_robots_is_no_markup() {
        let text = code("<b>|*a* [x](y) @me `c` ##[error]\n::error::");
        assert!(!text[6..text.len() - 7].contains(['<', '>', '|', '*', '[', '`', '@', '\n', ':']));
        let sample = Sample::new();
        let text = markdown(&sample.report(), STEP_SUMMARY_BYTES_MAX);
        assert!(text.contains(&code(HOSTILE)), "{text}");
        assert!(!text.contains("<b>") && !text.contains("##["), "{text}");
    }

    #[test]
    fn it_never_has_more_bytes_than_it_may() {
        let mut sample = Sample::new();
        let grade = sample.grades[0].clone();
        sample.grades.resize(300, grade);
        for bytes_max in [1000, 5000, 20_000] {
            let text = markdown(&sample.report(), bytes_max);
            assert!(text.len() <= bytes_max, "{}", text.len());
            assert!(text.ends_with("The rest does not fit and was left out.\n"));
        }
        let whole = markdown(&sample.report(), usize::MAX);
        assert!(!whole.contains("left out"));
    }
}
