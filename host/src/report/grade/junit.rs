//! [`junit`]: grades as JUnit XML, a suite for each robot and a case for each criterion.

use quick_junit::{
    NonSuccessKind, Property, Report as Document, TestCase, TestCaseStatus, TestSuite,
};

use wasmouse_core::guest_text::GuestStr;

use super::super::escape;
use super::sentence::{Report, faults, points, sentence, verdict};
use crate::contest::grade::{CriterionGrade, Status};

/// The document. It has no times, so that equal grades are equal bytes.
pub fn junit(report: &Report<'_>) -> String {
    let rubric = escaped(&report.rubric.name);
    let mut document = Document::new(rubric.as_str());
    for grade in report.grades {
        let mut suite = TestSuite::new(escaped(&grade.robot));
        for (criterion, result) in report.criteria(grade) {
            let text = escaped(&sentence(criterion, result));
            let status = status(result, criterion.points, &text);
            let mut case = TestCase::new(escaped(&criterion.name), status);
            case.set_classname(rubric.as_str());
            suite.add_test_case(case);
        }
        let properties = [
            ("result", verdict(grade).to_owned()),
            ("passed", grade.is_passed.to_string()),
            ("points", points(grade.points_thousandths)),
            ("points_max", grade.points_max.to_string()),
        ];
        suite.add_properties(properties.map(|(name, value)| Property::new(name, value)));
        let faults: Vec<String> = faults(grade).map(|it| escaped(&it)).collect();
        if !faults.is_empty() {
            suite.set_system_out(faults.join("\n"));
        }
        document.add_test_suite(suite);
    }
    let text = document.to_string();
    let text = text.expect("what is written to memory has no characters that XML does not have");
    without_skipped(&text)
}

fn status(result: &CriterionGrade, points_max: u32, text: &str) -> TestCaseStatus {
    let earned = points(result.points_thousandths);
    let message = format!("{earned} of {points_max} points: {text}");
    let (mut status, kind) = match result.status {
        Status::Passed => return TestCaseStatus::success(),
        Status::Skipped => (TestCaseStatus::skipped(), "skipped"),
        Status::Partial => (
            TestCaseStatus::non_success(NonSuccessKind::Failure),
            "partial",
        ),
        Status::Failed => (
            TestCaseStatus::non_success(NonSuccessKind::Failure),
            "failed",
        ),
    };
    status.set_type(kind).set_message(message);
    status
}

/// Text without characters that XML does not have: also two that a terminal does not mind.
fn escaped<'a>(text: impl Into<GuestStr<'a>>) -> String {
    let text = escape::for_terminal(text);
    text.replace('\u{fffe}', "\\u{fffe}")
        .replace('\u{ffff}', "\\u{ffff}")
}

/// The document without the attribute `skipped` of its root, which the schemas of Jenkins do not
/// have. No value of an attribute has a quotation mark in it, so the first one found is it.
fn without_skipped(document: &str) -> String {
    let Some(root) = document.find("<testsuites") else {
        return document.to_owned();
    };
    let (before, rest) = document.split_at(root);
    let (tag, after) = rest.split_at(rest.find('>').unwrap_or(rest.len()));
    let (Some(begin), attribute) = (tag.find(" skipped=\""), " skipped=\"") else {
        return document.to_owned();
    };
    let value = &tag[begin + attribute.len()..];
    let end = value.find('"').map_or(value.len(), |it| it + 1);
    format!("{before}{}{}{after}", &tag[..begin], &value[end..])
}

#[cfg(test)]
mod tests {
    use super::super::sample::Sample;
    use super::*;

    #[test]
    fn the_root_has_no_count_of_skipped_cases() {
        let sample = Sample::new();
        let text = junit(&sample.report());
        let root = text.lines().nth(1).expect("a root");
        assert!(root.starts_with("<testsuites name="), "{root}");
        assert!(
            root.contains(" tests=\"") && !root.contains("skipped"),
            "{root}"
        );
        assert!(text.contains("<skipped"), "{text}");
        let is_bad = |it: char| it.is_control() && it != '\n';
        assert!(!text.contains(is_bad), "{text:?}");
        assert!(text.contains("\\u{fffe}") && !text.contains('\u{fffe}'));
    }
}
