//! The last lines that a robot has logged.

use std::collections::VecDeque;

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::{Journal, Level, Note};

/// A line of a robot's log.
pub struct Logged<'a> {
    /// 0 in `start`, then the number of the step.
    pub step: u32,
    /// The importance.
    pub level: Level,
    /// The text.
    pub text: GuestStr<'a>,
}

/// The last lines that were logged until a position, at most so many, in their order.
pub fn last(journal: &Journal, position: usize, lines_max: usize) -> Vec<Logged<'_>> {
    let mut lines = VecDeque::with_capacity(lines_max);
    let until = journal
        .entries()
        .filter(|entry| entry.step as usize <= position);
    for entry in until {
        if let Note::Log { level, text } = entry.note {
            if lines.len() == lines_max {
                lines.pop_front();
            }
            let step = entry.step;
            if lines_max > 0 {
                lines.push_back(Logged { step, level, text });
            }
        }
    }
    lines.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_lines_are_kept() {
        let mut journal = Journal::default();
        journal.clear(10_000);
        for step in 0..9 {
            let text = format!("line {step}");
            let text = GuestStr::from(&text);
            journal.push(
                step,
                Note::Log {
                    level: Level::Info,
                    text,
                },
            );
        }
        let texts = |position, lines| -> Vec<String> {
            let lines = last(&journal, position, lines);
            lines.iter().map(|it| it.text.raw().to_owned()).collect()
        };
        assert_eq!(texts(5, 2), ["line 4", "line 5"]);
        assert_eq!(texts(0, 2), ["line 0"]);
        assert!(texts(5, 0).is_empty());
    }
}
