//! Robots in other processes: a supervisor that never compiles or runs a stranger's
//! code, and the confined workers that do.
//!
//! One executable has four roles. The [`Supervisor`] lives in the process that the
//! user started. It starts the executable again as a *compile worker*, one for each
//! file, which reads the file, decides whether it can be a robot, and hands compiled
//! code back; and as *play workers*, which live long, keep robots and mazes, and play
//! batches of matches. A match that ended in a fault can be played once more in an
//! *explain worker*, which says where in its code the robot was. What a worker says is
//! believed as far as it has to be: the supervisor plays the robot's answers through its
//! own simulation, so a score comes from the rules and not from the worker.

pub mod confine;
#[doc(hidden)]
pub mod fuzz;

mod admit;
mod begin;
mod compile;
mod compiler;
mod explain;
mod keeper;
mod matches;
mod pipes;
mod pool;
mod process;
mod replay;
mod supervisor;
mod wire;

pub use admit::RemoteRobot;
pub use compile::{enter as enter_compile, main as compile_main};
pub use confine::Role;
pub use explain::{enter as enter_explain, main as explain_main};
pub use matches::{enter as enter_play, main as play_main, main_with as play_main_with};
pub use process::{Executable, PATIENCE, Workers};
pub use supervisor::Supervisor;
pub use wire::Sandbox;
