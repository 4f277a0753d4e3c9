//! `--explain`: the only match of a contest, step by step, with the first fault.

use wasmouse_core::record::trace;
use wasmouse_engine::LocalExecutor;

use super::again::play_again;
use super::failure::Failure;
use super::robots::RobotSpec;
use super::{backtrace, output};
use crate::contest::{FaultSummary, Plan, Player, Results};
use crate::report::explain::{Explained, explain};

/// Plays the only match of a contest again, and prints it with the backtrace of its fault.
///
/// # Errors
///
/// When there is not exactly one match, or it cannot be played again.
pub fn print(
    plan: &Plan,
    players: &[Player],
    (specs, executor): (&[RobotSpec], &LocalExecutor),
    (results, faults): (&Results, &FaultSummary),
) -> Result<(), Failure> {
    let [record] = &results.matches[..] else {
        let count = results.summary.matches;
        let message = format!("--explain is about one match, and this contest has {count}");
        return Err(Failure::usage(message).hint("name one robot and one maze"));
    };
    let again = play_again(plan, players, executor, record).map_err(Failure::internal)?;
    let Some(again) = again else {
        return Ok(());
    };
    let (maze, recording) = (&again.maze, &again.detailed.recording);
    let (_, trace) =
        trace(&maze.maze, &plan.rules.game, &recording.transcript).map_err(Failure::internal)?;
    let text = explain(&Explained {
        robot: plan.entrants[again.player.entrants[0]].name.as_guest(),
        maze_name: maze.name.as_guest(),
        maze: &maze.maze,
        rules: &plan.rules.game,
        record: &again.detailed.record,
        trace: &trace,
        journal: &recording.journal,
        step_fuel: &recording.step_fuel,
    });
    output::print(&format!("\n{text}"))?;
    for backtrace in backtrace::all(plan, players, specs, executor, faults) {
        output::print(&format!("\n{backtrace}\n"))?;
    }
    Ok(())
}
