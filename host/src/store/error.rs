//! [`StoreError`]: why a store cannot be used.

use std::io;
use std::path::{Path, PathBuf};

use rusqlite::ErrorCode;
use wasmouse_core::GuestText;
use wasmouse_core::record::MatchKey;

/// A store cannot be used, or something was refused. Displays as one line with the place; it may
/// quote untrusted text, so escape it before displaying it.
#[derive(Debug, thiserror::Error)]
#[error("store `{}`: {kind}", path.display())]
pub struct StoreError {
    /// The file of the store.
    pub path: PathBuf,
    /// What is wrong.
    pub kind: StoreErrorKind,
}

/// What is wrong with a store.
#[derive(Debug, thiserror::Error)]
pub enum StoreErrorKind {
    /// There is no file.
    #[error("no such file")]
    Absent,
    /// It is a folder, a pipe or a device.
    #[error("it is {0}, not a file")]
    NotAFile(&'static str),
    /// The file has no bytes.
    #[error("the file is empty")]
    Empty,
    /// The file is something else than a SQLite database.
    #[error("it is not a database")]
    NotADatabase,
    /// It is a database of another program.
    #[error("it is a database of another program (application id {0:#010x})")]
    OtherProgram(u32),
    /// The schema is newer than this program.
    #[error(
        "it was written by a newer version of wasmouse (schema {found}; this version knows up to {supported})"
    )]
    Newer {
        /// The version of its schema.
        found: u32,
        /// The latest supported version.
        supported: u32,
    },
    /// The schema is older than this program, and the store was opened for reading only.
    #[error("it has schema {found}, and schema {supported} is needed to read it")]
    Older {
        /// The version of its schema.
        found: u32,
        /// The needed version.
        supported: u32,
    },
    /// The file ends too early.
    #[error("the file is truncated: it has {found} bytes of {expected}")]
    Truncated {
        /// Bytes there are.
        found: u64,
        /// Bytes there should be.
        expected: u64,
    },
    /// The file, or its folder, may only be read.
    #[error("it is read-only")]
    ReadOnly,
    /// Another writer has the store open.
    #[error("another wasmouse is writing to it")]
    InUse,
    /// Another program holds a lock of SQLite for too long.
    #[error("it is locked by another program")]
    Locked,
    /// The content makes no sense.
    #[error("it is damaged: {0}")]
    Damaged(String),
    /// The disk is full.
    #[error("the disk is full")]
    Full,
    /// A file cannot be read or written.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// SQLite failed for another reason.
    #[error("SQLite failed: {0}")]
    Sqlite(rusqlite::Error),
    /// A record contradicts the one that the store has for the same address.
    #[error(
        "two different records for one match (robot `{}`, maze `{}`, seed {}, address {}): \
         this is a bug in wasmouse, or the store was changed",
        robot.escaped(), maze.escaped(), key.seed, key.digest()
    )]
    Conflict {
        /// The match.
        key: Box<MatchKey>,
        /// The name of its robot.
        robot: GuestText,
        /// The name of its maze.
        maze: GuestText,
    },
    /// A record contradicts itself, its rules or its transcript, so it is not stored.
    #[error("match {}: {problem}", key.digest())]
    Inconsistent {
        /// The match.
        key: Box<MatchKey>,
        /// What contradicts what.
        problem: String,
    },
    /// Something that was asked for is not in the store.
    #[error("it has no {0}")]
    Unknown(String),
    /// The reader of records failed.
    #[error("{0}")]
    Reader(io::Error),
    /// A store to merge is the one to merge into.
    #[error("it cannot be merged into itself")]
    Itself,
    /// A store to merge has no seal: the run that wrote it has not ended.
    #[error("the contest that wrote it has not ended: it has no seal")]
    Unsealed,
    /// A store to merge does not have the content that it had when its run ended.
    #[error("its content is not the one that was sealed, so it was changed")]
    SealBroken,
    /// A store to merge was played with another engine.
    #[error("its matches were played with engine `{found}`, those of `{}` with `{expected}`", into.display())]
    OtherEngine {
        /// Its engine.
        found: String,
        /// The store to merge into.
        into: PathBuf,
        /// The engines of the store to merge into.
        expected: String,
    },
    /// A store to merge contradicts the one to merge into, or itself.
    #[error("it has records that contradict those of `{}`: {count}, the first: {first}", into.display())]
    Conflicts {
        /// How many.
        count: u64,
        /// The first matches with their robots, mazes and seeds.
        first: String,
        /// The store to merge into.
        into: PathBuf,
    },
    /// A store to merge has conflicts of its own.
    #[error("it has {0} conflicts of its own")]
    HasConflicts(u64),
}

impl StoreErrorKind {
    /// With the place.
    pub(super) fn at(self, path: impl Into<PathBuf>) -> StoreError {
        StoreError {
            path: path.into(),
            kind: self,
        }
    }

    /// What to do about it, as a fragment; `None` where there is nothing general to say.
    pub const fn hint(&self) -> Option<&'static str> {
        Some(match self {
            Self::Absent => "`wasmouse contest run` creates a store",
            Self::NotAFile(_) | Self::NotADatabase | Self::OtherProgram(_) => {
                "choose another path for the store"
            }
            Self::Empty => "remove the empty file, and the store is created",
            Self::Newer { .. } => "use the version of wasmouse that wrote it, or a newer one",
            Self::Older { .. } => "any command that writes to the store brings it up to date",
            Self::Truncated { .. } | Self::Damaged(_) => {
                "restore it from a copy, or play the contest again into a new store"
            }
            Self::ReadOnly => "copy it to a place that can be written",
            Self::InUse | Self::Locked => "wait until the other program has ended",
            Self::Full => "make room, and run the contest again: it goes on where it ended",
            Self::Conflict { .. } | Self::Inconsistent { .. } => {
                "keep the store and report the bug; a new store plays everything again"
            }
            Self::Unsealed => "run that contest again, it goes on where it ended",
            Self::SealBroken | Self::Conflicts { .. } | Self::HasConflicts(_) => {
                "nothing of it was merged; play that part of the contest again"
            }
            Self::OtherEngine { .. } => "play all parts with the same version of wasmouse",
            Self::Io(_) | Self::Sqlite(_) | Self::Unknown(_) | Self::Reader(_) | Self::Itself => {
                return None;
            }
        })
    }
}

impl StoreError {
    /// What to do about it, as a fragment.
    pub const fn hint(&self) -> Option<&'static str> {
        self.kind.hint()
    }

    /// The file of the store.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The store error inside the error of a sink.
    pub fn of_sink(error: &io::Error) -> Option<&Self> {
        error.get_ref()?.downcast_ref()
    }
}

impl From<StoreError> for io::Error {
    fn from(error: StoreError) -> Self {
        Self::other(error)
    }
}

impl From<rusqlite::Error> for StoreErrorKind {
    fn from(error: rusqlite::Error) -> Self {
        if let rusqlite::Error::SqliteFailure(failure, _) = &error {
            match failure.code {
                ErrorCode::NotADatabase => return Self::NotADatabase,
                ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked => return Self::Locked,
                ErrorCode::ReadOnly => return Self::ReadOnly,
                ErrorCode::DiskFull => return Self::Full,
                ErrorCode::DatabaseCorrupt => return Self::Damaged(error.to_string()),
                _ => {}
            }
        }
        match error {
            // A value of another type than the schema says, or a table that is not there.
            rusqlite::Error::FromSqlConversionFailure(..)
            | rusqlite::Error::IntegralValueOutOfRange(..)
            | rusqlite::Error::InvalidColumnType(..)
            | rusqlite::Error::Utf8Error(..) => Self::Damaged(error.to_string()),
            error => Self::Sqlite(error),
        }
    }
}
