//! Animated pictures: [`gif`] and [`apng`] write frames as they are drawn.
//!
//! A frame holds only what differs from the one before: the smallest rectangle around it, in which
//! the pixels that stay are transparent. Neither format knows what is drawn; frames come from a
//! [`Frames`].

mod apng;
mod error;
mod frames;
mod gif;
mod palette;
mod patch;
#[cfg(test)]
mod tests;

pub use apng::apng;
pub use error::{AnimationError, PIXELS_MAX};
pub use frames::{Frames, Timing};
pub use gif::gif;
