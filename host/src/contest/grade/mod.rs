//! Grades: points for what a robot did in a contest, by a [`Rubric`].
//!
//! A rubric says which mazes are played and what is expected in them. [`grade`] compares the
//! matches of one robot, a [`ScoreMatrix`](super::ScoreMatrix), with what is expected. Whatever
//! happened to the robot, its grade has an entry for every criterion. Reports are made of
//! [`Grade`]s; this folder makes no text but reasons.

mod baseline;
mod entry;
mod evaluate;
mod measure;
mod outcome;
mod read;
mod rubric;
mod significance;
#[cfg(test)]
mod tests;
mod thresholds;
mod unplayed;

pub use baseline::{Baseline, BaselineError};
pub use entry::RUBRIC_VERSION;
pub use evaluate::{Graded, Submission, grade};
pub use outcome::{CriterionGrade, FaultLine, Grade, MatchCounts, Participation, Status};
pub use rubric::{Criterion, Expectation, Mark, Rubric, RubricSet, Target, Threshold};
pub use significance::DECIDING_MAZES_MIN;
pub use thresholds::{Missed, Thresholds};
pub use unplayed::{Unplayed, UnplayedMatches};
