//! [`Journal`]: the log lines, colours, labels and wall beliefs of a robot.
//!
//! The text is the robot's, so it is a [`GuestStr`].

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::guest_text::GuestStr;
use crate::maze::{Cell, Heading};

/// The importance of a log line, as in the WIT.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// For the author of the robot.
    Debug,
    /// For everyone who watches the robot.
    Info,
    /// Something unexpected that the robot can handle.
    Warning,
    /// Something that should not have happened.
    Error,
}

/// A colour for a cell, as in the WIT.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the colours name themselves")]
pub enum Color {
    None,
    Red,
    Orange,
    Yellow,
    Green,
    Cyan,
    Blue,
    Violet,
    Gray,
}

/// A robot's belief about a wall, as in the WIT.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Belief {
    /// The robot does not know.
    Unknown,
    /// There is no wall.
    Open,
    /// There is a wall.
    Closed,
}

/// The content of an entry. `Text` is [`GuestStr`], except inside a journal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoteOf<Text> {
    /// A line of text.
    Log {
        /// The importance of the line.
        level: Level,
        /// The text.
        text: Text,
    },
    /// A painted cell.
    Paint {
        /// The cell.
        cell: Cell,
        /// Its colour from now on.
        color: Color,
    },
    /// A short text in a cell.
    Label {
        /// The cell.
        cell: Cell,
        /// The text; empty removes the label.
        text: Text,
    },
    /// A belief about a wall.
    Wall {
        /// One of the wall's two cells.
        cell: Cell,
        /// The side of that cell.
        side: Heading,
        /// The belief.
        belief: Belief,
    },
}

/// The content of an entry, with its text borrowed from the journal or the robot.
pub type Note<'a> = NoteOf<GuestStr<'a>>;

impl<Text> NoteOf<Text> {
    fn map_text<To>(self, map: impl FnOnce(Text) -> To) -> NoteOf<To> {
        match self {
            Self::Log { level, text } => NoteOf::Log {
                level,
                text: map(text),
            },
            Self::Paint { cell, color } => NoteOf::Paint { cell, color },
            Self::Label { cell, text } => NoteOf::Label {
                cell,
                text: map(text),
            },
            Self::Wall { cell, side, belief } => NoteOf::Wall { cell, side, belief },
        }
    }
}

/// A note and the step in which the robot wrote it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry<'a> {
    /// 0 during `start`, then the number of the step, counted from 1.
    pub step: u32,
    /// The note.
    pub note: Note<'a>,
}

/// The size of a journal. Serialises as `{"entries": 12, "dropped": 0}`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JournalCounts {
    /// Entries in the journal.
    pub entries: u64,
    /// Entries dropped because of the limit.
    pub dropped: u64,
}

/// The entries of a match, in order, up to a limit on their size.
///
/// Entries and text are in two buffers that are reused for the next match.
///
/// ```
/// use wasmouse_core::journal::{Journal, JournalCounts, Level, Note};
/// let mut journal = Journal::default();
/// journal.clear(40);
/// journal.push(1, Note::Log { level: Level::Info, text: "dead end".into() });
/// journal.push(2, Note::Log { level: Level::Info, text: "too long for the rest".into() });
/// assert_eq!(journal.counts(), JournalCounts { entries: 1, dropped: 1 });
/// assert_eq!(journal.entries().next().map(|entry| entry.step), Some(1));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Journal {
    /// By step; the text of a note is a range of `text`.
    entries: Vec<(u32, NoteOf<Range<usize>>)>,
    text: String,
    bytes_max: u64,
    bytes: u64,
    dropped: u64,
}

/// The size of an entry without text towards the limit, in bytes.
pub const ENTRY_BYTES: u64 = 16;

impl Journal {
    /// Removes all entries and sets the limit in bytes: [`ENTRY_BYTES`] for each entry plus
    /// the length of its text.
    pub fn clear(&mut self, bytes_max: u64) {
        self.entries.clear();
        self.text.clear();
        self.bytes_max = bytes_max;
        self.bytes = 0;
        self.dropped = 0;
    }

    /// The entries, in order.
    pub fn entries(&self) -> impl Iterator<Item = Entry<'_>> {
        self.entries.iter().map(|(step, note)| Entry {
            step: *step,
            note: note.clone().map_text(|range| self.text[range].into()),
        })
    }

    /// The number of entries.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there are no entries.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The number of entries dropped because of the limit.
    pub const fn dropped(&self) -> u64 {
        self.dropped
    }

    /// The number of entries, and of those dropped because of the limit.
    pub fn counts(&self) -> JournalCounts {
        JournalCounts {
            entries: self.len() as u64,
            dropped: self.dropped,
        }
    }

    /// Adds an entry, or counts it as dropped if it exceeds the limit.
    pub fn push(&mut self, step: u32, note: Note<'_>) {
        let length = match note {
            Note::Log { text, .. } | Note::Label { text, .. } => text.len() as u64,
            Note::Paint { .. } | Note::Wall { .. } => 0,
        };
        let bytes = self.bytes.saturating_add(ENTRY_BYTES + length);
        if bytes > self.bytes_max {
            self.dropped += 1;
            return;
        }
        self.bytes = bytes;
        let note = note.map_text(|text| {
            let start = self.text.len();
            self.text.push_str(text.raw());
            start..self.text.len()
        });
        self.entries.push((step, note));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_beyond_the_limit_are_dropped() {
        let mut journal = Journal::default();
        journal.clear(40);
        let log = |text: &'static str| Note::Log {
            level: Level::Info,
            text: text.into(),
        };
        journal.push(1, log("four"));
        journal.push(2, log("this line is too long for the rest"));
        journal.push(3, log("now"));
        let entry = |step, text| Entry {
            step,
            note: log(text),
        };
        assert!(journal.entries().eq([entry(1, "four"), entry(3, "now")]));
        assert_eq!(journal.dropped(), 1);
    }
}
