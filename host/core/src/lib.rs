//! The core of wasmouse: mazes, the rules of the game, and records of matches.
//!
//! It holds what has to be the same wherever a match is played, stored or shown:
//!
//! - [`maze`]: cells and walls, file formats, contest rules for mazes, solver, generators;
//! - [`game`]: rules, simulation, trace, score, verdict;
//! - [`mod@guest_text`]: text from outside, which cannot be printed without escaping it;
//! - [`journal`]: log lines, colours and labels of a robot;
//! - [`record`]: the identity of a match ([`MatchKey`](record::MatchKey)), its outcome
//!   ([`MatchRecord`](record::MatchRecord)) and the robot's actions
//!   ([`Transcript`](record::Transcript));
//! - [`knowledge`]: what a robot could know at every step;
//! - [`playback`]: a match at any step, for those who show it;
//! - [`replay`]: a match in a file, to be watched without the robot.
//!
//! The crate does not use WebAssembly, files, threads or clocks, so that a web page, a
//! terminal player or a coordinator on another machine can use it. It compiles for
//! `wasm32-unknown-unknown`.
//!
//! A match from its robot's actions:
//!
//! ```
//! use wasmouse_core::game::{Action, Ruleset, Verdict};
//! use wasmouse_core::maze::{Maze, Turn, Walls};
//! use wasmouse_core::record::{Transcript, trace};
//!
//! let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
//! let drive = |turn, advance| Action::Move { turn, advance };
//! // To (5, 5) in the goal, which ends the exploration run, and there again.
//! let path = [
//!     drive(Turn::Straight, 3),
//!     drive(Turn::Straight, 2),
//!     drive(Turn::Right, 3),
//!     drive(Turn::Straight, 2),
//! ];
//! let mut transcript = Transcript::default();
//! for action in path.into_iter().chain([Action::Reset]).chain(path) {
//!     transcript.push(action);
//! }
//!
//! let rules = Ruleset::default().game;
//! let (result, trace) = trace(&maze, &rules, &transcript).expect("a whole match");
//! let score = result.verdict.score().expect("finished");
//! assert_eq!(score.to_string(), "4.167");
//! assert_eq!(Some(score), rules.oracle_score(&maze));
//! assert_eq!(trace.steps()[2].sensors.right, 11);
//! ```

mod digest;
#[cfg(all(test, not(fuzzing)))]
mod fuzz;
#[cfg(fuzzing)]
pub mod fuzz;
pub mod game;
pub mod guest_text;
pub mod journal;
pub mod knowledge;
pub mod maze;
pub mod playback;
pub mod record;
pub mod replay;

pub use digest::{Digest, DigestBuilder, ParseDigestError};
pub use guest_text::GuestText;
