//! [`MatchPicture`]: a match as a picture, for the web page.

use wasmouse_core::game::GameRules;
use wasmouse_core::maze::{Maze, Metric, shortest_path};
use wasmouse_core::record::{ReplayError, Transcript, trace};

use crate::contest::{BestMatch, ScoreMatrix};
use crate::report::paths::paths;
use crate::report::picture::Picture;

/// Pictures that a page should have, at most: more make it slow to load.
pub const PICTURES_MAX: usize = 60;

/// The pictures of a page.
#[derive(Clone, Debug, Default)]
pub struct Pictures {
    /// The best match of each robot.
    pub best: Vec<MatchPicture>,
    /// Matches in the hardest mazes.
    pub hardest: Vec<MatchPicture>,
}

/// A match as a picture: the optimal path, and both runs of the robot.
#[derive(Clone, Debug)]
pub struct MatchPicture {
    /// Index of the robot in the matrix.
    pub(super) robot: usize,
    /// Index of the maze.
    pub(super) maze: usize,
    /// Position of the seed.
    pub(super) seed: u32,
    /// Without a title.
    pub(super) picture: Picture,
}

impl MatchPicture {
    /// Draws the match of a robot in a maze with the seed at that position, both given by their
    /// indices in the matrix; no robot runs.
    ///
    /// # Errors
    ///
    /// When the transcript is not of a match in that maze by those rules.
    pub fn new(
        (robot, maze_index, seed): (usize, usize, u32),
        maze: &Maze,
        rules: &GameRules,
        transcript: &Transcript,
    ) -> Result<Self, ReplayError> {
        let (_, trace) = trace(maze, rules, transcript)?;
        let mut picture = paths(maze, &trace);
        let longest_move = rules.longest_move;
        if let Some(path) = shortest_path(maze, Metric::Steps { longest_move }) {
            picture.set_optimum(&path);
        }
        Ok(Self {
            robot,
            maze: maze_index,
            seed,
            picture,
        })
    }

    /// Draws the match of a robot, given by its index; `None` if the matrix does not have its
    /// maze.
    ///
    /// # Errors
    ///
    /// As [`MatchPicture::new`].
    pub fn of_match(
        matrix: &ScoreMatrix,
        robot: usize,
        shown: &BestMatch,
    ) -> Result<Option<Self>, ReplayError> {
        let BestMatch { played, maze } = shown;
        let mut mazes = matrix.mazes.iter();
        let Some(index) = mazes.position(|it| it.digest == maze.digest) else {
            return Ok(None);
        };
        let seed = played.record.key.seed.wrapping_sub(matrix.seeds.first) as u32;
        let place = (robot, index, seed);
        Self::new(place, &maze.maze, &matrix.rules.game, &played.transcript).map(Some)
    }
}
