//! Plots of a contest as SVG, one file for each kind. All are made from a
//! [`ScoreMatrix`](crate::contest::ScoreMatrix).
//!
//! Robots are told apart by colour and by marker or hatching, so a plot can be read without colours.
//! There are no random numbers, dates or fonts of the system in it: the same matrix gives the same
//! bytes.

mod area;
mod bars;
mod canvas;
mod data;
mod document;
mod error;
mod fuel;
mod kind;
mod look;
mod margins;
mod options;
mod regret;
mod runs;
#[cfg(test)]
mod tests;

pub use bars::Measure;
pub use data::ROBOTS_MAX;
pub use document::svg;
pub use error::PlotError;
pub use kind::Kind;
pub use options::Options;
