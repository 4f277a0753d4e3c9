//! `wasmouse drive`: a match steered by hand, with what a robot sees and nothing more.
//!
//! [`driver`] has the match and the keys, [`view`] draws it, [`outcome`] says what came of it, [`app`]
//! makes a program of them, [`replay_file`] keeps it, and [`start`] has the arguments. The
//! true maze is only in the simulation: what is drawn comes from readings.

mod app;
mod driver;
mod outcome;
mod replay_file;
mod start;
mod view;

pub use start::{Args, run};
