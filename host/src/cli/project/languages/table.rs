//! [`LANGUAGES`]: the languages that robots are written in.

use super::{assemblyscript, c, cpp, go, node, python, rust, wat, zig};
use crate::cli::project::language::Language;

/// All of them, in the order in which projects are recognised: those with an unmistakable
/// manifest first.
pub const LANGUAGES: &[&Language] = &[
    &rust::LANGUAGE,
    &assemblyscript::LANGUAGE,
    &zig::LANGUAGE,
    &c::LANGUAGE,
    &cpp::LANGUAGE,
    &go::LANGUAGE,
    &python::LANGUAGE,
    // Before JavaScript, whose projects have the same files but one.
    &node::TYPESCRIPT,
    &node::JAVASCRIPT,
    &wat::LANGUAGE,
];
