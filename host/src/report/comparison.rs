//! Robots compared with the first of them: text for people, and the JSON of `wasmouse compare`.
//!
//! ```json
//! {
//!   "version": 1,
//!   "rules": "udacity", "seeds": {"first": 0, "count": 1},
//!   "mazes": 300, "penalty_steps": 1000,
//!   "robots": [
//!     {"name": "flood", "digest": "...", "variant": 0, "admitted": true, "matches": 300,
//!      "finished": 300, "faults": 0, "mean_score_thousandths": 24012}
//!   ],
//!   "comparisons": [
//!     {
//!       "first": "flood", "second": "dfs", "verdict": "better",
//!       "mazes": 300, "wins": 280, "ties": 5, "losses": 15,
//!       "difference_thousandths": -9120, "interval_thousandths": [-10001, -8321],
//!       "standard_error_thousandths": 430, "mazes_to_decide": 6,
//!       "by_size": [{"size": 12, "verdict": "better", "mazes": 100}]
//!     }
//!   ]
//! }
//! ```
//!
//! Differences are the first robot's score minus the second's, in thousandths of a step; they are
//! null where too few mazes were played. An entry of `by_size` has the same fields for the mazes
//! with that many cells along a side. `host/schema/comparison.schema.json` describes the document.

use std::collections::BTreeSet;

use serde::Serialize;
use wasmouse_core::{Digest, GuestText};

use super::escape::for_terminal;
use super::json;
use super::paired::PairedNumbers;
use super::standings::NONE;
use super::table::Column::{Number, Text};
use super::table::{self, Layout};
use crate::contest::{
    MazeFilter, Mean, PairedComparison, PairedVerdict, Ranking, ScoreMatrix, Scoring, Seeds,
};
use crate::report::number::counted;

/// The version of the document; raised when a reader of the old one would go wrong.
const VERSION: u32 = 1;

/// The first robot of a matrix compared with each of the others.
#[derive(Serialize)]
pub struct Comparisons {
    version: u32,
    rules: String,
    seeds: Seeds,
    /// All, whoever has played them.
    mazes: u64,
    penalty_steps: u32,
    robots: Vec<Robot>,
    comparisons: Vec<Comparison>,
}

#[derive(Serialize)]
struct Robot {
    name: GuestText,
    digest: Digest,
    variant: u32,
    admitted: bool,
    matches: u64,
    finished: u64,
    faults: u64,
    mean_score_thousandths: Option<i64>,
}

#[derive(Serialize)]
struct Comparison {
    first: GuestText,
    second: GuestText,
    #[serde(flatten)]
    all: PairedNumbers,
    by_size: Vec<OfSize>,
}

#[derive(Serialize)]
struct OfSize {
    size: u8,
    #[serde(flatten)]
    numbers: PairedNumbers,
}

impl Comparisons {
    /// Compares the robots.
    pub fn new(matrix: &ScoreMatrix, scoring: &Scoring) -> Self {
        let ranking = Ranking::new(matrix, scoring, MazeFilter::All, None);
        let mut lines: Vec<_> = ranking.lines.iter().collect();
        lines.sort_by_key(|line| line.robot);
        let robots = lines.into_iter().zip(&matrix.robots);
        let robots = robots.map(|(line, robot)| Robot {
            name: robot.name.clone(),
            digest: robot.digest,
            variant: robot.variant,
            admitted: robot.not_admitted.is_none(),
            matches: line.matches,
            finished: line.finished,
            faults: line.faults,
            mean_score_thousandths: line.mean_score.map(Mean::thousandths),
        });
        let sizes: BTreeSet<u8> = matrix.mazes.iter().map(|maze| maze.dimension).collect();
        let compare = |second: usize| {
            let numbers = |filter: MazeFilter| {
                PairedNumbers::new(&PairedComparison::new(matrix, scoring, filter, (0, second)))
            };
            let by_size = sizes.iter().map(|&size| OfSize {
                size,
                numbers: numbers(MazeFilter::Size(size)),
            });
            Comparison {
                first: matrix.robots[0].name.clone(),
                second: matrix.robots[second].name.clone(),
                all: numbers(MazeFilter::All),
                by_size: by_size.collect(),
            }
        };
        Self {
            version: VERSION,
            rules: matrix.rules.name.clone(),
            seeds: matrix.seeds,
            mazes: matrix.mazes.len() as u64,
            penalty_steps: ranking.penalty_steps,
            robots: robots.collect(),
            comparisons: (1..matrix.robots.len()).map(compare).collect(),
        }
    }

    /// Whether the first robot was found to be that in every comparison.
    pub fn all(&self, verdicts: &[PairedVerdict]) -> bool {
        let mut comparisons = self.comparisons.iter();
        comparisons.all(|it| {
            verdicts
                .iter()
                .any(|verdict| verdict.name() == it.all.verdict)
        })
    }

    /// The document as text, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }

    /// The comparisons for people, each with a table by size of the maze. Ends with a newline.
    pub fn to_text(&self, layout: Layout) -> String {
        let mut text = String::new();
        for comparison in &self.comparisons {
            let [first, second] = [&comparison.first, &comparison.second].map(for_terminal);
            let all = &comparison.all;
            let verdict = match all.verdict {
                verdict if verdict == PairedVerdict::Undecided.name() => verdict.to_owned(),
                verdict => format!("{first} is {verdict}"),
            };
            text += &format!("{first} compared with {second}: {verdict}\n\n");
            text += &comparison.table(layout);
            text.push('\n');
            if let Some(needs) = to_decide(all) {
                text += &format!("\n{needs}\n");
            }
            text.push('\n');
        }
        text += &format!(
            "Difference: the average score of {} minus that of the other robot, in steps, with its \
             95 %\nconfidence interval; negative is better. An unfinished match counts as {} steps.\n",
            self.robots
                .first()
                .map_or_else(String::new, |it| for_terminal(&it.name)),
            self.penalty_steps,
        );
        for robot in &self.robots {
            let unfinished = robot.matches - robot.finished;
            if unfinished > 0 {
                let name = for_terminal(&robot.name);
                let matches = counted(robot.matches, "match");
                text += &format!("{name} did not finish {unfinished} of {matches}.\n");
            }
        }
        text
    }
}

/// What it would take to decide; `None` when it is decided.
fn to_decide(all: &PairedNumbers) -> Option<String> {
    if all.verdict != PairedVerdict::Undecided.name() {
        return None;
    }
    Some(match all.mazes_to_decide {
        _ if all.mazes == 0 => "No maze was played by both robots.".to_owned(),
        None if all.difference_thousandths == Some(0) => {
            "No number of mazes would decide: the difference is 0.".to_owned()
        }
        Some(mazes) if mazes > all.mazes => {
            format!(
                "About {mazes} mazes like these would decide, if the difference stays as it is."
            )
        }
        Some(_) if all.wins + all.losses >= PairedComparison::DECIDING_MAZES_MIN => {
            "More mazes like these would decide, if the difference stays as it is.".to_owned()
        }
        _ => format!(
            "At least {} mazes with a difference are needed to decide.",
            PairedComparison::DECIDING_MAZES_MIN
        ),
    })
}

impl Comparison {
    fn table(&self, layout: Layout) -> String {
        let columns = [
            Text("Size"),
            Number("Mazes"),
            Number("Better"),
            Number("Equal"),
            Number("Worse"),
            Number("Difference"),
            Number("95 % interval"),
            Text("Verdict"),
        ];
        let mut table = table::new_table(&columns, layout.lines);
        let row = |size: String, numbers: &PairedNumbers| {
            let interval = numbers.interval_thousandths;
            let interval = interval.map(|it| it.map(signed));
            [
                size,
                numbers.mazes.to_string(),
                numbers.wins.to_string(),
                numbers.ties.to_string(),
                numbers.losses.to_string(),
                numbers
                    .difference_thousandths
                    .map_or_else(|| NONE.to_owned(), signed),
                interval.map_or_else(|| NONE.to_owned(), |[low, high]| format!("{low} to {high}")),
                numbers.verdict.to_owned(),
            ]
        };
        if self.by_size.len() > 1 {
            for of_size in &self.by_size {
                table.add_row(row(of_size.size.to_string(), &of_size.numbers));
            }
        }
        table.add_row(row("all".to_owned(), &self.all));
        table::lay_out(table, layout.width)
    }
}

/// Thousandths of a step as steps, with a sign unless they are 0.
fn signed(thousandths: i64) -> String {
    let sign = if thousandths > 0 { "+" } else { "" };
    format!("{sign}{}", Mean::fraction(thousandths.into(), 1000))
}

#[cfg(test)]
mod tests {
    use super::super::sample_matrix::matrix;
    use super::super::table::Lines;
    use super::*;

    const ASCII: Layout = Layout {
        lines: Lines::Ascii,
        width: None,
    };

    fn text(matrix: &ScoreMatrix) -> String {
        Comparisons::new(matrix, &Scoring::default()).to_text(ASCII)
    }

    #[test]
    fn a_comparison_has_a_row_for_each_size() {
        let text = text(&matrix(&[12, 12, 12, 12, 12, 12, 14, 14]));
        let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("| ")).collect();
        let starts = ["| Size", "| 12 ", "| 14 ", "| all"];
        assert_eq!(rows.len(), 2 * starts.len(), "{text}");
        for (row, start) in rows.iter().zip(starts) {
            assert!(row.starts_with(start), "{row}");
        }
        assert!(text.contains("a compared with b: a is better\n"), "{text}");
        assert!(
            text.contains("b did not finish 1 of 8 matches.\n"),
            "{text}"
        );
    }

    #[test]
    fn an_open_comparison_says_what_it_needs() {
        for (mazes, needs) in [
            (3, "About 24 mazes like these would decide"),
            (1, "At least 6 mazes with a difference are needed"),
            (0, "No maze was played by both robots.\n"),
        ] {
            let text = text(&matrix(&vec![12; mazes]));
            assert!(text.contains("a compared with b: undecided\n"), "{text}");
            assert!(text.contains(needs), "{text}");
        }
        let text = text(&matrix(&[12; 8]));
        let needs = "No number of mazes would decide: the difference is 0.\n";
        assert!(text.contains(needs), "{text}");
    }

    #[test]
    fn requirements_hold_for_all_pairs() {
        let comparisons = Comparisons::new(&matrix(&[12; 8]), &Scoring::default());
        let verdicts: Vec<&str> = comparisons
            .comparisons
            .iter()
            .map(|it| it.all.verdict)
            .collect();
        assert_eq!(verdicts, ["better", "undecided"]);
        assert!(!comparisons.all(&[PairedVerdict::Better]));
        assert!(comparisons.all(&[PairedVerdict::Better, PairedVerdict::Undecided]));
    }

    #[test]
    fn untrusted_names_are_escaped() {
        let mut matrix = matrix(&[12; 8]);
        matrix.robots[1].name = "b\u{1b}[31m\nhint: x".into();
        let text = text(&matrix);
        let is_harmful = |c: char| c.is_control() && c != '\n';
        assert!(
            !text.contains(is_harmful) && !text.contains("\nhint"),
            "{text:?}"
        );
    }
}
