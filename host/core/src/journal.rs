//! [`Journal`]: what a robot tells the people who watch it.
//!
//! Entries and their text live in two growing buffers that are reused from
//! match to match. The text is untrusted: whoever shows it escapes it.

use serde::{Deserialize, Serialize};
use std::ops::Range;

use crate::maze::{Cell, Heading};

/// How much a log line matters, as in the WIT.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Level {
    /// For the author of the robot.
    Debug,
    /// For anyone who watches.
    Info,
    /// Something unexpected that the robot can live with.
    Warning,
    /// Something that should not have happened.
    Error,
}

/// A colour for a cell, as in the WIT.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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

/// What a robot believes about a wall, as in the WIT.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Belief {
    /// Not known.
    Unknown,
    /// Nothing stands there.
    Open,
    /// A wall stands there.
    Closed,
}

/// One entry, with its text borrowed from the journal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Note<'a> {
    /// A line of text.
    Log {
        /// How much it matters.
        level: Level,
        /// The text, unescaped.
        text: &'a str,
    },
    /// A painted cell.
    Paint {
        /// Which cell.
        cell: Cell,
        /// Its colour from now on.
        color: Color,
    },
    /// A short text in a cell.
    Label {
        /// Which cell.
        cell: Cell,
        /// The text, unescaped; empty removes the label.
        text: &'a str,
    },
    /// A belief about a wall.
    Wall {
        /// One of the wall's two cells.
        cell: Cell,
        /// The side of that cell.
        side: Heading,
        /// What the robot believes.
        belief: Belief,
    },
}

/// An entry and the step in which it was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry<'a> {
    /// 0 during `start`, then the number of the step, counted from 1.
    pub step: u32,
    /// What was said.
    pub note: Note<'a>,
}

/// How much a robot wrote to its journal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JournalCounts {
    /// Entries that were kept.
    pub entries: u64,
    /// Entries that the limit kept out.
    pub dropped: u64,
}

/// All entries of a match, in order, up to a limit.
#[derive(Clone, Debug, Default)]
pub struct Journal {
    entries: Vec<Stored>,
    text: String,
    bytes_max: u64,
    bytes: u64,
    dropped: u64,
}

#[derive(Clone, Debug)]
struct Stored {
    step: u32,
    note: StoredNote,
}

#[derive(Clone, Debug)]
enum StoredNote {
    Log(Level, Range<usize>),
    Paint(Cell, Color),
    Label(Cell, Range<usize>),
    Wall(Cell, Heading, Belief),
}

/// What an entry without text counts, in bytes.
pub const ENTRY_BYTES: u64 = 16;

impl Journal {
    /// Forgets all entries, keeps the memory, and sets the limit in bytes: 16
    /// for each entry plus the length of its text.
    pub fn clear(&mut self, bytes_max: u64) {
        self.entries.clear();
        self.text.clear();
        self.bytes_max = bytes_max;
        self.bytes = 0;
        self.dropped = 0;
    }

    /// The entries, in order.
    pub fn entries(&self) -> impl Iterator<Item = Entry<'_>> {
        self.entries.iter().map(|stored| Entry {
            step: stored.step,
            note: match &stored.note {
                StoredNote::Log(level, range) => Note::Log {
                    level: *level,
                    text: &self.text[range.clone()],
                },
                StoredNote::Paint(cell, color) => Note::Paint {
                    cell: *cell,
                    color: *color,
                },
                StoredNote::Label(cell, range) => Note::Label {
                    cell: *cell,
                    text: &self.text[range.clone()],
                },
                StoredNote::Wall(cell, side, belief) => Note::Wall {
                    cell: *cell,
                    side: *side,
                    belief: *belief,
                },
            },
        })
    }

    /// How many entries there are.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether the robot said nothing.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Entries that the limit kept out.
    pub const fn dropped(&self) -> u64 {
        self.dropped
    }

    /// How many entries there are, and how many the limit kept out.
    pub fn counts(&self) -> JournalCounts {
        JournalCounts {
            entries: u64::try_from(self.len()).unwrap_or(u64::MAX),
            dropped: self.dropped,
        }
    }

    /// Adds an entry, or counts it as dropped.
    pub fn push(&mut self, step: u32, note: Note<'_>) {
        let text = match note {
            Note::Log { text, .. } | Note::Label { text, .. } => text,
            Note::Paint { .. } | Note::Wall { .. } => "",
        };
        let length = u64::try_from(text.len()).unwrap_or(u64::MAX);
        let bytes = self
            .bytes
            .saturating_add(ENTRY_BYTES)
            .saturating_add(length);
        if bytes > self.bytes_max {
            self.dropped += 1;
            return;
        }
        self.bytes = bytes;
        let start = self.text.len();
        self.text.push_str(text);
        let range = start..self.text.len();
        let note = match note {
            Note::Log { level, .. } => StoredNote::Log(level, range),
            Note::Paint { cell, color } => StoredNote::Paint(cell, color),
            Note::Label { cell, .. } => StoredNote::Label(cell, range),
            Note::Wall { cell, side, belief } => StoredNote::Wall(cell, side, belief),
        };
        self.entries.push(Stored { step, note });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_entries_up_to_the_limit() {
        let mut journal = Journal::default();
        journal.clear(40);
        let log = |text| Note::Log {
            level: Level::Info,
            text,
        };
        journal.push(1, log("four"));
        journal.push(2, log("this line is too long for what is left"));
        journal.push(3, log("now"));
        let texts: Vec<_> = journal.entries().collect();
        assert_eq!(texts.len(), 2);
        assert_eq!(
            texts[0],
            Entry {
                step: 1,
                note: log("four")
            }
        );
        assert_eq!(
            texts[1],
            Entry {
                step: 3,
                note: log("now")
            }
        );
        assert_eq!(journal.dropped(), 1);
    }
}
