//! What crosses between a robot and the simulation: [`Sensors`] in, [`Action`] out.
//!
//! The same values as in `wit/robot.wit`, without any wasm in them.

use crate::maze::Turn;
use serde::{Deserialize, Serialize};

/// The readings before a step: open cells to the nearest wall, relative to the
/// robot's heading. Range of each: 0 to the maze's dimension - 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sensors {
    /// Open cells to the left.
    pub left: u8,
    /// Open cells ahead.
    pub front: u8,
    /// Open cells to the right.
    pub right: u8,
}

/// What a robot does in one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Action {
    /// Turn, then drive that many cells along the new heading. Negative drives
    /// backwards; the simulation clamps to the ruleset's longest move.
    Move {
        /// The rotation, done first.
        turn: Turn,
        /// Cells to drive; any `i8`.
        advance: i8,
    },
    /// End the exploration run and begin the speed run.
    Reset,
}
