//! Rust: cargo, and a compiler that has the target of a robot.

mod cargo_home;
mod package;
mod target;
mod toolchain;

pub use package::LANGUAGE;
