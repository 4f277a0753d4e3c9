//! Mazes: cells and walls, file formats, contest rules for mazes, solver, generators.
//!
//! Text in, values out: no files and no robots.

mod bundled;
mod cell;
pub mod format;
pub mod generate;
mod grid;
mod legality;
mod listed;
mod solver;
mod survey;
#[cfg(test)]
pub(crate) mod testing;

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
