//! Where in its code a robot failed, for the person who wrote it.
//!
//! Matches do not record backtraces, because that costs time; the first failing match of a
//! robot is played again for it, away from the contest.

use std::collections::BTreeSet;

use wasmouse_core::Digest;
use wasmouse_core::game::FaultKind;
use wasmouse_engine::{Executor, Frame, LocalExecutor};

use super::again::maze_of;
use super::output::message;
use super::robots::RobotSpec;
use crate::contest::{FaultSummary, Plan, Player};
use crate::report::escape::for_terminal;
use crate::report::text::Text;

/// Robots that get a backtrace: each is compiled once more.
const ROBOTS_MAX: usize = 5;

/// Prints to stderr where robots were in their code when they first failed. `specs` are those of
/// the plan's entrants, in order. Backtraces are optional: one that cannot be made is reported.
pub fn print(
    plan: &Plan,
    players: &[Player],
    specs: &[RobotSpec],
    executor: &LocalExecutor,
    faults: &FaultSummary,
) {
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
        let backtrace = executor.backtrace(&player.robot, &file, &spec, fault);
        let name = &plan.entrants[entrant].name;
        match backtrace {
            Ok(Some(frames)) if !frames.is_empty() => print_frames(name, &frames),
            Ok(_) => {}
            Err(error) => message!("warning: no backtrace of `{}`: {}", name, error),
        }
    }
}

fn print_frames(robot: &str, frames: &[Frame]) {
    let robot = for_terminal(robot);
    let mut lines = format!("backtrace of `{robot}` (most recent call first):");
    let shown = Frame::of_robot(frames);
    for (depth, frame) in shown.iter().enumerate() {
        let function = for_terminal(&frame.function);
        lines.push_str(&format!("\n  {depth:>2}: {function}"));
        if let Some(source) = &frame.source {
            lines.push_str(&format!(" at {}", for_terminal(source)));
        } else if let Some(offset) = frame.offset {
            lines.push_str(&format!(" at offset {offset:#x}"));
        }
    }
    match frames.len() - shown.len() {
        0 => {}
        1 => lines.push_str("\n  (1 frame of the Rust runtime hidden)"),
        hidden => lines.push_str(&format!("\n  ({hidden} frames of the Rust runtime hidden)")),
    }
    message!("{}", Text::of_lines(&lines));
}
