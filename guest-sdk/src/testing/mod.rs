//! Native matches for a robot's tests, without WebAssembly and without the host.
//!
//! A small, independent implementation of the contest rules: the Udacity maze format,
//! sensing, moving, bumps, resets, budget and score. It has no fuel and no limits; only the
//! host has those.
//!
//! ```
//! use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};
//! use wasmouse_sdk::{Action, Briefing, Robot, Sensors, Turn};
//!
//! struct Parked;
//!
//! impl Robot for Parked {
//!     fn start(_: &Briefing) -> Self {
//!         Self
//!     }
//!
//!     fn next_move(&mut self, _: Sensors) -> Action {
//!         Action::drive(Turn::Left, 0)
//!     }
//! }
//!
//! let played = testing::play::<Parked>(MAZE_01, &PlayOptions::default());
//! assert!(!played.finished);
//! assert_eq!(played.exploration_steps, 1000);
//! ```

mod arena;
mod audit;
mod maze;

pub use crate::record::{Entry, Note};
pub use arena::{PlayOptions, Played, Score, Stop, briefing, check, play};
pub use audit::MapAudit;
pub use maze::MAZE_01;
