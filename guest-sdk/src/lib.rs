//! Write wasmouse robots in Rust.
//!
//! A robot is a type that implements [`Robot`]; [`export_robot!`] makes the
//! component's exports of it. The rest is a toolkit to use or to leave:
//!
//! | to | use |
//! |---|---|
//! | say where the robot is | [`Cell`], [`Heading`], [`Pose`] |
//! | remember walls | [`Map`], [`Passages`], [`CellSet`] |
//! | keep pose, map and budget together | [`Tracker`] |
//! | find the fewest steps | [`Search`] |
//! | find what still has to be seen | [`Doubt`] |
//! | search as simple robots do, by counting squares | [`Expansion`] |
//! | find the cheapest ways when walls have costs | [`WeightedSearch`], [`Grid`] |
//! | know that the best path is found | [`Certificate`] |
//! | roll dice | [`Random`] |
//! | tell the people who watch something | [`journal`] |
//! | test a robot natively, without WebAssembly | [`testing`] |
//!
//! The smallest robot that does something is in the documentation of [`Robot`];
//! `example-robots/` in the wasmouse repository has complete ones.

#[doc(hidden)]
pub mod bindings;
mod certificate;
mod doubt;
mod expansion;
mod geometry;
mod grid;
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
pub use map::{Map, News, View, Wall};
pub use passages::{CellSet, Passages};
pub use pose::Pose;
pub use random::Random;
pub use robot::Robot;
pub use search::{Hop, Search};
pub use tracker::{Run, Tracker};
pub use weighted::{IMPASSABLE, WeightedSearch};
