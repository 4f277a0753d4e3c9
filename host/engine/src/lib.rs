//! The engine of wasmouse: everything about WebAssembly, from the bytes of a robot to the
//! record of a match.
//!
//! | module | holds |
//! |---|---|
//! | [`admission`] | whether a file can be a robot: [`examine`](admission::examine) |
//! | `runtime` | wasmtime: [`Runtime`], compiled robots, limits, backtraces |
//! | `time` | processor time: [`Account`], [`Control`] |
//! | `runner` | one match: [`Runtime::run`] |
//! | `profile` | the fuel of one match by function: [`Profile`] |
//! | [`sandbox`] | untrusted robots in worker processes |
//! | `executor` | [`Executor`]: [`InProcess`] and [`Sandboxed`] |
//! | `local_executor` | [`LocalExecutor`], which chooses one of the two by trust |
//! | [`bundled`] | the robots that come with wasmouse |
//!
//! What a robot does wrong is data, a [`Fault`](wasmouse_core::game::Fault) in the verdict. An
//! `Err` is an [`InfrastructureError`] and never a score; a file that is not admitted has a
//! [`Rejection`](admission::Rejection).

pub mod admission;
pub mod bundled;
mod error;
mod executor;
#[cfg(all(test, not(fuzzing)))]
mod fuzz;
#[cfg(fuzzing)]
pub mod fuzz;
mod limits;
mod local_executor;
mod profile;
mod runner;
mod runtime;
pub mod sandbox;
mod time;

pub use error::{InfrastructureError, Withdrawal};
pub use executor::{AdmittedRobot, DetailedMatch, Executor, InProcess, Played, Sandboxed, Sink};
pub use limits::{AdmissionLimits, Limits, STACK_BYTES};
pub use local_executor::{Isolation, LocalExecutor, Trust};
pub use profile::{FunctionCost, Profile, ProfileNode, ProfiledFunction};
pub use runner::Recording;
pub use runtime::{
    AdmissionError, Cache, CacheUse, CompiledRobot, ENGINE_REVISION, Frame, FramePart, Origin,
    Runtime, WASMTIME_VERSION, engine_config, engine_id,
};
pub use time::{Account, CancelFlag, Control, MATCH_TIME_MAX, match_time_max, time_factor};
