//! The robots and the matches of a contest as CSV (RFC 4180 with line feeds), for spreadsheets and
//! data frames.
//!
//! Text is escaped as for terminals. Text that a spreadsheet would take for a formula, because it
//! begins with `=`, `+`, `-` or `@`, has an apostrophe in front; numbers never do. Programs that
//! need names as they are read the JSON instead. Empty fields are values that do not exist.

use csv::{Terminator, Writer, WriterBuilder};
use wasmouse_core::guest_text::GuestStr;

use super::address::Addresses;
use super::document::ContestReport;
use super::view::{View, state};
use super::words;
use crate::contest::{Mean, Outcome};
use crate::report::escape::for_terminal;

/// One line for each robot, in the order of the overall ranking, after a line with the names of
/// the columns. Scores and regrets are in steps with three decimals, rates from 0 to 1.
pub fn robots_csv(report: &ContestReport<'_>) -> String {
    let view = View::new(report);
    let mut csv = Csv::new(&[
        "rank",
        "robot",
        "author",
        "class",
        "state",
        "value",
        "matches",
        "finished",
        "budget_used_up",
        "goal_reached",
        "faults",
        "unplayed",
        "finish_rate",
        "mean_score",
        "mean_finished_score",
        "p10_score",
        "p25_score",
        "median_score",
        "p75_score",
        "p90_score",
        "rank_points",
        "mean_regret",
        "finished_regret",
        "finished_exploration_regret",
        "finished_speed_regret",
        "mean_exploration_steps",
        "optimal_speed_runs",
        "step_fuel_mean",
        "step_fuel_max",
        "memory_bytes_max",
        "variant",
        "sha256",
    ]);
    for &robot in &view.robots {
        let (line, entry) = (view.line(robot), view.robot(robot));
        let percentiles = line.percentiles;
        let regret = line.finished_regret;
        csv.row(&[
            number(line.rank),
            text(view.name(robot)),
            text(view.author(robot).unwrap_or_default()),
            text(entry.class.as_ref().map(GuestStr::from).unwrap_or_default()),
            state(entry, line.state).unwrap_or("ranked").to_owned(),
            mean(line.value),
            line.matches.to_string(),
            line.finished.to_string(),
            line.budget_used_up.to_string(),
            line.goal_reached.to_string(),
            line.faults.to_string(),
            line.unplayed.to_string(),
            mean(line.finish_rate),
            mean(line.mean_score),
            mean(line.mean_finished_score),
            mean(percentiles.map(|it| it.p10)),
            mean(percentiles.map(|it| it.p25)),
            mean(percentiles.map(|it| it.p50)),
            mean(percentiles.map(|it| it.p75)),
            mean(percentiles.map(|it| it.p90)),
            mean(line.rank_points),
            mean(line.mean_regret),
            mean(regret.map(|it| it.total)),
            mean(regret.map(|it| it.exploration)),
            mean(regret.map(|it| it.speed)),
            mean(line.mean_exploration_steps),
            line.optimal_speed_runs.to_string(),
            mean(line.step_fuel_mean),
            line.step_fuel_max.to_string(),
            line.memory_bytes_max.to_string(),
            entry.variant.to_string(),
            number(view.digest(robot)),
        ]);
    }
    csv.finish()
}

/// One line for each match that was played, in the order of mazes, seeds and robots, after a line
/// with the names of the columns. Matches in hidden mazes are left out.
pub fn matches_csv(report: &ContestReport<'_>) -> String {
    let view = View::new(report);
    let matrix = report.matrix;
    let addresses = Addresses::new(report);
    let mut csv = Csv::new(&[
        "robot",
        "maze",
        "set",
        "seed",
        "outcome",
        "fault",
        "score",
        "oracle",
        "regret",
        "exploration_steps",
        "speed_steps",
        "start_fuel",
        "steps_fuel",
        "step_fuel_max",
        "memory_bytes",
        "match",
    ]);
    for &maze in &view.mazes {
        let entry = view.maze(maze);
        for seed in 0..matrix.seeds.count {
            for &robot in &view.robots {
                let Some(played) = matrix.get(robot, maze, seed) else {
                    continue;
                };
                let score = played.score(&matrix.rules).map(Mean::from);
                let oracle = entry.oracle.map(Mean::from);
                let regret = score.zip(oracle).map(|(score, oracle)| score.minus(oracle));
                let fault = match played.outcome {
                    Outcome::Fault(kind) => kind.name(),
                    _ => "",
                };
                let address =
                    (!report.options.hide_names).then(|| addresses.get(robot, maze, seed));
                csv.row(&[
                    text(view.name(robot)),
                    text(&entry.name),
                    text(&matrix.sets[entry.set].name),
                    matrix.seeds.get(seed).to_string(),
                    words::outcome(played).to_owned(),
                    fault.to_owned(),
                    mean(score),
                    mean(oracle),
                    mean(regret),
                    played.steps.exploration.to_string(),
                    played.steps.speed.to_string(),
                    played.fuel.start.to_string(),
                    played.fuel.steps.to_string(),
                    played.fuel.step_max.to_string(),
                    played.memory_bytes.to_string(),
                    number(address),
                ]);
            }
        }
    }
    csv.finish()
}

struct Csv(Writer<Vec<u8>>);

impl Csv {
    fn new(columns: &[&str]) -> Self {
        let terminator = Terminator::Any(b'\n');
        let mut csv = Self(
            WriterBuilder::new()
                .terminator(terminator)
                .from_writer(Vec::new()),
        );
        csv.row(columns);
        csv
    }

    fn row(&mut self, row: &[impl AsRef<[u8]>]) {
        self.0
            .write_record(row)
            .expect("memory takes rows of one length");
    }

    fn finish(self) -> String {
        let bytes = self.0.into_inner().expect("memory takes everything");
        String::from_utf8(bytes).expect("all fields are text")
    }
}

fn text<'a>(text: impl Into<GuestStr<'a>>) -> String {
    let escaped = for_terminal(text);
    // Control characters, which can also begin a formula, are escaped by now. Spaces do not
    // keep every spreadsheet from looking behind them.
    if escaped.trim_start().starts_with([
        '=', '+', '-', '@', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}',
    ]) {
        format!("'{escaped}")
    } else {
        escaped
    }
}

fn number(number: Option<impl ToString>) -> String {
    number.map(|number| number.to_string()).unwrap_or_default()
}

fn mean(mean: Option<Mean>) -> String {
    number(mean)
}
