//! The binary interface of a robot, from `wit/robot.wit`: a C header and a page.
//!
//! `model` reads the WIT and computes what the canonical ABI makes of it; `header` and `page`
//! write it down. A WIT with something that they do not know is an error, so that neither is ever
//! incomplete.

mod header;
mod model;
mod page;

pub use header::header;
pub use page::page;

/// The generated C header, relative to the root of the repository.
pub const HEADER: &str = "wit/wasmouse.h";

/// The generated page.
pub const PAGE: &str = "docs/ABI.md";
