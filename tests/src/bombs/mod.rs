//! Small files that take a compiler much time or memory: one function for each kind.
//!
//! Core modules without the exports of a robot, and components without a controller: they must be
//! rejected for their size, before their names are checked. Sizes and measured times are in the
//! documentation of each.

mod functions;
mod modules;
mod repeated;
mod types;
mod woven;

pub use functions::*;
pub use modules::*;
pub use repeated::with_repeated_functions;
pub use types::*;
pub use woven::woven;
