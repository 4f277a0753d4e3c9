//! The engine of wasmouse: everything about WebAssembly, from the bytes of a robot to the
//! record of a match.
//!
//! | module | holds |
//! |---|---|
//! | [`admission`] | whether a file can be a robot: [`examine`](admission::examine) |
//! | `runtime` | wasmtime: [`Runtime`], compiled robots, limits, backtraces |
//! | `runner` | one match: [`Runtime::run`] |
//! | [`sandbox`] | untrusted robots in worker processes |
//! | `executor` | [`Executor`], and where robots run by trust: [`LocalExecutor`] |
//! | [`bundled`] | the robots that come with wasmouse |
//!
//! What a robot does wrong is data, a [`Fault`](wasmouse_core::game::Fault) in the verdict. An
//! `Err` is an [`InfrastructureError`] and never a score; a file that is not admitted has a
//! [`Rejection`](admission::Rejection).

pub mod admission;
pub mod bundled;
mod error;
mod executor;
mod limits;
mod runner;
mod runtime;
pub mod sandbox;

pub use error::InfrastructureError;
pub use executor::{
    AdmittedRobot, DetailedMatch, Executor, InProcess, Isolation, LocalExecutor, Played, Sandboxed,
    Sink, Trust,
};
pub use limits::{AdmissionLimits, Limits, STACK_BYTES};
pub use runner::Recording;
pub use runtime::{
    Cache, CacheUse, CompiledRobot, ENGINE_REVISION, Frame, MATCH_SECONDS_MAX, Runtime,
    WASMTIME_VERSION, engine_config, engine_id,
};
