//! The standings and the matches as tables for a terminal.

use comfy_table::presets::ASCII_MARKDOWN;
use comfy_table::{
    CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Table, TableStyle,
};
use wasmouse_core::record::MatchRecord;

use super::escape;
use super::standings::{self as standings_text, NONE};
use crate::contest::{ContestInfo, MazeEntry, Names, Standings};

/// How tables are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lines {
    /// With Unicode box drawing.
    Unicode,
    /// With ASCII alone, which is also a table in Markdown.
    Ascii,
}

/// How a table is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// How it is drawn.
    pub lines: Lines,
    /// The width to fit, in columns of the terminal: names and verdicts are wrapped where they
    /// have to be. `None` for as wide as the content.
    pub width: Option<u16>,
}

/// A line under the header and nothing else, so that long tables stay short.
const RULED: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// A column, with text on the left or numbers on the right.
#[derive(Clone, Copy)]
enum Column {
    Text(&'static str),
    Number(&'static str),
}

use Column::{Number, Text};

/// The standings, best first, under a line that says what they are about. Ends with a newline.
pub fn standings(contest: &ContestInfo, standings: &Standings, layout: Layout) -> String {
    let mut table = table(
        layout,
        &[
            Number("Rank"),
            Text("Robot"),
            Number("Matches"),
            Number("Finished"),
            Number("Faults"),
            Number("Mean score"),
            Number("Mean regret"),
        ],
    );
    for line in &standings.lines {
        table.add_row([
            standings_text::rank(line),
            standings_text::robot(contest, line),
            line.matches.to_string(),
            line.finished.to_string(),
            line.faults.to_string(),
            standings_text::mean(line.mean_score_thousandths),
            standings_text::mean(line.mean_regret_thousandths),
        ]);
    }
    let scope = standings_text::scope(contest, standings);
    format!("Standings ({scope})\n\n{table}\n")
}

/// One line for every match, in the order of the document. Ends with a newline.
///
/// The seed is shown when the contest has more than one.
pub fn matches(
    contest: &ContestInfo,
    mazes: &[MazeEntry],
    matches: &[MatchRecord],
    layout: Layout,
) -> String {
    let names = Names::new(&contest.robots, mazes);
    let has_seeds = contest.seeds.count > 1;
    let mut columns = vec![
        Text("Robot"),
        Text("Maze"),
        Text("Verdict"),
        Number("Score"),
        Number("Oracle"),
        Number("Exploration"),
        Number("Speed"),
        Number("Bumps"),
        Number("Fuel"),
    ];
    if has_seeds {
        columns.insert(2, Number("Seed"));
    }
    let mut table = table(layout, &columns);
    for record in matches {
        let score = record.verdict.score();
        let oracle = names.maze(&record.key).and_then(|maze| maze.oracle);
        let number = |score: Option<wasmouse_core::game::Score>| {
            score.map_or_else(|| NONE.to_owned(), |score| score.to_string())
        };
        let mut row = vec![
            escape::for_terminal(names.robot(&record.key)),
            escape::for_terminal(names.maze_name(&record.key)),
            record.verdict.title().into_owned(),
            number(score),
            number(oracle),
            record.steps.exploration.to_string(),
            record.steps.speed.to_string(),
            record.counts.bumps.to_string(),
            (record.fuel.start + record.fuel.steps).to_string(),
        ];
        if has_seeds {
            row.insert(2, record.key.seed.to_string());
        }
        table.add_row(row);
    }
    format!("{table}\n")
}

fn table(layout: Layout, columns: &[Column]) -> Table {
    let mut table = Table::new();
    table.load_style(match layout.lines {
        Lines::Unicode => RULED,
        Lines::Ascii => ASCII_MARKDOWN,
    });
    match layout.width {
        Some(width) => table
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(width),
        None => table.set_content_arrangement(ContentArrangement::Disabled),
    };
    table.set_header(columns.iter().map(|&(Text(name) | Number(name))| name));
    for (column, kind) in table.column_iter_mut().zip(columns) {
        match kind {
            Text(_) => column.set_cell_alignment(CellAlignment::Left),
            Number(_) => {
                column.set_cell_alignment(CellAlignment::Right);
                // A number that is broken over two lines is hard to read.
                column.set_constraint(ColumnConstraint::ContentWidth);
            }
        }
    }
    table
}
