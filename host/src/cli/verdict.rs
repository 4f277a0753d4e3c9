//! What a contest came to, for the user: the exit code, and messages on stderr.

use super::exit::Exit;
use super::output::message;
use crate::contest::{FaultSummary, Plan, Player, Results};
use crate::report::escape::for_terminal;
use crate::report::faults::faults;

/// The exit code that goes with results; says on stderr what was not played.
pub fn exit(plan: &Plan, results: &Results) -> Exit {
    let summary = &results.summary;
    let names = results.names();
    for failure in &summary.failures {
        let (robot, maze) = (names.robot(&failure.key), names.maze_name(&failure.key));
        message!(
            "error: `{}` in `{}`, seed {}, was not played: {}",
            for_terminal(robot),
            for_terminal(maze),
            failure.key.seed,
            for_terminal(&failure.reason)
        );
    }
    let planned = results.contest.matches_planned;
    let ended = summary.matches + summary.failures.len() as u64;
    if ended < planned {
        let standings = &summary.standings;
        message!(
            "interrupted after {ended} of {planned} matches; standings cover the {} of {} mazes \
             that every robot has played",
            standings.mazes,
            plan.mazes.len()
        );
        return Exit::Interrupted;
    }
    let lines = || summary.standings.lines.iter();
    if !summary.failures.is_empty() {
        Exit::Internal
    } else if plan.entrants.iter().any(|it| it.admission.is_err())
        || lines().any(|line| line.faults > 0)
    {
        Exit::Robot
    } else if planned > 0 && lines().all(|line| line.finished == 0) {
        Exit::NoneFinished
    } else {
        Exit::Success
    }
}

/// Reports on stderr why robots were rejected or faulted.
pub fn print_faults(plan: &Plan, players: &[Player], results: &Results, summary: &FaultSummary) {
    for entrant in &plan.entrants {
        if let Err(rejection) = &entrant.admission {
            message!(
                "rejected `{}`: {}\n  hint: {}",
                for_terminal(&entrant.name),
                for_terminal(&rejection.to_string()),
                rejection.hint()
            );
        }
    }
    let lines = &results.summary.standings.lines;
    let played = |player: usize| {
        let name = &plan.entrants[players[player].entrants[0]].name;
        let line = lines.iter().find(|line| line.robot == *name);
        line.map_or(0, |line| line.matches)
    };
    let text = faults(summary, &results.names(), played);
    for line in text.lines() {
        message!("{line}");
    }
}
