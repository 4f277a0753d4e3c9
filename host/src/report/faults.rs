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

#[cfg(test)]
mod tests {
    use wasmouse_core::record::Transcript;

    use super::super::sample::results;
    use super::*;
    use crate::contest::{ContestMatch, Sink as _};

    #[test]
    fn a_kind_of_fault_has_one_line() {
        let results = results();
        let mut summary = FaultSummary::default();
        for record in results.matches.iter().cycle().take(8) {
            let (record, transcript) = (record.clone(), Transcript::default());
            let played = ContestMatch {
                player: 1,
                record,
                transcript,
            };
            summary.played(&played).expect("it only counts");
        }
        let text = faults(
            &summary,
            &results.names(),
            |player| if player == 1 { 8 } else { 0 },
        );
        let (begin, end) = (
            "fault: `<b>\\u{1b}[31m",
            "`: panic in 2 of 8 matches, first in `test_maze_01`, seed 18446744073709551615: \
             panicked: <b>\\u{1b}[31m",
        );
        assert!(text.starts_with(begin) && text.contains(end), "{text}");
        assert!(
            text.ends_with(" in step 5 (exploration run, at (0, 3))\n"),
            "{text}"
        );
        assert_eq!(text.lines().count(), 1, "{text}");
    }
}
