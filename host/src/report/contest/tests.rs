//! What holds for the reports of all formats.

use proptest::prelude::*;
use serde_json::Value;
use wasmouse_core::Digest;
use wasmouse_core::game::Ruleset;

use super::document::{ContestReport, ReportOptions};
use super::sample::{HOSTILE, Sample};
use super::{html, json, markdown, matches_csv, robots_csv, table};
use crate::contest::ScoreMatrix;
use crate::report::table::{Layout, Lines};

const LAYOUT: Layout = Layout {
    lines: Lines::Unicode,
    width: Some(80),
};

/// All formats by name.
fn formats(report: &ContestReport<'_>) -> [(&'static str, String); 6] {
    [
        ("table", table(report, LAYOUT)),
        ("markdown", markdown(report)),
        ("robots.csv", robots_csv(report)),
        ("matches.csv", matches_csv(report)),
        ("json", json(report)),
        ("html", html(report)),
    ]
}

/// The values of a CSV file by line.
fn fields(csv: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(csv.as_bytes());
    let records = reader
        .records()
        .map(|record| record.expect("rows of one length"));
    records
        .map(|record| record.iter().map(str::to_owned).collect())
        .collect()
}

/// No format may have a control character, an unescaped element or a formula, whatever is in a
/// name.
fn check_harmless(untrusted: &str) {
    let sample = Sample::new(untrusted);
    let plain = Sample::new("x");
    let report = sample.report(ReportOptions::default());
    let expected = formats(&plain.report(ReportOptions::default()));
    for ((format, text), (_, expected)) in formats(&report).into_iter().zip(expected) {
        let harmful =
            |c: char| (c.is_control() && c != '\n') || ('\u{202a}'..='\u{202e}').contains(&c);
        assert!(!text.contains(harmful), "{format}: {text}");
        match format {
            "html" => {
                let tags = |html: &str| html.matches('<').count();
                assert_eq!(tags(&text), tags(&expected), "{text}");
            }
            "json" => {
                let value: Value = serde_json::from_str(&text).expect("it is JSON");
                let name = value.pointer("/mazes/1/name").and_then(Value::as_str);
                assert_eq!(name, Some(untrusted));
            }
            "robots.csv" | "matches.csv" => {
                let (rows, expected) = (fields(&text), fields(&expected));
                assert_eq!(rows.len(), expected.len(), "{text}");
                for field in rows.iter().flatten() {
                    let is_number = field.parse::<f64>().is_ok();
                    let is_formula = field.trim_start().starts_with(['=', '+', '-', '@']);
                    assert!(is_number || !is_formula, "{field}");
                }
            }
            "table" | "markdown" => {}
            _ => unreachable!("all formats are checked"),
        }
        if format == "markdown" {
            assert_eq!(text.lines().count(), expected.lines().count(), "{text}");
        }
    }
}

#[test]
fn hostile_text_is_harmless_in_every_format() {
    check_harmless(HOSTILE);
}

/// Any characters, and often those that mean something somewhere.
fn texts() -> impl Strategy<Value = String> {
    let special: Vec<char> = HOSTILE.chars().collect();
    let character = prop_oneof![any::<char>(), proptest::sample::select(special)];
    let characters = proptest::collection::vec(character, 1..24);
    characters.prop_map(String::from_iter)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 32,
        rng_seed: proptest::test_runner::RngSeed::Fixed(0),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_text_is_harmless_in_every_format(text in texts()) {
        // Names that are already there would be another contest.
        let names = ["flood", "looper", "rejected", "unlucky", "open", "no way"];
        prop_assume!(!names.contains(&text.as_str()));
        check_harmless(&text);
    }
}

#[test]
fn what_is_hidden_is_in_no_format() {
    let mut sample = Sample::new("untrusted-text");
    sample.matrix.robots[1].name = "robot-name".into();
    sample.matrix.robots[1].digest = Digest::of(b"a file that nothing else is made from");
    let hidden = ReportOptions {
        hide_names: true,
        hide_hidden_mazes: true,
        ..ReportOptions::default()
    };
    let digest = sample.matrix.robots[1].digest.to_string();
    for (format, text) in formats(&sample.report(hidden)) {
        for secret in [
            "flood",
            "robot-name",
            "Ann",
            "secret-",
            "too slow",
            "no process",
            "exceeded",
            &digest,
        ] {
            assert!(!text.contains(secret), "{format} shows {secret}:\n{text}");
        }
        assert!(
            format == "matches.csv" || text.contains(&digest[..8]),
            "{format}:\n{text}"
        );
        // Plots show everything.
        assert!(!text.contains("data:image"), "{format}:\n{text}");
    }
    // Without the options they are all there.
    let shown = formats(&sample.report(ReportOptions::default()));
    let [json, html] =
        ["json", "html"].map(|name| &shown.iter().find(|it| it.0 == name).expect("a format").1);
    assert!(html.contains("data:image"), "{html}");
    for secret in [
        "flood",
        "robot-name",
        "Ann",
        "secret-1",
        "too slow",
        "no process",
        "exceeded",
        &digest,
    ] {
        assert!(json.contains(secret) && html.contains(secret), "{secret}");
    }
}

#[test]
fn only_the_top_is_shown() {
    let sample = Sample::new("second");
    let options = ReportOptions {
        show_top: Some(1),
        frozen: Some("since noon".to_owned()),
        ..ReportOptions::default()
    };
    for (format, text) in formats(&sample.report(options)) {
        // The second is the first of its class.
        for gone in ["looper", "rejected", "unlucky"] {
            assert!(!text.contains(gone), "{format} shows {gone}:\n{text}");
        }
        assert!(text.contains("flood"), "{format}:\n{text}");
        if ["table", "markdown", "html"].contains(&format) {
            assert!(
                text.contains("Only the top 1 are shown; 3 robots are not."),
                "{format}:\n{text}"
            );
            assert!(text.contains("since noon"), "{format}:\n{text}");
        }
    }
}

#[test]
fn the_table_fits_80_columns() {
    for lines in [Lines::Unicode, Lines::Ascii] {
        let sample = Sample::new("a-name-that-is-much-longer-than-its-column-could-ever-be");
        let report = sample.report(ReportOptions::default());
        let text = table(
            &report,
            Layout {
                lines,
                width: Some(80),
            },
        );
        let rows = text.lines().skip_while(|line| !line.contains("Rank"));
        let rows: Vec<&str> = rows.take_while(|line| !line.is_empty()).collect();
        assert!(rows.len() > 6, "{text}");
        for row in rows {
            assert!(row.chars().count() <= 80, "{row}\n{text}");
        }
        let is_ascii = text
            .lines()
            .take_while(|line| !line.starts_with("Ranked"))
            .all(str::is_ascii);
        assert_eq!(is_ascii, lines == Lines::Ascii, "{text}");
    }
}

#[test]
fn markdown_text_is_in_code_spans() {
    let sample = Sample::new("|`@all <b> [a](b)");
    let text = markdown(&sample.report(ReportOptions::default()));
    assert!(
        text.contains("| `` \\|`@all <b> [a](b) `` |")
            || text.contains("| ``\\|`@all <b> [a](b)`` |"),
        "{text}"
    );
    assert!(
        text.contains("\n## Class ``class |`@all <b> [a](b)``\n"),
        "{text}"
    );
}

#[test]
fn a_page_of_nothing_is_a_page() {
    let sample = Sample::new("x");
    let matrix = ScoreMatrix::new(Ruleset::default(), sample.matrix.seeds, Vec::new());
    let report = ContestReport::new(
        "nothing",
        &matrix,
        &sample.scoring,
        &sample.engine,
        0,
        ReportOptions::default(),
    );
    for (format, text) in formats(&report) {
        assert!(!text.is_empty() && !text.contains("NaN%"), "{format}");
    }
}
