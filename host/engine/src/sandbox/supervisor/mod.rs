//! The side of the supervisor: starts and watches worker processes, and checks their reports.

mod admit;
pub(super) mod check;
mod compiler;
mod monitor;
mod play;
mod pool;
mod process;
mod robot;
mod supervisor;

pub use process::{Executable, PATIENCE, WorkerOptions};
pub use robot::SandboxedRobot;
pub use supervisor::Supervisor;
