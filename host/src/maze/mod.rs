//! Mazes: cells and walls, file formats, contest legality, solving, generating.
//!
//! The first stage of the pipeline `maze -> sim -> robot -> contest -> report`.
//! Pure: reads no files, prints nothing, knows no robots. Text in, values out.

mod cell;
mod grid;

pub use cell::{Area, Cell, Heading, Turn};
pub use grid::{DIMENSIONS, Maze, MazeError, Walls};
