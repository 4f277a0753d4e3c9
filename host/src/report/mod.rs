//! Reports: values of a contest as text, one file per output format.
//!
//! The last stage before the command line: turns values into text, prints nothing and opens no
//! file. Everything about a contest is made from its [`Results`](crate::contest::Results) or
//! from parts of them. Small JSON documents have structs of their own here, so that the domain
//! types can change without changing what other programs read.

pub mod animation;
pub mod audit;
pub mod backtrace;
pub mod built;
pub mod bundled;
pub mod comparison;
pub mod config;
pub mod contest;
pub mod contest_check;
pub mod contest_status;
mod engine_hint;
pub mod escape;
pub mod explain;
pub mod faults;
pub mod grade;
pub mod inspection;
mod json;
pub mod jsonl;
pub mod match_link;
pub mod maze_check;
pub mod maze_solve;
pub(crate) mod number;
mod paired;
mod paths;
pub mod picture;
pub mod plot;
pub mod profile;
pub mod raster;
pub mod results_json;
#[cfg(test)]
mod sample;
#[cfg(test)]
mod sample_matrix;
pub mod scene;
mod standings;
pub mod study;
pub mod table;
pub mod text;
mod text_width;
pub mod verification;

pub use paths::paths;
