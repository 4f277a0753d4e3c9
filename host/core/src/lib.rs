//! The core of wasmouse: mazes, the rules of the game, and records of matches.
//!
//! Everything that has to be the same wherever a match is played, stored or shown:
//!
//! - [`maze`]: cells and walls, file formats, contest rules for mazes, solving,
//!   generating;
//! - [`game`]: rules, simulation, trace, score, verdict;
//! - [`journal`]: what a robot tells the people who watch it;
//! - [`record`]: the identity of a match ([`MatchKey`](record::MatchKey)), what came of
//!   it ([`MatchRecord`](record::MatchRecord)) and the robot's actions
//!   ([`Transcript`](record::Transcript)).
//!
//! The crate knows no WebAssembly, opens no file, starts no thread and reads no clock, so
//! a web page, a terminal player or a coordinator on another machine can use it as it is.
//! It compiles for `wasm32-unknown-unknown`.

mod digest;
#[cfg(all(test, not(fuzzing)))]
mod fuzz;
#[cfg(fuzzing)]
pub mod fuzz;
pub mod game;
pub mod journal;
pub mod maze;
pub mod record;

pub use digest::{Digest, DigestBuilder, ParseDigestError};
