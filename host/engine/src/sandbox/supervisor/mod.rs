//! The side of the supervisor: starts and watches worker processes, and checks their reports.

mod admit;
mod api;
pub(super) mod check;
mod compiler;
mod group;
mod host_limits;
mod monitor;
mod play;
mod pool;
mod process;
mod robot;

pub use api::Supervisor;
pub use process::{Executable, PATIENCE, WorkerOptions};
pub use robot::SandboxedRobot;
