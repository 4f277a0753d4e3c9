//! Mazes: cells and walls, file formats, contest legality, solving, generating.
//!
//! The first stage of the pipeline `maze -> sim -> robot -> contest -> report`.
//! Pure: reads no files, prints nothing, knows no robots. Text in, values out.

mod bundled;
mod cell;
pub mod format;
pub mod generate;
mod grid;
mod legality;
mod listed;
mod solver;
mod survey;

pub use bundled::{BundledMaze, bundled};
pub use cell::{Area, Cell, Heading, Turn};
pub use grid::{DIMENSIONS, Maze, MazeError, Walls};
pub use legality::{
    Entrance, InnerWall, Violation, goal_entrances, is_contest_legal, unreachable_cells, violations,
};
pub use solver::{
    Distances, LONGEST_MOVE, Metric, OracleSteps, Path, distances_from, distances_to_goal,
    oracle_steps, shortest_path,
};
pub use survey::Survey;
