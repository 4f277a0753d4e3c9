//! wasmouse runs virtual micromouse contests of WebAssembly robots.
//!
//! This crate is the program: [`contest`] plans and plays contests, [`report`] turns results
//! into text, and [`cli`] is the command line. The rules of the game are in [`wasmouse_core`],
//! everything about WebAssembly is in [`wasmouse_engine`].

pub mod cli;
pub mod contest;
pub mod report;
pub mod store;
