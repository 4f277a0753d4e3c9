//! Rust: cargo, and a compiler that has the target of robots.

mod package;
mod toolchain;

pub use package::LANGUAGE;
