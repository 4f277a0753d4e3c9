//! Whether what a criterion is about can be used: baselines, and the number of mazes.

use std::path::Path;

use wasmouse_core::record::MatchRecord;

use super::super::input;
use crate::contest::MazeSource;
use crate::contest::grade::{Baseline, DECIDING_MAZES_MIN, Expectation, Rubric};
use crate::report::results_json::read_results;

/// The largest file of results that is read. A match takes less than a kilobyte.
const RESULTS_BYTES_MAX: u64 = 256 << 20;

/// Reads a baseline, and checks that it has all matches in some mazes.
///
/// # Errors
///
/// What is wrong with it.
pub fn baseline<'a>(
    path: &Path,
    robot: Option<&str>,
    rubric: &Rubric,
    mazes: impl Iterator<Item = &'a MazeSource>,
) -> Result<Baseline, String> {
    let failed = |error: &dyn std::fmt::Display| format!("the baseline cannot be used: {error}");
    let bytes = input::read_file(path, RESULTS_BYTES_MAX).map_err(|error| failed(&error))?;
    let is_lines = path.extension().is_some_and(|it| it == "jsonl");
    let baseline = if is_lines {
        let records = lines(&bytes).map_err(|error| failed(&error))?;
        Baseline::new(&records, |_| None, robot, &rubric.rules)
    } else {
        let results = read_results(&bytes).map_err(|error| failed(&error))?;
        let names = results.names();
        let name = |record: &MatchRecord| Some(names.robot(&record.key));
        Baseline::new(&results.matches, name, robot, &rubric.rules)
    };
    let baseline = baseline.map_err(|error| failed(&error))?;
    for maze in mazes {
        let prepared = maze.prepare(&rubric.rules.game);
        let required = baseline.require(&prepared.name, prepared.digest, rubric.seeds);
        required.map_err(|error| failed(&error))?;
    }
    Ok(baseline)
}

/// The records of a JSON Lines file.
fn lines(bytes: &[u8]) -> Result<Vec<MatchRecord>, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let lines = text.lines().enumerate();
    let lines = lines.filter(|(_, line)| !line.trim().is_empty());
    let read = |(index, line): (usize, &str)| {
        serde_json::from_str(line).map_err(|error| format!("line {}: {error}", index + 1))
    };
    lines.map(read).collect()
}

/// Checks that there are enough mazes for an expectation.
///
/// # Errors
///
/// When there are not.
pub fn is_enough(expectation: &Expectation, mazes: usize) -> Result<(), String> {
    let is_statistical = matches!(expectation, Expectation::NoWorseThan { .. });
    if is_statistical && mazes < DECIDING_MAZES_MIN {
        return Err(format!(
            "`no_worse_than` needs at least {DECIDING_MAZES_MIN} mazes, found {mazes}"
        ));
    }
    Ok(())
}
