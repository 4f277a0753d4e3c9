//! [`to_component`]: makes a robot of what a compiler wrote.

use std::path::Path;

use wasmouse_engine::Limits;
use wasmouse_engine::admission::{BinaryKind, componentize, examine, wasi};

use crate::cli::failure::Failure;
use crate::report::text::{Text, text};

/// Makes a robot of a core module, in binary form or text, or of a component that imports WASI.
///
/// # Errors
///
/// When it is no robot; the failure says what `source` lacks.
pub fn to_component(file: &[u8], source: &Path) -> Result<Vec<u8>, Failure> {
    let failure = |reason: String, hint: &str| {
        Failure::robot(text!(
            "cannot build a robot from `{}`: {}",
            Text::of_path(source),
            reason
        ))
        .hint(hint)
    };
    match BinaryKind::of(file) {
        BinaryKind::Component if imports_wasi(file) => wasi::compose(file, &Limits::default())
            .map_err(|error| failure(error.to_string(), error.hint())),
        BinaryKind::Text => match examine(file, &Limits::default()).component {
            Ok(component) => Ok(component.into_owned()),
            Err(rejection) => Err(failure(rejection.to_string(), rejection.hint())),
        },
        _ => componentize(file).map_err(|error| failure(error.to_string(), error.hint())),
    }
}

/// Whether a component needs what composing adds. One that cannot be read is composed, which says
/// what is wrong with it.
fn imports_wasi(component: &[u8]) -> bool {
    let shape = examine(component, &Limits::default()).shape;
    shape.is_none_or(|it| it.imports.iter().any(|name| wasi::is_wasi(name)))
}
