//! The input and output of a robot in a step: [`Sensors`] and [`Action`], as in
//! `wit/robot.wit`.

use crate::maze::{Cell, Heading, Maze, Turn};

/// The readings before a step: the number of open cells to the nearest wall in three
/// directions, relative to the robot's heading. Range of each: 0 to the maze size - 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sensors {
    /// Open cells to the left.
    pub left: u8,
    /// Open cells ahead.
    pub front: u8,
    /// Open cells to the right.
    pub right: u8,
}

impl Sensors {
    /// The readings of a robot in that cell and heading.
    ///
    /// # Panics
    ///
    /// If the cell is outside the maze.
    pub fn at(maze: &Maze, cell: Cell, heading: Heading) -> Self {
        let reach = |turn| maze.reach(cell, heading.turned(turn));
        Self {
            left: reach(Turn::Left),
            front: reach(Turn::Straight),
            right: reach(Turn::Right),
        }
    }
}

/// What a robot does in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// Turn, then drive along the new heading.
    Move {
        /// The rotation before the move.
        turn: Turn,
        /// Cells to drive; negative drives backwards. Any value is valid: the simulation
        /// clamps it to the longest move of the rules.
        advance: i8,
    },
    /// End the exploration run and start the speed run.
    Reset,
}
