//! [`Replay`]: one match in one file, to be watched without the robot.
//!
//! A replay holds the maze, the rules, the record and the robot's actions; everything else follows
//! from them ([`Playback`](crate::playback::Playback)). It is checked when it is read, so a `Replay`
//! is always a match that can have happened.

mod error;
mod form;
mod parts;
#[cfg(test)]
mod tests;

pub use error::ReplayFileError;
pub use parts::{BYTES_MAX, NAME_CHARS_MAX, Replay, ReplayParts};
