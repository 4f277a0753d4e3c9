//! Mazes: cells and walls, file formats, contest legality, solving, generating.
//!
//! The first stage of the pipeline `maze -> sim -> robot -> contest -> report`.
//! Pure: reads no files, prints nothing, knows no robots. Text in, values out.

mod cell;
mod grid;
mod solver;

pub use cell::{Area, Cell, Heading, Turn};
pub use grid::{DIMENSIONS, Maze, MazeError, Walls};
pub use solver::{
    Distances, Floor, LONGEST_MOVE, Metric, Path, distances_from, distances_to_goal,
    omniscient_floor, shortest_path,
};
