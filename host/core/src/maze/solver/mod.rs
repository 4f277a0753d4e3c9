//! The solver for a maze that is fully known: distances, optimal paths, and the steps of the
//! oracle, below whose score no robot can score.
//!
//! [`distances_to_goal`] is a breadth-first search over the cells, [`shortest_path`] follows
//! its distances down to the goal, and [`oracle_steps`] are the optimal steps of both runs.
//! Robots that have to explore search in their own, partial maps instead.
//!
//! A step turns the robot by at most a quarter turn and then drives it up to `longest_move`
//! cells in a straight line, forwards or backwards. So a robot can leave a cell in all four
//! directions within one step, whatever its heading. The search state is therefore the cell
//! alone, distances are symmetric, and one search from the goal serves every cell.

mod distances;
mod oracle;
mod path;

pub use distances::{Distances, LONGEST_MOVE, Metric, distances_from, distances_to_goal};
pub use oracle::{OracleSteps, oracle_steps};
pub use path::{Path, shortest_path};
