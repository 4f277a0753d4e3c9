//! The wasmtime side: one engine configuration, the functions a robot may call, its limits,
//! compiled code and the cache of it.

mod artefact;
mod backtrace;
mod bindings;
mod cache;
mod cache_folder;
mod compiled_code;
mod compilers;
mod config;
mod cost;
mod entry;
mod fault;
mod guest;
mod interface;
mod limiter;
mod names;
mod robot;
mod startup;
mod target;

pub(crate) use artefact::precompile;
pub(crate) use backtrace::{FRAMES_MAX, frames};
pub use backtrace::{Frame, FramePart};
pub(crate) use bindings::{Robot as Instance, action, briefing, sensors};
pub use cache::Cache;
pub(crate) use cache::CacheEntry;
pub(crate) use compiled_code::{CompiledCode, Destination};
pub(crate) use config::{Clock, new_backtrace_compiler, new_compiler};
pub use config::{ENGINE_REVISION, WASMTIME_VERSION, engine_config, engine_id};
pub(crate) use fault::{classify, out_of_fuel};
pub(crate) use guest::Guest;
pub use names::Origin;
pub(crate) use names::{readable, shortened};
pub use robot::{AdmissionError, CacheUse, CompiledRobot, Runtime};
