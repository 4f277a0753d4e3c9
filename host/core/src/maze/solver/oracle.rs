//! [`OracleSteps`]: the steps of an oracle, a robot that knows the maze before it starts.
//!
//! The oracle drives the optimal path, resets, and drives it again. No robot can score lower:
//! the exploration run has to reach the goal too, and includes the reset.

use super::super::Maze;
use super::distances::{Metric, distances_to_goal};

/// The steps of both runs of an oracle.
///
/// [`GameRules::oracle_score`](crate::game::GameRules::oracle_score) is their score.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OracleSteps {
    /// Steps of the speed run: the fewest possible from the start to the goal.
    pub speed_steps: u32,
    /// Steps of the exploration run: the same, and the reset.
    pub exploration_steps: u32,
}

/// The steps of an oracle that moves up to `longest_move` cells in a step; `None` if the goal
/// is unreachable.
///
/// ```
/// use wasmouse_core::maze::{LONGEST_MOVE, Maze, Walls, oracle_steps};
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let oracle = oracle_steps(&maze, LONGEST_MOVE).expect("the goal is reachable");
/// assert_eq!((oracle.speed_steps, oracle.exploration_steps), (4, 5));
/// ```
pub fn oracle_steps(maze: &Maze, longest_move: u8) -> Option<OracleSteps> {
    let optimum = distances_to_goal(maze, Metric::Steps { longest_move }).get(maze.start())?;
    Some(OracleSteps {
        speed_steps: optimum,
        exploration_steps: optimum + 1,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maze::{LONGEST_MOVE, Walls, bundled, format, shortest_path};

    #[test]
    fn the_first_official_maze_has_its_published_optimum() {
        let text = bundled()[0].text;
        let maze = format::parse(text).expect("a maze").maze;
        let path = shortest_path(&maze, Metric::STEPS).expect("solvable");
        assert_eq!((path.steps(), path.cells()), (17, 30));
        let oracle = oracle_steps(&maze, LONGEST_MOVE).expect("solvable");
        assert_eq!((oracle.speed_steps, oracle.exploration_steps), (17, 18));
    }

    #[test]
    fn an_unsolvable_maze_has_no_oracle_steps() {
        let maze = Maze::contest(Walls::closed(12)).expect("start and goal fit");
        assert_eq!(oracle_steps(&maze, LONGEST_MOVE), None);
    }
}
