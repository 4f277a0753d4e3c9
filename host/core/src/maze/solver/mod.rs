//! Solving a maze that is fully known: distances, optimal paths and the oracle score
//! below which no robot can score.
//!
//! [`distances`](self::distances_to_goal) are breadth-first searches over the
//! cells, [`path`](self::shortest_path) walks down the resulting map, and
//! [`oracle_steps`] turns the optimum into the steps of both
//! runs. Knows nothing of robots that still have to explore; those search in
//! their own, partial maps.
//!
//! A step turns the robot by at most a quarter turn and then drives it up to
//! `longest_move` cells in a straight line, forwards or backwards. Turned left,
//! turned right, straight on and backwards are the four directions, so every
//! heading can leave a cell in all of them within one step. The heading
//! therefore is no part of the search state: a cell is. For the same reason
//! distances are symmetric, and one search from the goal serves every cell.

mod distances;
mod oracle;
mod path;
#[cfg(test)]
mod testing;

pub use distances::{Distances, LONGEST_MOVE, Metric, distances_from, distances_to_goal};
pub use oracle::{OracleSteps, oracle_steps};
pub use path::{Path, shortest_path};
