//! [`Complaint`]: what a robot wrote about its own failure.
//!
//! Interpreters and runtimes report an uncaught exception or a panic on standard error, which
//! arrives as lines of level error in the journal. The fault itself is then no more than
//! `unreachable`. Records do not have these lines: they are derived from the journal of the match
//! when it is played again. All of it is the robot's text.

use std::collections::BTreeMap;

use wasmouse_core::game::{Fault, FaultKind};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::{Journal, Level, Note};
use wasmouse_core::{GuestText, guest_text};

/// Lines that are kept, the last ones: they name the error.
const LINES_MAX: usize = 20;

/// Characters of a line that are kept.
const LINE_CHARS_MAX: usize = 200;

/// The lines of level error that a robot wrote in the call in which it failed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Complaint {
    /// The lines, in order. At most 20 of at most 200 characters and an ellipsis.
    pub lines: Vec<GuestText>,
    /// How many lines before them are left out.
    pub left_out: usize,
}

impl Complaint {
    /// What the robot wrote in the call that ended in the fault; empty when it wrote nothing.
    pub fn of(journal: &Journal, fault: &Fault) -> Self {
        let mut lines: Vec<GuestText> = Vec::new();
        for entry in journal.entries().filter(|it| it.step == fault.step) {
            if let Note::Log {
                level: Level::Error,
                text,
            } = entry.note
            {
                // A whole traceback may be one entry.
                let text = text.lines().map(GuestStr::trim_end);
                lines.extend(text.filter(|it| !it.is_empty()).map(cut));
            }
        }
        let left_out = lines.len().saturating_sub(LINES_MAX);
        lines.drain(..left_out);
        Self { lines, left_out }
    }

    /// Whether the robot wrote nothing.
    pub const fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// The line that says what went wrong, for a fault that does not say it itself, such as
    /// `unreachable`: in a Go panic the line that begins so, otherwise the last one, which is
    /// `ValueError: boom` in Python. Lines of a JavaScript stack trace are passed over.
    pub fn headline(&self, kind: FaultKind) -> Option<GuestStr<'_>> {
        if !says_nothing(kind) {
            return None;
        }
        let lines = || self.lines.iter().map(|it| it.as_guest().trim());
        let of_go = lines().find(|it| it.starts_with("panic: ") || it.starts_with("fatal error: "));
        of_go.or_else(|| lines().rfind(|it| !it.starts_with("at ")))
    }
}

/// Whether a fault of this kind may be how a runtime ends after it has reported an error.
const fn says_nothing(kind: FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::Unreachable
            | FaultKind::OutOfBounds
            | FaultKind::BadIndirectCall
            | FaultKind::DivisionByZero
            | FaultKind::IntegerOverflow
    )
}

fn cut(line: GuestStr<'_>) -> GuestText {
    match line.cut(LINE_CHARS_MAX) {
        (start, true) => guest_text!("{}…", start),
        (whole, false) => whole.into(),
    }
}

/// Complaints by player and name of the kind of fault, as in a
/// [`FaultSummary`](super::FaultSummary).
#[derive(Clone, Debug, Default)]
pub struct Complaints(BTreeMap<(usize, &'static str), Complaint>);

impl Complaints {
    /// Adds what a player wrote when it first failed so; nothing is not added.
    pub fn add(&mut self, player: usize, kind: FaultKind, complaint: Complaint) {
        if !complaint.is_empty() {
            self.0.insert((player, kind.name()), complaint);
        }
    }

    /// What the player wrote when it first failed so.
    pub fn get(&self, player: usize, kind: &str) -> Option<&Complaint> {
        let mut all = self.0.iter();
        let found = all.find(|((its, name), _)| *its == player && *name == kind);
        found.map(|(_, complaint)| complaint)
    }

    /// All of them, with player and name of the kind.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &'static str, &Complaint)> {
        self.0
            .iter()
            .map(|(&(player, kind), it)| (player, kind, it))
    }
}

#[cfg(test)]
mod tests {
    use wasmouse_core::game::{Phase, Run};
    use wasmouse_core::maze::Cell;

    use super::*;

    fn complaint(entries: &[(u32, Level, &str)]) -> Complaint {
        let mut journal = Journal::default();
        journal.clear(1 << 20);
        for &(step, level, text) in entries {
            let text = text.into();
            journal.push(step, Note::Log { level, text });
        }
        let fault = Fault {
            kind: FaultKind::Unreachable,
            phase: Phase::NextMove,
            run: Run::Exploration,
            step: 4,
            cell: Cell::new(0, 3),
            detail: "executed `unreachable`".into(),
        };
        Complaint::of(&journal, &fault)
    }

    #[test]
    fn only_errors_of_the_failing_call_count() {
        let found = complaint(&[
            (3, Level::Error, "handled"),
            (4, Level::Info, "at the wall"),
            (
                4,
                Level::Error,
                "Traceback (most recent call last):\n  File \"app.py\"\n",
            ),
            (4, Level::Error, "ValueError: boom"),
        ]);
        let lines = [
            "Traceback (most recent call last):",
            "  File \"app.py\"",
            "ValueError: boom",
        ];
        assert_eq!(found.lines, lines);
        assert_eq!(
            found.headline(FaultKind::Unreachable),
            Some(lines[2].into())
        );
        assert_eq!(found.headline(FaultKind::Panic), None, "it has a message");
        assert!(complaint(&[(4, Level::Warning, "hm")]).is_empty());
    }

    #[test]
    fn the_headline_is_the_message_in_every_language() {
        for (text, headline) in [
            (
                "TypeError: x is undefined\n    at plan (robot.js:3)",
                "TypeError: x is undefined",
            ),
            (
                "panic: boom\n\ngoroutine 1 [running]:\nmain.plan(...)\n\t/robot.go:9",
                "panic: boom",
            ),
            (
                "Assertion failed: n > 0 (robot.c: plan: 7)",
                "Assertion failed: n > 0 (robot.c: plan: 7)",
            ),
        ] {
            let found = complaint(&[(4, Level::Error, text)]);
            assert_eq!(
                found.headline(FaultKind::Unreachable),
                Some(headline.into())
            );
        }
        let found = complaint(&[(4, Level::Error, "at a wall")]);
        assert_eq!(found.headline(FaultKind::Unreachable), None);
    }

    #[test]
    fn the_last_lines_are_kept_and_long_ones_are_cut() {
        let text: Vec<String> = (0..50)
            .map(|it| format!("{it} {}", "é".repeat(500)))
            .collect();
        let found = complaint(&[(4, Level::Error, &text.join("\n"))]);
        assert_eq!((found.lines.len(), found.left_out), (20, 30));
        assert!(found.lines[0].as_guest().starts_with("30 "));
        assert_eq!(found.lines[0].raw().chars().count(), LINE_CHARS_MAX + 1);
    }
}
