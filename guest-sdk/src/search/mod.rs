//! Searching for the fewest steps.

mod packed;
mod steps;

pub use steps::Search;
