//! Everything about WebAssembly: from the bytes of a robot to its answers.
//!
//! The third stage of the pipeline `maze -> sim -> robot -> contest -> report`.
//! A [`Host`] admits files as [`Robot`]s or says in a [`Refusal`] why not, and
//! plays matches with them: [`Host::play`]. What a robot does wrong is data (a
//! [`Fault`] in the [`Verdict`]); an `Err` is a failure of the host and never a
//! score. A [`Referee`] hides whether a robot runs in this process or in a confined
//! [`worker`].

pub mod bundled;
pub mod componentize;
pub mod precheck;
pub mod worker;

mod admission;
mod backtrace;
mod bindings;
mod cache;
mod code;
mod controller;
mod cost;
mod digest;
mod engine;
mod error;
mod fault;
mod guest;
mod host;
mod inspection;
mod journal;
mod limiter;
mod play;
mod referee;
mod refusal;
mod shape;
mod version;

pub use backtrace::Frame;
pub use cache::Cache;
pub use digest::Digest;
pub use engine::{ENGINE_REVISION, MATCH_SECONDS_MAX, WASMTIME_VERSION, engine_config, engine_id};
pub use error::HostError;
pub use fault::{Fault, FaultKind, FuelLimit};
pub use host::{CacheUse, Host, Robot};
pub use inspection::{Inspection, Needs};
pub use journal::{Belief, Color, Entry, Journal, Level, Note};
pub use play::{FuelUse, Game, Outcome, Phase, Recorder, Verdict};
pub use referee::{Each, Isolation, Player, Record, Referee, Trust};
pub use refusal::Refusal;
pub use shape::Shape;
pub use version::VERSION as INTERFACE_VERSION;
pub use worker::{Executable, PATIENCE, Sandbox, Workers};

/// Stack of the threads that run robots, in bytes: wasm gets its own limit of
/// it, and wasmtime needs room for itself beyond that.
pub const STACK_BYTES: usize = 8 << 20;
