//! Pictures of matches: one [`Shot`] at one step, a [`sequence`] of steps, several matches side by
//! side as a [`Film`], and a [`poster`] of the best.
//!
//! Everything is drawn from a [`Playback`](wasmouse_core::playback::Playback): no robot runs.

mod caption;
mod film;
mod journal;
mod overlays;
mod poster;
mod sequence;
mod shot;
mod side_by_side;
#[cfg(test)]
mod tests;

pub use film::Film;
pub use overlays::{Overlay, Overlays, scene};
pub use poster::{POSTER_MAX, best_of_mazes, poster};
pub use sequence::{SEQUENCE_MAX, sequence};
pub use shot::Shot;
pub use side_by_side::side_by_side;
