//! Everything about WebAssembly: from the bytes of a robot to its answers.
//!
//! The third stage of the pipeline `maze -> sim -> robot -> contest -> report`.
//! A [`Host`] admits files as [`Robot`]s or says in a [`Refusal`] why not, and
//! plays matches with them: [`Host::play`]. What a robot does wrong is data (a
//! [`Fault`] in the [`Verdict`]); an `Err` is a failure of the host and never a
//! score. Robots run in this process; nothing outside this module knows that.

pub mod bundled;
pub mod componentize;

mod bindings;
mod cache;
mod controller;
mod digest;
mod engine;
mod error;
mod fault;
mod guest;
mod host;
mod inspection;
mod journal;
mod limiter;
mod over_limit;
mod play;
mod refusal;
mod shape;

pub use cache::Cache;
pub use digest::Digest;
pub use engine::{ENGINE_REVISION, MATCH_SECONDS_MAX, WASMTIME_VERSION, engine_config, engine_id};
pub use error::HostError;
pub use fault::{Fault, FaultKind, FuelLimit};
pub use host::{CacheUse, Host, Robot};
pub use inspection::{Inspection, Needs};
pub use journal::{Belief, Color, Entry, Journal, Level, Note};
pub use play::{FuelUse, Game, Outcome, Phase, Recorder, Verdict};
pub use refusal::Refusal;
pub use shape::Shape;
