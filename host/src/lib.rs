//! A referee for virtual micromouse contests of WebAssembly robots.

pub mod cli;
pub mod contest;
pub mod maze;
pub mod report;
pub mod robot;
pub mod sim;
