//! What a robot can know of a maze: [`Knowledge`] from its readings alone, and the [`Audit`] of a
//! match.
//!
//! A robot knows the size of the maze, its start and its goal, and it can always work out where it
//! is: readings tell how far it can drive to the left, ahead and to the right, and after driving
//! backwards the distance ahead has grown by the cells it drove. So every wall between two cells is
//! known to be there, known not to be there, or can be either, whatever the others are. Nothing
//! else is used, in particular not the contest rules about mazes (one entrance to the goal, start
//! open at the top): a robot that relies on them can be sure earlier.

mod audit;
mod known_walls;
mod outlook;
#[cfg(test)]
mod tests;
mod walk;

pub use audit::{Audit, Contradiction, RegretSplit, StepAudit};
pub use known_walls::Knowledge;
pub use outlook::Outlook;
pub use walk::Walk;
