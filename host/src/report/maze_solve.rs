//! The JSON of `wasmouse maze solve`.
//!
//! ```json
//! {
//!   "version": 2,
//!   "mazes": [
//!     {
//!       "maze": "test_maze_01", "digest": "...", "dimension": 12,
//!       "solution": {
//!         "fewest_steps": {"steps": 17, "cells": 30, "stops": [[0, 0], [0, 3]]},
//!         "fewest_cells": {"steps": 17, "cells": 30, "stops": [[0, 0], [0, 3]]},
//!         "oracle": {
//!           "thousandths": 17600, "speed_steps": 17, "exploration_steps": 18,
//!           "exploration_divisor": 30
//!         }
//!       }
//!     },
//!     {"maze": "walled-in", "digest": "...", "dimension": 12, "solution": null}
//!   ]
//! }
//! ```
//!
//! Stops are the cells `[x, y]` where steps end, the start first. `oracle` is the score of a
//! robot that knows the maze.

use serde::Serialize;
use wasmouse_core::game::Score;
use wasmouse_core::maze::{Maze, Path};
use wasmouse_core::{Digest, GuestText};

use super::json;

/// The version of this document; raised when a reader of the old one would go wrong.
const VERSION: u32 = 2;

/// The whole document.
#[derive(Serialize)]
pub struct MazeSolve {
    version: u32,
    mazes: Vec<SolvedMaze>,
}

impl MazeSolve {
    /// The document for these mazes.
    pub const fn new(mazes: Vec<SolvedMaze>) -> Self {
        Self {
            version: VERSION,
            mazes,
        }
    }

    /// The document as text, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }
}

/// One maze and its solution.
#[derive(Serialize)]
pub struct SolvedMaze {
    maze: GuestText,
    digest: Digest,
    dimension: u8,
    solution: Option<Solution>,
}

impl SolvedMaze {
    /// The maze of that name with its solution; `None` when the goal cannot be reached.
    pub fn new(name: &GuestText, maze: &Maze, solution: Option<Solution>) -> Self {
        Self {
            maze: name.clone(),
            digest: maze.digest(),
            dimension: maze.dimension(),
            solution,
        }
    }
}

/// The optimal paths to the goal of one maze.
#[derive(Serialize)]
pub struct Solution {
    fewest_steps: PathJson,
    fewest_cells: PathJson,
    oracle: Score,
}

impl Solution {
    /// The solution with these paths, optimal in steps and in cells, and the oracle score.
    pub fn new(fewest_steps: &Path, fewest_cells: &Path, oracle: Score) -> Self {
        Self {
            fewest_steps: PathJson::new(fewest_steps),
            fewest_cells: PathJson::new(fewest_cells),
            oracle,
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
