//! [`markdown()`]: the standings of a contest as GitHub Flavored Markdown.

use std::fmt::Write as _;

use wasmouse_core::guest_text::GuestStr;

use super::document::ContestReport;
use super::view::{Part, View, state};
use super::words;
use crate::report::escape::for_terminal;
use crate::report::number::counted;

/// The rankings as tables, then robots without a rank, faults and how the ranks were decided.
///
/// All text of others is in code spans: nothing in it is markup, a link or a mention.
pub fn markdown(report: &ContestReport<'_>) -> String {
    let view = View::new(report);
    let mut text = String::new();
    let mut line = |line: &str| writeln!(text, "{line}").expect("writing to a string cannot fail");
    line(&format!("# Contest {}\n", code(report.name)));
    let matches = counted(view.matches_played(), "match");
    let robots = counted(view.robots.len() as u64, "robot");
    let class = report.matrix.rules.fuel_class();
    let class = class.map_or_else(String::new, |it| format!(", fuel class {}", it.name()));
    line(&format!(
        "{robots}, {}, {matches}; ruleset {} version {}{class}.",
        counted(report.matrix.mazes.len() as u64, "maze"),
        code(&report.matrix.rules.name),
        report.matrix.rules.version
    ));
    if let Some(missing) = words::missing(&view) {
        line(&format!("\n**{missing}**"));
    }
    for sentence in words::left_out(&view) {
        line(&format!("\n{}", plain(&sentence)));
    }
    for part in view.parts() {
        line(&format!("\n## {}\n", heading(&part)));
        line(&format!("Scope: {}.\n", words::scope(&part)));
        ranking(&view, &part, &mut line);
    }
    let comparisons = view.comparisons();
    if !comparisons.is_empty() {
        line("\n## Comparisons\n");
    }
    for compared in comparisons {
        line(&format!("- {}", code(&words::comparison(&view, compared))));
    }
    let (unranked, faults) = (view.unranked(), view.faults());
    if !unranked.is_empty() {
        line("\n## Not ranked\n");
    }
    for unranked in unranked {
        let why = words::unranked(&unranked);
        line(&format!(
            "- {}: {}",
            code(view.name(unranked.robot)),
            code(&why)
        ));
    }
    if !faults.is_empty() {
        line("\n## Faults\n");
    }
    for fault in faults {
        let what = words::fault(&fault);
        line(&format!(
            "- {}: {}",
            code(view.name(fault.robot)),
            code(&what)
        ));
    }
    line("\n## Method\n");
    line(&words::ranked_by(
        report.scoring,
        report.overall.penalty_steps,
    ));
    line(&words::scored_by(&report.matrix.rules));
    line(&format!(
        "Engine {}, {}.",
        code(report.engine.as_str()),
        words::seeds(report.matrix.seeds)
    ));
    text
}

fn heading(part: &Part<'_>) -> String {
    match (part.set, part.class) {
        (Some(set), _) => format!("Set {}", code(set)),
        (_, Some(class)) => format!("Class {}", code(class)),
        _ => "Overall".to_owned(),
    }
}

fn ranking(view: &View<'_>, part: &Part<'_>, line: &mut impl FnMut(&str)) {
    let value = words::value_title(view.report.scoring.method);
    line(&format!(
        "| Rank | Robot | {value} | Finished | Faults | Median | Mean regret | Fuel per step |"
    ));
    line("|---:|:---|---:|---:|---:|---:|---:|---:|");
    for it in &part.lines {
        let state = state(view.robot(it.robot), it.state);
        let state = state.map_or_else(String::new, |state| format!(" ({state})"));
        line(&format!(
            "| {} | {}{state} | {} | {}/{} | {} | {} | {} | {} |",
            words::rank(it),
            cell(view.name(it.robot)),
            words::mean(it.value),
            it.finished,
            it.matches,
            it.faults,
            words::mean(it.percentiles.map(|it| it.p50)),
            words::mean(it.mean_regret),
            words::whole(it.step_fuel_mean),
        ));
    }
}

/// Text as a code span in a cell of a table.
fn cell<'a>(text: impl Into<GuestStr<'a>>) -> String {
    // A backslash before a bar ends the cell after all, so the bar is written by its number there.
    code(text).replace("\\|", "\\u{7c}").replace('|', "\\|")
}

/// Text as a code span.
fn code<'a>(text: impl Into<GuestStr<'a>>) -> String {
    let escaped = for_terminal(text);
    if escaped.trim().is_empty() {
        return "(empty)".to_owned();
    }
    let runs = escaped.split(|it| it != '`').map(str::len);
    let fence = "`".repeat(runs.max().unwrap_or(0) + 1);
    let needs_space = escaped.starts_with(['`', ' ']) || escaped.ends_with(['`', ' ']);
    let space = if needs_space { " " } else { "" };
    format!("{fence}{space}{escaped}{space}{fence}")
}

/// Text whose punctuation means nothing.
fn plain<'a>(text: impl Into<GuestStr<'a>>) -> String {
    let text = for_terminal(text);
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            // A backslash does not keep these from making mentions and links.
            '@' | ':' => write!(escaped, "&#{};", u32::from(character))
                .expect("writing to a string cannot fail"),
            '.' | ',' | ';' | '(' | ')' | '-' => escaped.push(character),
            _ => {
                if character.is_ascii_punctuation() {
                    escaped.push('\\');
                }
                escaped.push(character);
            }
        }
    }
    escaped
}
