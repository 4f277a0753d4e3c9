//! What is decided about a file before it is compiled: [`read`].
//!
//! Pure functions of the bytes and the limits, without an engine, so that the same
//! code serves the host in this process and the worker that compiles.

use std::borrow::Cow;

use super::componentize::{BinaryKind, ComponentizeError, componentize};
use super::precheck::precheck;
use super::shape::{self, Shape};
use super::{Refusal, version};
use crate::sim::Limits;

/// A file read as a component.
pub(super) struct ReadComponent<'a> {
    /// What the file was.
    pub(super) kind: BinaryKind,
    /// The component: the file's bytes, or what was made of its core module.
    pub(super) bytes: Cow<'a, [u8]>,
    /// Its imports and exports.
    pub(super) shape: Shape,
}

/// What the file is.
///
/// # Errors
///
/// The reason why it cannot be a robot.
pub(super) fn read<'a>(bytes: &'a [u8], limits: &Limits) -> Result<ReadComponent<'a>, Refusal> {
    let size = u64::try_from(bytes.len()).unwrap_or(u64::MAX);
    let max = limits.component_bytes_max;
    if size > max {
        return Err(Refusal::TooLarge { max });
    }
    let kind = shape::binary_kind(bytes)?;
    let bytes = match kind {
        BinaryKind::CoreModule => {
            precheck(bytes, limits).map_err(in_core_module)?;
            Cow::Owned(componentize(bytes)?)
        }
        BinaryKind::Component | BinaryKind::Other => Cow::Borrowed(bytes),
    };
    let shape = precheck(&bytes, limits)?;
    Ok(ReadComponent { kind, bytes, shape })
}

/// A core module that is not valid is told apart from a component that is not.
fn in_core_module(refusal: Refusal) -> Refusal {
    match refusal {
        Refusal::Invalid(message) => ComponentizeError::Malformed { message }.into(),
        other => other,
    }
}

/// Imports and exports by name, for refusals that say what to do; their types
/// are checked when linking.
///
/// # Errors
///
/// The name that a robot may not have, or has to have.
pub(super) fn check_names(shape: &Shape) -> Result<(), Refusal> {
    let names = shape.imports.iter().chain(&shape.exports);
    if let Some(version) = version::other(names.map(String::as_str)) {
        return Err(Refusal::OtherVersion(version.to_owned()));
    }
    let unknown = |name: &&String| !is_known_import(name);
    if let Some(name) = shape.imports.iter().find(unknown) {
        return Err(Refusal::UnknownImport(name.clone()));
    }
    let is_controller = |name: &String| version::is_compatible(name, "controller");
    if !shape.exports.iter().any(is_controller) {
        return Err(Refusal::NoController(shape.exports.clone()));
    }
    Ok(())
}

/// The interface `types` holds no functions, but its types are imported by every
/// component that uses them.
fn is_known_import(name: &str) -> bool {
    ["journal", "types"]
        .iter()
        .any(|interface| version::is_compatible(name, interface))
}
