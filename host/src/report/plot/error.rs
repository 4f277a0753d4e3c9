//! [`PlotError`]: why there is no plot.

use std::io;

use plotters::drawing::DrawingAreaErrorKind;
use thiserror::Error;

/// Why there is no plot.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PlotError {
    /// No match has what it shows.
    #[error("no finished match to plot")]
    Empty,
    /// A part of it cannot be drawn.
    #[error("failed to draw the plot: {0}")]
    Draw(String),
}

impl From<DrawingAreaErrorKind<io::Error>> for PlotError {
    fn from(error: DrawingAreaErrorKind<io::Error>) -> Self {
        Self::Draw(error.to_string())
    }
}
