//! [`LANGUAGES`]: the languages that robots are written in.

use super::rust;
use crate::cli::project::language::Language;

/// All of them, in the order in which projects are recognised: those with an unmistakable
/// manifest first.
pub const LANGUAGES: &[&Language] = &[&rust::LANGUAGE];
