//! [`table()`]: the standings of a contest for a terminal.

use std::fmt::Write as _;

use wasmouse_core::guest_text;

use super::document::ContestReport;
use super::view::{Part, View, state};
use super::words;
use crate::report::escape::for_terminal;
use crate::report::table::{Column, Layout, lay_out, new_table};

/// The rankings, each under a line that says what it is about, then robots without a rank, faults
/// and what is not shown. Fits the width of the layout; names are wrapped where they have to be.
/// Ends with a newline.
pub fn table(report: &ContestReport<'_>, layout: Layout) -> String {
    let view = View::new(report);
    let mut text = String::new();
    let mut line = |line: &str| writeln!(text, "{line}").expect("writing to a string cannot fail");
    line(&for_terminal(report.name));
    if let Some(missing) = words::missing(&view) {
        line(&missing);
    }
    for part in view.parts() {
        let (title, scope) = (words::part_title(&part), words::scope(&part));
        line(&format!("\n{} ({scope})\n", for_terminal(&title)));
        line(&ranking(&view, &part, layout));
    }
    line("");
    let rules = for_terminal(&report.matrix.rules.name);
    line(&format!(
        "Ruleset {rules}, {}.",
        words::fuel(&report.matrix.rules)
    ));
    line(&words::ranked_by(
        report.scoring,
        report.overall.penalty_steps,
    ));
    for compared in view.comparisons() {
        let what = words::comparison(&view, compared);
        line(&for_terminal(&guest_text!("compared: {}", what)));
    }
    for unranked in view.unranked() {
        let why = words::unranked(&unranked);
        let name = view.name(unranked.robot);
        line(&for_terminal(&guest_text!("`{}`: {}", name, why)));
    }
    for fault in view.faults() {
        let what = words::fault(&fault);
        let name = view.name(fault.robot);
        line(&for_terminal(&guest_text!("fault: `{}`: {}", name, what)));
    }
    for sentence in words::left_out(&view) {
        line(&for_terminal(&sentence));
    }
    text
}

fn ranking(view: &View<'_>, part: &Part<'_>, layout: Layout) -> String {
    let columns = [
        Column::Number("Rank"),
        Column::Text("Robot"),
        Column::Number(words::value_title(view.report.scoring.method)),
        Column::Number("Finished"),
        Column::Number("Faults"),
        Column::Number("Median"),
        Column::Number("Regret"),
        Column::Number("Fuel/step"),
    ];
    let mut table = new_table(&columns, layout.lines);
    for line in &part.lines {
        let name = view.name(line.robot);
        let name = match state(view.robot(line.robot), line.state) {
            Some(state) => guest_text!("{} ({})", name, state),
            None => name.into(),
        };
        table.add_row([
            words::rank(line),
            for_terminal(&name),
            words::mean(line.value),
            format!("{}/{}", line.finished, line.matches),
            line.faults.to_string(),
            words::mean(line.percentiles.map(|it| it.p50)),
            words::mean(line.mean_regret),
            words::whole(line.step_fuel_mean),
        ]);
    }
    lay_out(table, layout.width)
}
