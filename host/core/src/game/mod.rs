//! A match without its robot: rules, sensors, motion, score, trace, verdict.
//!
//! The caller of a [`Simulation`] passes it the robot's actions. The rules are those of the
//! Udacity "Plot and Navigate a Virtual Maze" contest, as its public tester implements them.

mod action;
mod fuel_class;
mod rules;
mod run;
mod sandbox_limits;
mod score;
mod simulation;
mod trace;
mod verdict;

pub use action::{Action, Sensors};
pub use fuel_class::FuelClass;
pub use rules::{BudgetScope, GameRules, Ruleset};
pub use run::{Run, Steps};
pub use sandbox_limits::SandboxLimits;
pub use score::Score;
pub use simulation::{Counts, Event, Simulation};
pub use trace::{Step, Trace};
pub use verdict::{Fault, FaultKind, FuelLimit, Phase, Verdict};
