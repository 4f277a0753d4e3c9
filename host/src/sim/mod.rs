//! One match without its robot: rulesets, sensors, motion, score, trace.
//!
//! The second stage of the pipeline `maze -> sim -> robot -> contest -> report`.
//! Pure: a [`Simulation`] is told what the robot answers and knows neither wasm
//! nor time nor chance. The rules are those of the Udacity "Plot and Navigate a
//! Virtual Maze" contest, as its public tester plays them.

mod action;
mod limits;
mod ruleset;
mod score;
mod simulation;
mod trace;

pub use action::{Action, Sensors};
pub use limits::{AdmissionLimits, Limits};
pub use ruleset::{BudgetScope, Ruleset};
pub use score::Score;
pub use simulation::{Counts, End, Run, Simulation};
pub use trace::{Event, Step, Trace};
