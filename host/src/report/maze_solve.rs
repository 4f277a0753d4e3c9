//! The JSON of `wasmouse maze solve`.
//!
//! ```json
//! {
//!   "schema": 1,
//!   "mazes": [
//!     {
//!       "maze": "test_maze_01",
//!       "dimension": 12,
//!       "solution": {
//!         "fewest_steps": {"steps": 17, "cells": 30, "stops": [[0, 0], [0, 3]]},
//!         "fewest_cells": {"steps": 17, "cells": 30, "stops": [[0, 0], [0, 3]]},
//!         "floor": {"speed_steps": 17, "exploration_steps": 18, "score": "17.600"}
//!       }
//!     },
//!     {"maze": "walled-in", "dimension": 12, "solution": null}
//!   ]
//! }
//! ```
//!
//! Stops are the cells `[x, y]` where steps end, the start first. The score is
//! a string with exactly three decimals, so that no reader rounds it.

use serde::Serialize;

use super::json;
use crate::maze::{Floor, Path};
use crate::sim::Score;

/// The version of this JSON; raised when a reader of the old one would go wrong.
const SCHEMA: u32 = 1;

/// The whole document.
#[derive(Serialize)]
pub struct MazeSolve {
    schema: u32,
    mazes: Vec<SolvedMaze>,
}

impl MazeSolve {
    /// The document for these mazes.
    pub const fn new(mazes: Vec<SolvedMaze>) -> Self {
        Self {
            schema: SCHEMA,
            mazes,
        }
    }

    /// The document as text, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }
}

/// One maze and its solution, `null` when it has none.
#[derive(Serialize)]
pub struct SolvedMaze {
    /// What the user calls the maze.
    pub maze: String,
    /// Cells along each side.
    pub dimension: u8,
    /// The optimal ways to the goal.
    pub solution: Option<SolutionJson>,
}

/// The optimal ways to the goal of one maze.
#[derive(Serialize)]
pub struct SolutionJson {
    fewest_steps: PathJson,
    fewest_cells: PathJson,
    floor: FloorJson,
}

impl SolutionJson {
    /// The solution with these paths, optimal in steps and in cells, and the
    /// floor with its score.
    pub fn new(fewest_steps: &Path, fewest_cells: &Path, floor: Floor, score: Score) -> Self {
        Self {
            fewest_steps: PathJson::new(fewest_steps),
            fewest_cells: PathJson::new(fewest_cells),
            floor: FloorJson {
                speed_steps: floor.speed_steps,
                exploration_steps: floor.exploration_steps,
                score: score.to_string(),
            },
        }
    }
}

#[derive(Serialize)]
struct PathJson {
    steps: u32,
    cells: u32,
    stops: Vec<[u8; 2]>,
}

impl PathJson {
    fn new(path: &Path) -> Self {
        Self {
            steps: path.steps(),
            cells: path.cells(),
            stops: path.stops().iter().map(|stop| [stop.x, stop.y]).collect(),
        }
    }
}

#[derive(Serialize)]
struct FloorJson {
    speed_steps: u32,
    exploration_steps: u32,
    score: String,
}
