//! [`Hop`]: a move in a straight line.

use crate::Heading;

/// A move in a straight line, in one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Hop {
    /// The direction of travel in the maze.
    pub heading: Heading,
    /// How far, in cells, at least 1.
    pub cells: u32,
}
