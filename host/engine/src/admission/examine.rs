//! [`examine`]: what is decided about a file before it is compiled.
//!
//! A pure function of the bytes and the limits, without an engine: the same code examines a
//! file in this process and in a compile worker.

use std::borrow::Cow;

use super::binary::{self, BinaryKind};
use super::componentize::{ComponentizeError, componentize};

use super::precheck::{Shape, precheck};
use super::rejection::Rejection;
use super::text::{TextError, place_of, to_binary};
use super::version;
use crate::limits::Limits;

/// What is known of a file without compiling it.
#[derive(Debug)]
pub struct Examination<'a> {
    /// What the file is; `None` when it is not WebAssembly.
    pub kind: Option<BinaryKind>,
    /// Imports, exports and measures of the component; `None` when they cannot be read, or
    /// exceed a limit.
    pub shape: Option<Shape>,
    /// The component, ready to be compiled: the file's bytes, or what was made of text or a core
    /// module. Else the reason why the file is rejected.
    pub component: Result<Cow<'a, [u8]>, Rejection>,
}

/// Examines a file for admission.
///
/// ```
/// use wasmouse_engine::Limits;
/// use wasmouse_engine::admission::{Rejection, examine};
///
/// let examination = examine(b"hello", &Limits::default());
/// assert_eq!(examination.kind, None);
/// assert!(matches!(examination.component, Err(Rejection::NotWasm(_))));
/// ```
pub fn examine<'a>(bytes: &'a [u8], limits: &Limits) -> Examination<'a> {
    let kind = match BinaryKind::of(bytes) {
        BinaryKind::Other => None,
        kind => Some(kind),
    };
    let mut shape = None;
    let component = check_size(bytes, limits).and_then(|()| {
        let component = component(bytes, limits)?;
        let read = precheck(&component, limits)?;
        let names = check_names(&read);
        shape = Some(read);
        names.map(|()| component)
    });
    Examination {
        kind,
        shape,
        component,
    }
}

/// Rejects a file by its size alone, which is all that a process may do with untrusted bytes
/// that must not even parse them.
///
/// # Errors
///
/// When the file is empty or too large.
pub(crate) fn check_size(bytes: &[u8], limits: &Limits) -> Result<(), Rejection> {
    let max = limits.admission.component_bytes_max;
    if bytes.is_empty() {
        Err(Rejection::Empty)
    } else if u64::try_from(bytes.len()).unwrap_or(u64::MAX) > max {
        Err(Rejection::TooLarge { max })
    } else {
        Ok(())
    }
}

fn component<'a>(bytes: &'a [u8], limits: &Limits) -> Result<Cow<'a, [u8]>, Rejection> {
    match BinaryKind::of(bytes) {
        BinaryKind::Other => Err(Rejection::NotWasm(binary::look_alike(bytes))),
        BinaryKind::Component => Ok(Cow::Borrowed(bytes)),
        BinaryKind::Text => Ok(Cow::Owned(of_text(bytes, limits)?)),
        BinaryKind::CoreModule => {
            precheck(bytes, limits).map_err(in_core_module)?;
            Ok(Cow::Owned(componentize(bytes)?))
        }
    }
}

fn of_text(bytes: &[u8], limits: &Limits) -> Result<Vec<u8>, Rejection> {
    let binary = to_binary(bytes, limits)?;
    // Text can be a short way to write a long file, and `(module binary ...)` any bytes.
    check_size(&binary, limits)?;
    match BinaryKind::of(&binary) {
        BinaryKind::CoreModule => {
            precheck(&binary, limits).map_err(|it| in_core_module(located(it, bytes, &binary)))?;
            Ok(componentize(&binary)?)
        }
        BinaryKind::Component => Ok(binary),
        BinaryKind::Text | BinaryKind::Other => {
            Err(Rejection::NotWasm(binary::look_alike(&binary)))
        }
    }
}

/// Says where in the text is what a rejection of its binary form, a core module, is about.
fn located(rejection: Rejection, text: &[u8], binary: &[u8]) -> Rejection {
    match rejection {
        Rejection::Invalid {
            message,
            byte: Some(byte),
        } => match place_of(text, binary, byte) {
            Some(place) => TextError::Invalid { place, message }.into(),
            None => Rejection::Invalid {
                message,
                byte: Some(byte),
            },
        },
        Rejection::Proposal { proposal, byte, .. } => Rejection::Proposal {
            proposal,
            byte,
            place: place_of(text, binary, byte),
        },
        other => other,
    }
}

/// An invalid core module has a rejection of its own.
fn in_core_module(rejection: Rejection) -> Rejection {
    match rejection {
        Rejection::Invalid {
            message,
            byte: Some(byte),
        } => {
            let message = format!("{message} at byte {byte}");
            ComponentizeError::Malformed { message }.into()
        }
        other => other,
    }
}

/// Checks imports and exports by name, so that the rejection can say what to do; their types
/// are checked when the component is linked.
fn check_names(shape: &Shape) -> Result<(), Rejection> {
    let names = shape.imports.iter().chain(&shape.exports);
    if let Some(version) = version::other(names.map(String::as_str)) {
        return Err(Rejection::OtherVersion(version.into()));
    }
    let is_known = |name: &String| {
        ["journal", "types"]
            .iter()
            .any(|interface| version::is_compatible(name, interface))
    };
    if let Some(name) = shape.imports.iter().find(|name| !is_known(name)) {
        return Err(Rejection::UnknownImport(name.as_str().into()));
    }
    let is_controller = |name: &String| version::is_compatible(name, "controller");
    if !shape.exports.iter().any(is_controller) {
        let exports = shape.exports.iter();
        return Err(Rejection::NoController(
            exports.map(|it| it.as_str().into()).collect(),
        ));
    }
    Ok(())
}
