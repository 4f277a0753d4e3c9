//! Reports: what commands print for other programs, one file per output format.
//!
//! The last stage of the pipeline `maze -> sim -> robot -> contest -> report`.
//! Turns values into text and prints nothing itself. Wire structs live here, so
//! that the domain types can change without changing what programs read.

pub mod bundled;
pub mod inspection;
pub mod maze_check;
pub mod maze_solve;
pub mod page;
pub mod picture;
pub mod reference;
pub mod replay;
pub mod result;
pub mod table;
pub mod verification;

mod json;
mod markdown;
mod visible;

pub use visible::visible;
