//! Results of contests in a SQLite database.
//!
//! A [`Store`] is one file that holds what came of matches, by the digests of their keys' parts:
//! engine, rules, robot, maze. [`StoreSink`] writes the matches of a contest into it while they
//! are played; [`Store::missing`] says which are left, so that a contest goes on where it ended;
//! [`Store::matrix`] and [`Store::records`] read them in the order of a plan; [`Store::merge`]
//! adds another store. What a store holds depends on neither the order of matches nor on
//! restarts, and [`Store::content_digest`] names it in one line.
//!
//! Records are never changed or deleted. No times are stored, and no text of a store is escaped:
//! it may come from anyone.
//!
//! Knows nothing about output formats and prints nothing.

mod columns;
mod content;
mod error;
mod file;
mod ids;
mod integrity;
mod kept;
mod keys;
mod matrix;
mod mazes;
mod merge;
mod missing;
mod open;
mod records;
#[cfg(test)]
mod sample;
mod scan;
mod schema;
mod seal;
mod sink;
mod submissions;
#[cfg(test)]
mod tests;
mod transcripts;
mod unplayed;
mod writer;

pub use error::{StoreError, StoreErrorKind};
pub use integrity::Integrity;
pub use kept::{KeptMatch, KeptName};
pub use keys::MatchKeys;
pub use matrix::MatrixRequest;
pub use mazes::{GENERATOR, GeneratedDigests, StoredMaze};
pub use merge::{MergeOptions, MergeReport};
pub use missing::Missing;
pub use open::Store;
pub use schema::{APPLICATION_ID, SCHEMA_VERSION};
pub use sink::StoreSink;
pub use submissions::Submission;
pub use transcripts::KeptTranscripts;
pub use unplayed::{Cause, Unplayed};
