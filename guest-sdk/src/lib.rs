//! A toolkit for writing wasmouse robots in Rust. It has no dependencies.
//!
//! A robot is a type that implements [`Robot`]; [`export_robot!`] exports it as a component.
//! Everything else is optional:
//!
//! | to | use |
//! |---|---|
//! | represent positions | [`Cell`], [`Heading`], [`Pose`] |
//! | remember walls | [`Map`], [`Passages`], [`CellSet`] |
//! | keep track of position, walls and budget | [`Tracker`] |
//! | find the path with the fewest steps | [`Search`] |
//! | find the next wall worth looking at | [`Doubt`] |
//! | prove that the best path is known | [`Certificate`] |
//! | find the cheapest path when walls have costs | [`WeightedSearch`], [`Grid`] |
//! | search by counting squares, as simple maze robots do | [`Expansion`] |
//! | generate random numbers from the seed | [`Random`] |
//! | log messages, color and label cells | [`journal`] |
//! | test a robot natively, without WebAssembly | [`testing`] |
//!
//! The documentation of [`Robot`] has a minimal example; `example-robots/` in the wasmouse
//! repository has complete robots.
//!
//! All of this measures distances in cells, for tracks whose
//! [`units_per_cell`](Briefing::units_per_cell) is 1, and needs the size and the goal of the
//! maze. All current rulesets are such tracks.

#[doc(hidden)]
pub mod bindings;
mod certificate;
mod doubt;
mod expansion;
mod geometry;
mod grid;
mod hop;
pub mod journal;
mod map;
mod passages;
mod pose;
mod random;
#[cfg(not(target_arch = "wasm32"))]
mod record;
mod robot;
mod search;
#[cfg(not(target_arch = "wasm32"))]
pub mod testing;
mod tracker;
mod weighted;

pub use bindings::wasmouse::robot::types::{
    Action, Area, Briefing, BudgetScope, Cell, Heading, Move, Sensors, Turn,
};
pub use certificate::Certificate;
pub use doubt::Doubt;
pub use expansion::Expansion;
pub use geometry::DIMENSION_MAX;
pub use grid::Grid;
pub use hop::Hop;
pub use map::{Map, News, View, Wall};
pub use passages::{CellSet, Passages};
pub use pose::Pose;
pub use random::Random;
pub use robot::Robot;
pub use search::Search;
pub use tracker::{Run, Tracker};
pub use weighted::{IMPASSABLE, WeightedSearch};
