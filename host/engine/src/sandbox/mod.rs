//! Robots in other processes: a supervisor that never compiles or runs untrusted code, and
//! the sandboxed workers that do.
//!
//! One executable has four roles. The [`Supervisor`] lives in the process that the user
//! started. It starts the executable again as a *compile worker*, one for each file, which
//! examines the file and hands compiled code back; and as *run workers*, which live long, keep
//! robots and mazes, and play batches of matches. A match that ended in a fault can be played
//! once more in a *backtrace worker*, which reports where in its code the robot was. The
//! supervisor does not believe what it can check: it replays the robot's actions through its
//! own simulation, so a score comes from the rules and not from the worker.

pub mod child;
#[cfg(any(test, fuzzing))]
pub(crate) mod fuzz;
mod protocol;
mod role;
mod supervisor;

pub use role::{Role, SandboxStatus};
pub use supervisor::{Executable, PATIENCE, SandboxedRobot, Supervisor, WorkerOptions};
