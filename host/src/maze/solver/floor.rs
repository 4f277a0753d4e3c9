//! [`Floor`]: the score of a robot that knows the maze before it starts.
//!
//! Such a robot drives the optimal path, resets, and drives it again. No robot
//! can score lower, because run 1 has to reach the goal too and the reset is a
//! step of run 1.

use super::super::Maze;
use super::distances::{Metric, distances_to_goal};

/// The steps of both runs of a robot that knows the maze, as exact integers.
///
/// The score they make depends on the ruleset; in `udacity` it is
/// `speed_steps + exploration_steps / 30`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Floor {
    /// Steps of run 2: the step optimum.
    pub speed_steps: u32,
    /// Steps of run 1: the step optimum and the reset.
    pub exploration_steps: u32,
}

/// The floor of a maze for robots that move up to `longest_move` cells in a
/// step; `None` when the goal cannot be reached.
///
/// ```
/// use wasmouse::maze::{LONGEST_MOVE, Maze, Walls, omniscient_floor};
/// let maze = Maze::contest(Walls::open(12)).expect("a 12 x 12 maze has room");
/// let floor = omniscient_floor(&maze, LONGEST_MOVE).expect("nothing is in the way");
/// assert_eq!((floor.speed_steps, floor.exploration_steps), (4, 5));
/// ```
pub fn omniscient_floor(maze: &Maze, longest_move: u8) -> Option<Floor> {
    let optimum = distances_to_goal(maze, Metric::Steps { longest_move }).get(maze.start())?;
    Some(Floor {
        speed_steps: optimum,
        exploration_steps: optimum + 1,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maze::{LONGEST_MOVE, Walls, bundled, format, shortest_path};

    #[test]
    fn the_first_official_maze_has_its_known_optimum() {
        let text = bundled()[0].text;
        let maze = format::parse(text).expect("a maze").maze;
        let path = shortest_path(&maze, Metric::STEPS).expect("solvable");
        assert_eq!((path.steps(), path.cells()), (17, 30));
        let floor = omniscient_floor(&maze, LONGEST_MOVE).expect("solvable");
        assert_eq!((floor.speed_steps, floor.exploration_steps), (17, 18));
    }

    #[test]
    fn a_maze_without_solution_has_no_floor() {
        let maze = Maze::contest(Walls::closed(12)).expect("room for both");
        assert_eq!(omniscient_floor(&maze, LONGEST_MOVE), None);
    }
}
