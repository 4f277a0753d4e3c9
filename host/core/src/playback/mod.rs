//! [`Playback`]: a match as it is watched, at any step, forwards and backwards.
//!
//! It is what a web page, a terminal player and a picture have in common: all of them ask for a
//! position and draw what they get. A position is a number of steps: 0 is before the first step,
//! [`Playback::last`] after the last one.

mod milestone;
mod positions;
#[cfg(test)]
mod tests;

pub use milestone::{Milestone, MilestoneKind};
pub use positions::{Playback, Position};
