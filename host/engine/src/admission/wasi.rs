//! [`compose`]: components that import WASI become robots that import the journal alone.
//!
//! Python, JavaScript and the standard library of Rust import WASI preview 2. Composing puts such
//! a component into a shell, beside a component of ours that answers all of it; `docs/WASI.md`
//! says what it answers. For modules that import preview 1, [`componentize`](super::componentize)
//! does the like.

use wasmouse_core::GuestText;
use wasmouse_core::guest_text::GuestStr;
use wasmparser::{BinaryReaderError, Parser, Validator, WasmFeatures};

use super::binary::BinaryKind;
use super::precheck::precheck;
use super::rejection::Rejection;
use super::shell::PREVIEW2;
use super::version::{self, JOURNAL, TYPES};
use crate::limits::Limits;

/// Why a component cannot be composed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ComposeError {
    /// The bytes are no component.
    #[error("not a component")]
    NotAComponent,
    /// It imports nothing of WASI, so there is nothing to do.
    #[error("already a component")]
    WithoutWasi,
    /// It would be rejected whatever it imports.
    #[error(transparent)]
    Rejected(#[from] Rejection),
    /// It imports something that is neither WASI nor for robots.
    #[error("the component imports `{}`, which is not available to robots", .0.escaped())]
    UnknownImport(GuestText),
    /// It imports an interface of WASI that is not answered.
    #[error("the component imports `{}`, which is not among what is answered of WASI", .0.escaped())]
    NotAnswered(GuestText),
    /// It imports an interface with other types or functions than that has.
    #[error("the component does not fit the interfaces that it imports: {}", .0.escaped())]
    Mismatch(GuestText),
}

impl ComposeError {
    /// What the author of the robot can do about it.
    pub fn hint(&self) -> GuestStr<'_> {
        let hint = match self {
            Self::NotAComponent => "core modules become robots as they are",
            Self::WithoutWasi => "use the file as it is",
            Self::Rejected(rejection) => return rejection.hint(),
            Self::UnknownImport(_) => {
                "a robot may import the interface `journal` of `wit/robot.wit`, WASI and nothing \
                 else"
            }
            Self::NotAnswered(_) => {
                "docs/WASI.md lists what is; leave out what needs more (StarlingMonkey: `-d http \
                 fetch-event`)"
            }
            Self::Mismatch(_) => {
                "build it with a released toolchain, for WASI 0.2.12 or an earlier 0.2 version"
            }
        };
        hint.into()
    }
}

/// Whether an import is that of an interface of WASI.
pub fn is_wasi(import: &str) -> bool {
    import.starts_with("wasi:")
}

/// Puts what answers WASI beside a component: the result exports the same controller, and imports
/// `types` and `journal` of `wasmouse:robot`.
///
/// A component gets the interfaces of WASI that are listed in `docs/WASI.md` in any version 0.2.x,
/// and what robots may import. It gets no others, also none of those that are between the parts.
/// The component is measured first, because types can be made so that validating them takes
/// long. The result is valid, and admission still decides about it. The same component always gives
/// the same result.
///
/// # Errors
///
/// [`ComposeError`] says which import cannot be satisfied; [`ComposeError::hint`] says what to
/// do.
pub fn compose(component: &[u8], limits: &Limits) -> Result<Vec<u8>, ComposeError> {
    if BinaryKind::of(component) != BinaryKind::Component {
        return Err(ComposeError::NotAComponent);
    }
    let shape = precheck(component, limits)?;
    if !shape.imports.iter().any(|import| is_wasi(import)) {
        return Err(ComposeError::WithoutWasi);
    }
    if let Some(found) = version::other(shape.imports.iter().chain(&shape.exports).map(|it| &**it))
    {
        return Err(Rejection::OtherVersion(found.into()).into());
    }
    let is_controller = |name: &&String| version::is_compatible(name, "controller");
    let Some(controller) = shape.exports.iter().find(is_controller) else {
        let exports = shape.exports.into_iter();
        return Err(Rejection::NoController(exports.map(GuestText::from).collect()).into());
    };
    let available = PREVIEW2.instances();
    let mut arguments = Vec::new();
    for import in &shape.imports {
        arguments.push((import.as_str(), instance_for(import, &available)?));
    }
    let composed = PREVIEW2.with_robot(component, arguments, controller);
    match fits(&composed) {
        Ok(()) => Ok(composed),
        Err(error) => Err(ComposeError::Mismatch(error.message().into())),
    }
}

/// Validates everything but the bodies of functions: those of the robot are valid, and nearly all of
/// a large component.
fn fits(component: &[u8]) -> Result<(), BinaryReaderError> {
    let mut validator = Validator::new_with_features(WasmFeatures::all());
    for payload in Parser::new(0).parse_all(component) {
        validator.payload(&payload?)?;
    }
    Ok(())
}

/// The instance that satisfies an import.
fn instance_for(import: &str, available: &[String]) -> Result<String, ComposeError> {
    for (interface, name) in [("journal", JOURNAL), ("types", TYPES)] {
        if version::is_compatible(import, interface) {
            return Ok(name.to_owned());
        }
    }
    if !is_wasi(import) {
        return Err(ComposeError::UnknownImport(import.into()));
    }
    // `ns:package/interface@0.2.x`
    let line = |name: &str| {
        let (interface, version) = name.split_once("@0.2.")?;
        let is_patch = version.parse::<u32>().is_ok();
        is_patch.then(|| interface.to_owned())
    };
    let wanted = line(import);
    let found = available
        .iter()
        .find(|name| is_wasi(name) && wanted.is_some() && line(name) == wanted);
    match found {
        Some(name) => Ok(name.clone()),
        None => Err(ComposeError::NotAnswered(import.into())),
    }
}
