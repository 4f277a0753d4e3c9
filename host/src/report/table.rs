//! The standings and the matches as tables for a terminal.

use comfy_table::presets::ASCII_MARKDOWN;
use comfy_table::{
    CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Table, TableStyle,
};
use wasmouse_core::record::MatchRecord;
use wasmouse_core::replay::Replay;

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
pub(super) enum Column {
    Text(&'static str),
    Number(&'static str),
}

use Column::{Number, Text};

/// The standings, best first, under a line that says what they are about. Ends with a newline.
pub fn standings(contest: &ContestInfo, standings: &Standings, layout: Layout) -> String {
    let mut table = new_table(
        &[
            Number("Rank"),
            Text("Robot"),
            Number("Matches"),
            Number("Finished"),
            Number("Faults"),
            Number("Mean score"),
            Number("Mean regret"),
        ],
        layout.lines,
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
    format!("Standings ({scope})\n\n{}\n", lay_out(table, layout.width))
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
    let mut table = new_table(&columns, layout.lines);
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
    lay_out(table, layout.width) + "\n"
}

/// Matches that can be watched.
pub fn replays(replays: &[Replay], layout: Layout) -> String {
    let columns = [
        Text("Robot"),
        Text("Maze"),
        Number("Seed"),
        Text("Verdict"),
        Number("Score"),
        Number("Exploration"),
        Number("Speed"),
        Number("Journal"),
    ];
    let mut table = new_table(&columns, layout.lines);
    for replay in replays {
        let parts = replay.parts();
        let (record, steps) = (&parts.record, parts.record.steps);
        let score = record.verdict.score();
        table.add_row(vec![
            escape::for_terminal(&parts.robot),
            escape::for_terminal(&parts.maze_name),
            record.key.seed.to_string(),
            record.verdict.title().into_owned(),
            score.map_or_else(|| NONE.to_owned(), |score| score.to_string()),
            steps.exploration.to_string(),
            steps.speed.to_string(),
            parts.journal.len().to_string(),
        ]);
    }
    lay_out(table, layout.width) + "\n"
}

/// A table without rows.
pub(super) fn new_table(columns: &[Column], lines: Lines) -> Table {
    let mut table = Table::new();
    table
        .load_style(match lines {
            Lines::Unicode => RULED,
            Lines::Ascii => ASCII_MARKDOWN,
        })
        .set_content_arrangement(ContentArrangement::Disabled)
        .set_header(columns.iter().map(|&(Text(name) | Number(name))| name));
    for (column, kind) in table.column_iter_mut().zip(columns) {
        if lines == Lines::Unicode {
            column.set_padding((0, 1));
        }
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

/// The table as text, made to fit the width when it is too wide.
pub(super) fn lay_out(mut table: Table, width: Option<u16>) -> String {
    let wide = table.trim_fmt();
    match width {
        Some(width) if wide.lines().any(|line| line.chars().count() > width.into()) => {
            for column in table.column_iter_mut() {
                column.set_padding((0, 0));
            }
            table.set_content_arrangement(ContentArrangement::Dynamic);
            table.set_width(width).trim_fmt()
        }
        _ => wide,
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::results;
    use super::*;
    use crate::contest::Results;

    const ASCII: Layout = Layout {
        lines: Lines::Ascii,
        width: None,
    };

    /// The sample with a short name instead of the hostile one.
    fn sample() -> Results {
        let mut results = results();
        results.contest.robots[1].name = "b".into();
        results.summary.standings.lines[1].robot = "b".into();
        results.summary.mazes[1].name = "gen:tree:16:1".into();
        for record in &mut results.matches {
            record.key.seed = 0;
            record.fuel.steps = 912_345;
        }
        results
    }

    #[track_caller]
    fn check(text: &str, expected: &str) {
        assert_eq!(text, expected.trim_start_matches('\n'), "\n{text}");
    }

    #[test]
    fn partial_standings_say_what_they_are_about() {
        let mut results = sample();
        let table =
            |results: &Results| standings(&results.contest, &results.summary.standings, ASCII);
        check(
            &table(&results),
            "
Standings (partial: ranked over 1 of 200 mazes that every robot has played)

| Rank | Robot               | Matches | Finished | Faults | Mean score | Mean regret |
|------|---------------------|---------|----------|--------|------------|-------------|
|    1 | a                   |       1 |        1 |      0 |     19.999 |      -0.001 |
|    2 | b                   |       1 |        0 |      0 |          - |           - |
|    - | rejected (rejected) |       0 |        0 |      0 |          - |           - |
",
        );
        results.summary.standings.partial = false;
        assert!(table(&results).starts_with("Standings (ranked over 1 maze)\n"));
    }

    #[test]
    fn every_match_has_a_line() {
        let mut results = sample();
        let table = |results: &Results, layout| {
            let Results {
                contest,
                matches: records,
                summary,
                ..
            } = results;
            matches(contest, &summary.mazes, records, layout)
        };
        results.contest.seeds.count = 1;
        check(&table(&results, ASCII), "
| Robot | Maze          | Verdict                      |  Score | Oracle | Exploration | Speed | Bumps |   Fuel |
|-------|---------------|------------------------------|--------|--------|-------------|-------|-------|--------|
| a     | test_maze_01  | finished                     | 20.667 | 17.600 |         110 |    17 |     0 | 912346 |
| b     | test_maze_01  | fault: panic                 |      - | 17.600 |         110 |    17 |     0 | 912346 |
| a     | gen:tree:16:1 | budget used up, goal reached |      - |      - |         110 |    17 |     0 | 912346 |
| b     | gen:tree:16:1 | budget used up               |      - |      - |         110 |    17 |     0 | 912346 |
");
        results.contest.seeds.count = 2;
        results.matches[3].key.seed = 7;
        let unicode = Layout {
            lines: Lines::Unicode,
            width: Some(80),
        };
        check(
            &table(&results, unicode),
            "
Robot Maze         Seed Verdict      Score Oracle Exploration Speed Bumps   Fuel
────────────────────────────────────────────────────────────────────────────────
a     test_maze_01    0 finished    20.667 17.600         110    17     0 912346
b     test_maze_01    0 fault:           - 17.600         110    17     0 912346
                        panic
a     gen:tree:16:    0 budget used      -      -         110    17     0 912346
      1                 up, goal
                        reached
b     gen:tree:16:    7 budget used      -      -         110    17     0 912346
      1                 up
",
        );
    }

    #[test]
    fn untrusted_names_are_escaped() {
        let results = results();
        let text = standings(&results.contest, &results.summary.standings, ASCII)
            + &matches(
                &results.contest,
                &results.summary.mazes,
                &results.matches,
                ASCII,
            );
        assert!(
            !text.contains(|c: char| c.is_control() && c != '\n'),
            "{text:?}"
        );
    }
}
