//! [`faults`]: the faults of a contest as text, one line for each robot and kind.

use std::fmt::Write as _;

use wasmouse_core::game::Fault;
use wasmouse_core::{GuestText, guest_text};

use super::escape;
use crate::contest::{Complaint, Complaints, FaultSummary, Names};
use crate::report::number::counted;

/// One line for each robot and kind of fault: how many of the robot's matches ended so, and the
/// first of them, followed by what the robot wrote then. Empty when there is no fault.
///
/// `matches` gives how many matches a player has played, by the index of the player.
pub fn faults(
    summary: &FaultSummary,
    complaints: &Complaints,
    names: &Names<'_>,
    matches: impl Fn(usize) -> u64,
) -> String {
    let mut text = String::new();
    for group in summary.groups() {
        let Some(fault) = group.first.verdict.fault() else {
            continue;
        };
        let key = &group.first.key;
        let (robot, maze) = (names.robot(key), names.maze_name(key));
        let complaint = complaints.get(group.player, fault.kind.name());
        writeln!(
            text,
            "fault: `{}`: {} in {} of {}, first in `{}`, seed {}: {}",
            escape::for_terminal(robot),
            fault.kind.name(),
            group.count,
            counted(matches(group.player), "match"),
            escape::for_terminal(maze),
            key.seed,
            escape::for_terminal(&explained(fault, complaint)),
        )
        .expect("writing to a string cannot fail");
        text.push_str(&complaint.map(quoted).unwrap_or_default());
    }
    text
}

/// The fault with its place, after what the robot says about it if the fault says nothing itself:
/// `ValueError: boom; executed `unreachable` (panicked or aborted) in step 4 (...)`.
pub(crate) fn explained(fault: &Fault, complaint: Option<&Complaint>) -> GuestText {
    match complaint.and_then(|it| it.headline(fault.kind)) {
        Some(headline) => guest_text!("{}; {}", headline, fault.describe()),
        None => fault.describe(),
    }
}

/// The lines of a complaint for a terminal, indented and marked, so that none can be taken for a
/// message of wasmouse. Ends with a newline.
pub(crate) fn quoted(complaint: &Complaint) -> String {
    let mut text = String::new();
    if complaint.left_out > 0 {
        let lines = counted(complaint.left_out, "earlier line");
        text.push_str(&format!("  | ({lines})\n"));
    }
    for line in &complaint.lines {
        text.push_str(&format!("  | {}\n", escape::for_terminal(line)));
    }
    text
}

#[cfg(test)]
mod tests {
    use wasmouse_core::game::FaultKind;
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
        let matches = |player| if player == 1 { 8 } else { 0 };
        let names = results.names();
        let text = faults(&summary, &Complaints::default(), &names, matches);
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

        let complaint = Complaint {
            lines: vec!["Traceback\u{1b}[31m".into(), "fault: `me`".into()],
            left_out: 3,
        };
        let mut complaints = Complaints::default();
        complaints.add(1, FaultKind::Panic, complaint);
        let text = faults(&summary, &complaints, &names, matches);
        let lines: Vec<&str> = text.lines().skip(1).collect();
        let expected = [
            "  | (3 earlier lines)",
            "  | Traceback\\u{1b}[31m",
            "  | fault: `me`",
        ];
        assert_eq!(lines, expected);
    }

    #[test]
    fn a_bare_trap_is_explained_by_the_robot() {
        let results = results();
        let mut records = results.matches.iter();
        let mut fault = records
            .find_map(|it| it.verdict.fault().cloned())
            .expect("a fault");
        let complaint = Complaint {
            lines: vec!["ValueError: boom".into()],
            left_out: 0,
        };
        assert_eq!(explained(&fault, Some(&complaint)), fault.describe());
        fault.kind = FaultKind::Unreachable;
        let expected = guest_text!("ValueError: boom; {}", fault.describe());
        assert_eq!(explained(&fault, Some(&complaint)), expected);
        assert_eq!(explained(&fault, None), fault.describe());
    }
}
