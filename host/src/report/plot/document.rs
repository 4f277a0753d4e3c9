//! [`svg()`]: a plot of any kind.

use super::error::PlotError;
use super::kind::Kind;
use super::options::Options;
use super::{bars, fuel, margins, regret, runs};
use crate::contest::ScoreMatrix;

/// The plot as an SVG document with a line feed at its end, 800 units wide. It shows the best
/// [`ROBOTS_MAX`](super::ROBOTS_MAX) robots and says how many more there are.
///
/// # Errors
///
/// When no match has what it shows.
pub fn svg(kind: Kind, matrix: &ScoreMatrix, options: &Options) -> Result<String, PlotError> {
    match kind {
        Kind::Bars(measure) => bars::svg(measure, matrix, options),
        Kind::Margins(benchmark) => margins::svg(benchmark, matrix, options),
        Kind::Runs => runs::svg(matrix, options),
        Kind::Fuel => fuel::svg(matrix, options),
        Kind::Regret => regret::svg(matrix, options),
    }
}
