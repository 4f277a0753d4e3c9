//! [`to_component`]: makes a robot of what a compiler wrote.

use std::path::Path;

use wasmouse_engine::admission::componentize;

use crate::cli::failure::Failure;
use crate::report::text::{Text, text};

/// Makes a component of a core module.
///
/// # Errors
///
/// When the module is no robot; the failure says what `source` lacks.
pub fn to_component(binary: &[u8], source: &Path) -> Result<Vec<u8>, Failure> {
    componentize(binary).map_err(|error| {
        Failure::robot(text!(
            "cannot build a robot from `{}`: {}",
            Text::of_path(source),
            error
        ))
        .hint(error.hint())
    })
}
