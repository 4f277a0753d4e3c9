//! The identity of a match, and what is stored of it.
//!
//! A match is a pure function of its [`MatchKey`], whose digest is its address in stores, caches
//! and queues. The outcome of a match is a [`MatchRecord`], the robot's actions are a
//! [`Transcript`]. From the transcript, [`replay`] computes the outcome and [`trace()`] every
//! reading and event, without the robot.

mod key;
mod match_record;
mod replay;
mod spec;
#[cfg(test)]
mod tests;
mod transcript;

pub use key::{EngineId, MatchKey};
pub use match_record::{FuelUse, MatchRecord, RecordVersion, Usage};
pub use replay::{GameResult, ReplayError, replay, trace};
pub use spec::MatchSpec;
pub use transcript::{Ending, Transcript, TranscriptError};
