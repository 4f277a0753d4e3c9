//! [`MazeSource`]: a maze of a contest, generated only when it is needed.

use std::sync::Arc;

use wasmouse_core::game::{GameRules, Score};
use wasmouse_core::maze::Maze;
use wasmouse_core::maze::generate::GeneratedMaze;
use wasmouse_core::{Digest, GuestText};

/// A maze that is ready to be played.
#[derive(Clone, Debug)]
pub struct ContestMaze {
    /// What results call it.
    pub name: GuestText,
    /// The maze.
    pub maze: Arc<Maze>,
    /// Its digest.
    pub digest: Digest,
    /// The score of a robot that knows the maze; `None` when the goal cannot be reached.
    pub oracle: Option<Score>,
    /// Whether its name is the specification that generates it.
    pub is_generated: bool,
}

/// Where a maze of a contest comes from.
#[derive(Clone, Debug)]
pub enum MazeSource {
    /// It has been read.
    Loaded {
        /// What results call it.
        name: GuestText,
        /// The maze.
        maze: Arc<Maze>,
    },
    /// It will be generated. A contest can have a million of these.
    Generated(GeneratedMaze),
}

impl MazeSource {
    /// What results call it.
    pub fn name(&self) -> GuestText {
        match self {
            Self::Loaded { name, .. } => name.clone(),
            Self::Generated(maze) => maze.to_string().into(),
        }
    }

    /// The maze itself, generated if need be and solved under these rules.
    pub fn prepare(&self, rules: &GameRules) -> ContestMaze {
        let maze = match self {
            Self::Loaded { maze, .. } => Arc::clone(maze),
            Self::Generated(generated) => Arc::new(generated.generate()),
        };
        ContestMaze {
            name: self.name(),
            digest: maze.digest(),
            oracle: rules.oracle_score(&maze),
            is_generated: matches!(self, Self::Generated(_)),
            maze,
        }
    }
}
