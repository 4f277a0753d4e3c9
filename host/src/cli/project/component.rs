//! [`to_component`]: makes a robot of what a compiler wrote.

use std::path::Path;

use wasmouse_core::guest_text::GuestStr;
use wasmouse_engine::Limits;
use wasmouse_engine::admission::wasi::{self, ComposeError};
use wasmouse_engine::admission::{BinaryKind, componentize, examine};

use crate::cli::failure::Failure;
use crate::report::text::{Text, text};

/// Makes a robot of a core module, in binary form or text, or of a component that imports WASI.
///
/// # Errors
///
/// When it is no robot; the failure says what `source` lacks.
pub fn to_component(file: &[u8], source: &Path) -> Result<Vec<u8>, Failure> {
    let failure = |reason: String, hint: GuestStr<'_>| {
        Failure::robot(text!(
            "cannot build a robot from `{}`: {}",
            Text::of_path(source),
            reason
        ))
        .hint(hint.escaped())
    };
    match BinaryKind::of(file) {
        BinaryKind::Component => match wasi::compose(file, &Limits::default()) {
            // A robot as it is, which `componentize` says.
            Err(ComposeError::WithoutWasi) => {
                componentize(file).map_err(|error| failure(error.to_string(), error.hint().into()))
            }
            composed => composed.map_err(|error| failure(error.to_string(), error.hint())),
        },
        BinaryKind::Text => match examine(file, &Limits::default()).component {
            Ok(component) => Ok(component.into_owned()),
            Err(rejection) => Err(failure(
                rejection.reason().escaped().to_string(),
                rejection.hint(),
            )),
        },
        _ => componentize(file).map_err(|error| failure(error.to_string(), error.hint().into())),
    }
}
