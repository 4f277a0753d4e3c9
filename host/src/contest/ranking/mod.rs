//! The ranking of a contest, and the comparison of two of its robots: pure functions of a
//! [`ScoreMatrix`](super::ScoreMatrix) and a [`Scoring`](super::Scoring).
//!
//! [`selection`] says which robots and mazes count, [`points`] turns a match into a number,
//! [`totals`] adds the matches of a robot up, [`rank_points`] compares robots match by match,
//! [`percentiles`] finds medians, [`order`] decides ranks, [`ranks`] puts all together. [`paired`]
//! compares two robots, with the interval of [`bootstrap`].

mod bootstrap;
mod line;
mod order;
mod paired;
mod percentiles;
mod points;
mod rank_points;
mod ranks;
mod selection;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod totals;

pub use line::RankingLine;
pub use paired::{PairedComparison, PairedVerdict};
pub use percentiles::Percentiles;
pub use ranks::Ranking;
pub use selection::{MazeFilter, RobotState};
