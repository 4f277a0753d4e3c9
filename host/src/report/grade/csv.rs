//! [`csv`]: one line for each robot, for spreadsheets.

use wasmouse_core::GuestText;
use wasmouse_core::guest_text::GuestStr;

use super::super::escape::for_terminal;
use super::sentence::{Report, decimal, points, verdict};

/// A header, and a line for each robot with its points for each criterion.
pub fn csv(report: &Report<'_>) -> String {
    let fixed = [
        "robot",
        "result",
        "passed",
        "points",
        "points_max",
        "percent",
    ];
    let counts = ["matches", "played", "finished", "faults"];
    let header = fixed.into_iter().chain(counts).map(field);
    let criteria = report.rubric.criteria.iter().map(|it| field(&it.name));
    let end = ["reason", "digest"].map(field);
    let mut lines = vec![joined(header.chain(criteria).chain(end))];
    for grade in report.grades {
        let max = u64::from(grade.points_max).max(1);
        let percent = grade.points_thousandths * 100 / max;
        let percent = i64::try_from(percent).unwrap_or(i64::MAX);
        let counts = grade.matches;
        let fields = [
            field(&grade.robot),
            field(verdict(grade)),
            grade.is_passed.to_string(),
            points(grade.points_thousandths),
            grade.points_max.to_string(),
            decimal(percent),
            counts.planned.to_string(),
            counts.played.to_string(),
            counts.finished.to_string(),
            counts.faults.to_string(),
        ];
        let criteria = grade.criteria.iter();
        let criteria = criteria.map(|it| points(it.points_thousandths));
        let fault = grade.faults.first().map(|it| &it.message);
        let reason = grade.participation.reason().or(fault);
        let reason = reason.map(GuestText::as_guest).unwrap_or_default();
        let digest = grade.digest.map_or_else(String::new, |it| it.to_string());
        let end = [field(reason), digest];
        lines.push(joined(fields.into_iter().chain(criteria).chain(end)));
    }
    lines.concat()
}

fn joined(fields: impl Iterator<Item = String>) -> String {
    let fields: Vec<String> = fields.collect();
    fields.join(",") + "\r\n"
}

/// A text as a field. One that a spreadsheet would compute gets an apostrophe.
fn field<'a>(text: impl Into<GuestStr<'a>>) -> String {
    let text = for_terminal(text);
    let is_formula = text.starts_with(['=', '+', '-', '@']);
    let apostrophe = if is_formula { "'" } else { "" };
    let needs_quotes = is_formula || text.contains([',', '"', ' ', ';']);
    if needs_quotes {
        format!("\"{apostrophe}{}\"", text.replace('"', "\"\""))
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::Sample;
    use super::*;

    #[test]
    fn a_name_is_neither_a_formula_nor_two_fields() {
        assert_eq!(field("=1+2"), "\"'=1+2\"");
        assert_eq!(field("a,\"b\"\n"), "\"a,\"\"b\"\"\\n\"");
        assert_eq!(field("ann"), "ann");
    }

    #[test]
    fn every_robot_has_a_line_with_as_many_fields() {
        let sample = Sample::new();
        let text = csv(&sample.report());
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 1 + sample.grades.len());
        let fields = |line: &str| {
            let mut is_quoted = false;
            let commas = line.chars().filter(|&it| {
                is_quoted ^= it == '"';
                it == ',' && !is_quoted
            });
            commas.count()
        };
        for line in &lines {
            assert_eq!(fields(line), fields(lines[0]), "{line}");
        }
    }
}
