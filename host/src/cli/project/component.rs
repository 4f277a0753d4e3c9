//! [`to_component`]: makes a robot of what a compiler wrote.

use std::path::Path;

use wasmouse_engine::Limits;
use wasmouse_engine::admission::{BinaryKind, componentize, examine};

use crate::cli::failure::Failure;
use crate::report::text::{Text, text};

/// Makes a component of a core module, in binary form or text.
///
/// # Errors
///
/// When the module is no robot; the failure says what `source` lacks.
pub fn to_component(module: &[u8], source: &Path) -> Result<Vec<u8>, Failure> {
    let failure = |reason: String, hint: &str| {
        Failure::robot(text!(
            "cannot build a robot from `{}`: {}",
            Text::of_path(source),
            reason
        ))
        .hint(hint)
    };
    if BinaryKind::of(module) == BinaryKind::Text {
        return match examine(module, &Limits::default()).component {
            Ok(component) => Ok(component.into_owned()),
            Err(rejection) => Err(failure(rejection.to_string(), rejection.hint())),
        };
    }
    componentize(module).map_err(|error| failure(error.to_string(), error.hint()))
}
