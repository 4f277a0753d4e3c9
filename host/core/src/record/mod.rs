//! What identifies a match and what is kept of it.
//!
//! A match is a pure function of its [`MatchKey`]. The digest of the key is its address in
//! results, stores, caches, queues and replays. What came of it is a [`MatchRecord`]; the
//! robot's actions are a [`Transcript`], from which [`replay`] gives every reading and event
//! again, without the robot.

mod key;
mod match_record;
mod replay;
mod spec;
mod transcript;

pub use key::{EngineId, MatchKey};
pub use match_record::{FuelUse, MatchRecord};
pub use replay::{GameResult, ReplayError, replay, trace};
pub use spec::MatchSpec;
pub use transcript::{Ending, Transcript, TranscriptError};
