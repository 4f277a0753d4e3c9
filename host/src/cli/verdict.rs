//! What a contest came to, for the user: the exit code, and messages on stderr.

use super::exit::Exit;
use super::output::message;
use crate::contest::{Complaints, FaultSummary, NotAdmitted, Plan, Player, Results, RobotEntry};
use crate::report::escape::for_terminal;
use crate::report::faults::faults;
use crate::report::number::{counted, counted_were};

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
    for entry in &summary.withdrawn {
        let mut robots = results.contest.robots.iter();
        let is_meant = |it: &&RobotEntry| it.digest == entry.robot && it.variant == entry.variant;
        let robot = robots
            .find(is_meant)
            .map_or("?".into(), |it| it.name.as_guest());
        message!(
            "withdrawn `{}`: {}; {} not played\n  \
             hint: --match-time and --robot-time allow more",
            for_terminal(robot),
            for_terminal(&entry.reason),
            counted_were(entry.matches, "match")
        );
    }
    let planned = results.contest.matches_planned;
    let withdrawn: u64 = summary.withdrawn.iter().map(|it| it.matches).sum();
    let ended = summary.matches + summary.failures.len() as u64 + withdrawn;
    if ended < planned {
        let standings = &summary.standings;
        message!(
            "interrupted after {} of {}; standings cover the {} of {} \
             that every robot has played",
            ended,
            counted(planned, "match"),
            standings.mazes,
            counted(plan.mazes.len(), "maze")
        );
        return Exit::Interrupted;
    }
    let lines = || summary.standings.lines.iter();
    let robots = &results.contest.robots;
    if !summary.failures.is_empty()
        || !summary.withdrawn.is_empty()
        || robots.iter().any(|it| it.failure.is_some())
    {
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

/// Reports on stderr why robots were rejected or faulted, with what they wrote about it.
pub fn print_faults(
    plan: &Plan,
    players: &[Player],
    results: &Results,
    (summary, complaints): (&FaultSummary, &Complaints),
) {
    for entrant in &plan.entrants {
        if let Err(NotAdmitted::Rejected(rejection)) = &entrant.admission {
            message!(
                "rejected `{}`: {}\n  hint: {}",
                for_terminal(&entrant.name),
                for_terminal(&rejection.reason()),
                rejection.hint().escaped()
            );
        }
    }
    print_failed_admissions(plan);
    let lines = &results.summary.standings.lines;
    let played = |player: usize| {
        let name = &plan.entrants[players[player].entrants[0]].name;
        let line = lines.iter().find(|line| line.robot == *name);
        line.map_or(0, |line| line.matches)
    };
    let text = faults(summary, complaints, &results.names(), played);
    for line in text.lines() {
        message!("{}", line);
    }
}

/// Reports on stderr which robots the host could not admit.
pub fn print_failed_admissions(plan: &Plan) {
    for entrant in &plan.entrants {
        if let Err(NotAdmitted::Failed(reason)) = &entrant.admission {
            message!(
                "error: `{}` could not be admitted: {}",
                for_terminal(&entrant.name),
                for_terminal(reason)
            );
        }
    }
}
