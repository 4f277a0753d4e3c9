//! The robots that come with wasmouse: [`bundled`].
//!
//! They are components like any other, built from `example-robots` ahead of time
//! (`cargo xtask robots`), so that a match needs no WebAssembly toolchain and a
//! contest has a frozen baseline. They are admitted like any other.

mod find;
mod robot;
mod table;

pub use find::{bundled, find};
pub use robot::{BundledRobot, Variant};
