//! [`Kind`]: what a plot shows.

use super::bars::Measure;
use crate::contest::Benchmark;

/// What a plot shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Robots compared maze by maze, or by size where there are many mazes; as in Lobato's report.
    Bars(Measure),
    /// How far scores are from a benchmark, as a histogram for each size; as in Minnett's report.
    Margins(Benchmark),
    /// The exploration run against the speed run, a point for each finished match.
    Runs,
    /// The score against fuel, a point for each finished match.
    Fuel,
    /// The share of matches with at most so much regret.
    Regret,
}
