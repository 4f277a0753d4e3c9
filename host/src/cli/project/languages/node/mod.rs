//! JavaScript and TypeScript: esbuild makes one file of the robot, and an engine in WebAssembly
//! runs it: QuickJS or StarlingMonkey.

mod bundle;
mod engine;
mod lines;
mod manifest;
mod project;

pub use project::{JAVASCRIPT, TYPESCRIPT};
