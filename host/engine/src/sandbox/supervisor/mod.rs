//! The side of the supervisor: starts and watches worker processes, and checks their reports.

mod admit;
mod api;
mod backtraces;
pub(super) mod check;
mod clock;
mod compiler;
#[cfg(not(windows))]
mod group;
mod host_limits;
#[cfg(windows)]
mod job;
mod monitor;
mod play;
mod pool;
mod process;
mod robot;

pub use api::Supervisor;
pub use process::{Executable, PATIENCE, WorkerOptions};
pub use robot::SandboxedRobot;
