//! [`ReplayFileError`]: what is wrong with a replay.

use crate::Digest;
use crate::record::{ReplayError, TranscriptError};

/// Why something is not a replay.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReplayFileError {
    /// It is something else.
    #[error("the format is not `wasmouse-replay`")]
    Format,
    /// A newer version of wasmouse has written it.
    #[error("replays of version {0} are not supported, only version 1 is")]
    Version(u32),
    /// A name is too long: that of the robot or the maze.
    #[error("the name of the {0} has more than 200 characters")]
    LongName(&'static str),
    /// The columns of the maze are not as many as they are long.
    #[error("column {column} of the maze has {cells} cells, and there are {columns} columns")]
    Column {
        /// Counted from 0.
        column: usize,
        /// Cells in the column.
        cells: usize,
        /// Columns in the maze.
        columns: usize,
    },
    /// A character of a column is no hexadecimal digit.
    #[error("cell ({column}, {row}) of the maze is no hexadecimal digit")]
    Cell {
        /// Counted from 0.
        column: usize,
        /// Counted from 0, from the bottom.
        row: usize,
    },
    /// The cells are not those of a maze.
    #[error(
        "the cells are not those of a maze: two of them disagree about the wall between them, the \
         perimeter has a gap, or the start or the goal is not inside"
    )]
    Maze,
    /// The text of the transcript is not Base64.
    #[error("character {0} of the transcript is not Base64")]
    Base64(usize),
    /// The bytes are no transcript.
    #[error(transparent)]
    Transcript(#[from] TranscriptError),
    /// A part is not the one that the record is about.
    #[error("the digest of the {what} is {found}, and not {expected} as in the record")]
    Digest {
        /// The part.
        what: &'static str,
        /// Its digest.
        found: Digest,
        /// The digest in the record.
        expected: Digest,
    },
    /// The transcript does not belong to a match in that maze with those rules.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// The record contradicts the transcript.
    #[error("the record and the transcript disagree about the {0}")]
    Record(&'static str),
    /// The content was changed after the digest was computed.
    #[error(
        "the digest of the replay is {found}, and not {expected} as it says: a name, the fuel or \
         the journal was changed"
    )]
    Changed {
        /// The digest of the content.
        found: Digest,
        /// The digest in the file.
        expected: Digest,
    },
}
