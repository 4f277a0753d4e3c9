//! Where in its code a robot failed, for the person who wrote it.
//!
//! Matches do not record backtraces, because that costs time; the first failing match of a
//! robot is played again for it, away from the contest.

use std::collections::BTreeSet;

use wasmouse_core::Digest;
use wasmouse_core::game::FaultKind;
use wasmouse_engine::{Executor, LocalExecutor};

use super::again::maze_of;
use super::output::message;
use super::robots::RobotSpec;
use crate::contest::{FaultSummary, Plan, Player};
use crate::report::backtrace::backtrace;
use crate::report::text::Text;

/// Robots that get a backtrace: each is compiled once more.
const ROBOTS_MAX: usize = 5;

/// Prints to stderr where robots were in their code when they first failed.
pub fn print(
    plan: &Plan,
    players: &[Player],
    specs: &[RobotSpec],
    executor: &LocalExecutor,
    faults: &FaultSummary,
) {
    for backtrace in all(plan, players, specs, executor, faults) {
        message!("{}", Text::of_lines(&backtrace));
    }
}

/// Where robots were in their code when they first failed, as text. `specs` are those of the
/// plan's entrants, in order. Backtraces are optional: one that cannot be made is reported.
pub fn all(
    plan: &Plan,
    players: &[Player],
    specs: &[RobotSpec],
    executor: &LocalExecutor,
    faults: &FaultSummary,
) -> Vec<String> {
    let mut backtraces = Vec::new();
    let mut seen = BTreeSet::new();
    let groups = faults.groups().filter(|group| {
        let fault = group.first.verdict.fault();
        fault.is_some_and(|it| it.kind != FaultKind::Crash) && seen.insert(group.player)
    });
    for group in groups.take(ROBOTS_MAX) {
        let player = &players[group.player];
        if player.robot.account().withdrawal().is_some() {
            continue;
        }
        let entrant = player.entrants[0];
        let bytes_max = executor.limits().admission.component_bytes_max;
        let (Ok(file), Some(maze)) = (specs[entrant].read(bytes_max), maze_of(plan, &group.first))
        else {
            continue;
        };
        let Some(fault) = group.first.verdict.fault() else {
            continue;
        };
        if Digest::of(&file) != *player.robot.digest() {
            continue;
        }
        let spec = plan.spec(plan.key_parts(), player, &maze, group.first.key.seed);
        let found = executor.backtrace(&player.robot, &file, &spec, fault);
        let name = &plan.entrants[entrant].name;
        match found {
            Ok(Some(frames)) if !frames.is_empty() => backtraces.push(backtrace(name, &frames)),
            Ok(_) => {}
            Err(error) => message!("warning: no backtrace of `{}`: {}", name.escaped(), error),
        }
    }
    backtraces
}
