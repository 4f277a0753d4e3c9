//! Robot projects: recognising them, compiling them with the tools of their language, and making
//! a component of what comes out.
//!
//! [`language`] says what is known about a language, and `languages` has a file for each. Tools
//! are looked for by [`tool`], which also says how to install those that are missing. For every
//! command that takes a robot, a project stands for the component that it builds.

mod check;
mod component;
mod files;
mod find;
mod language;
mod languages;
mod lines;
mod strip;
mod tool;

pub use check::{Status, check};
pub use component::to_component;
pub use find::{build, find, is_project, newer_source, sources};
pub use language::{Language, Options};
pub use languages::LANGUAGES;
#[cfg(test)]
pub use tool::Version;
