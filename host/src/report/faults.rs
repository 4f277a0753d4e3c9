//! [`faults`]: the faults of a contest as text, one line for each robot and kind.

use std::fmt::Write as _;

use super::escape;
use crate::contest::{FaultSummary, Names};

/// One line for each robot and kind of fault: how many of the robot's matches ended so, and the
/// first of them. Empty when there is no fault.
///
/// `matches` gives how many matches a player has played, by the index of the player.
pub fn faults(summary: &FaultSummary, names: &Names<'_>, matches: impl Fn(usize) -> u64) -> String {
    let mut text = String::new();
    for group in summary.groups() {
        let Some(fault) = group.first.verdict.fault() else {
            continue;
        };
        let key = &group.first.key;
        let (robot, maze) = (names.robot(key), names.maze_name(key));
        writeln!(
            text,
            "fault: `{}`: {} in {} of {} matches, first in `{}`, seed {}: {}",
            escape::for_terminal(robot),
            fault.kind.name(),
            group.count,
            matches(group.player),
            escape::for_terminal(maze),
            key.seed,
            escape::for_terminal(&fault.to_string()),
        )
        .expect("writing to a string cannot fail");
    }
    text
}
