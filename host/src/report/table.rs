//! Contests as tables for a terminal: the standings, and the matches.

use comfy_table::presets::ASCII_MARKDOWN;
use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};

use super::visible;
use crate::contest::{Contest, MatchResult, Standing};
use crate::robot::Verdict;

/// How tables are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lines {
    /// With Unicode box drawing.
    Unicode,
    /// With ASCII alone, which is also a table in Markdown.
    Ascii,
}

/// A line under the header and nothing else, so that long tables stay short.
const RULED: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

fn table(lines: Lines, header: &[&str], left: usize) -> Table {
    let mut table = Table::new();
    table
        .load_style(match lines {
            Lines::Unicode => RULED,
            Lines::Ascii => ASCII_MARKDOWN,
        })
        .set_content_arrangement(ContentArrangement::Disabled)
        .set_header(header.to_vec());
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_cell_alignment(if index < left {
            CellAlignment::Left
        } else {
            CellAlignment::Right
        });
    }
    table
}

/// The standings, best first. Ends with a newline.
pub fn standings(contest: &Contest, standings: &[Standing], lines: Lines) -> String {
    let header = [
        "rank",
        "robot",
        "finished",
        "mean score",
        "mean regret",
        "faults",
    ];
    let mut table = table(lines, &header, 2);
    for line in standings {
        let rank = line
            .rank
            .map_or_else(|| "-".into(), |rank| rank.to_string());
        let mean = |mean: Option<crate::contest::Mean>| {
            mean.map_or_else(|| "-".to_owned(), |mean| mean.to_string())
        };
        let finished = match line.rank {
            Some(_) => format!("{} of {}", line.finished, line.matches),
            None => "refused".into(),
        };
        table.add_row([
            rank,
            visible(&contest.entrants[line.entrant].name),
            finished,
            mean(line.score),
            mean(line.regret),
            line.faults.to_string(),
        ]);
    }
    format!("{table}\n")
}

/// One line for every match, in the contest's order. Ends with a newline.
pub fn matches(contest: &Contest, results: &[MatchResult], lines: Lines) -> String {
    let with_seed = contest.seeds.len() > 1;
    let mut header = vec![
        "robot", "maze", "verdict", "score", "run 1", "run 2", "bumps", "fuel",
    ];
    if with_seed {
        header.insert(2, "seed");
    }
    let mut table = table(lines, &header, if with_seed { 4 } else { 3 });
    for result in results {
        let outcome = &result.outcome;
        let score = match &outcome.verdict {
            Verdict::Finished(score) => score.to_string(),
            Verdict::BudgetUsedUp { .. } | Verdict::Fault(_) => "-".into(),
        };
        let mut row = vec![
            visible(&contest.entrants[result.entrant].name),
            visible(&contest.mazes[result.maze].name),
            outcome.verdict.title().into_owned(),
            score,
            outcome.steps[0].to_string(),
            outcome.steps[1].to_string(),
            outcome.counts.bumps.to_string(),
            (outcome.fuel.start + outcome.fuel.steps).to_string(),
        ];
        if with_seed {
            row.insert(2, result.seed.to_string());
        }
        table.add_row(row);
    }
    format!("{table}\n")
}
