//! [`Shape`]: what a file is and what it imports and exports, as far as that is
//! known before anything is compiled; [`precheck`](super::precheck) reads it.

use serde::{Deserialize, Serialize};
use wasmtime::{Engine, Precompiled};

use super::Refusal;
use super::componentize::BinaryKind;
use super::precheck::Measures;

/// What a component declares at its outermost level, and how large it is.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shape {
    /// Names of imports, in order.
    pub imports: Vec<String>,
    /// Names of exports, in order.
    pub exports: Vec<String>,
    /// What was measured in it.
    pub measures: Measures,
}

/// What kind of WebAssembly binary these bytes are.
///
/// # Errors
///
/// A refusal that says what the file looks like instead.
pub(super) fn binary_kind(bytes: &[u8]) -> Result<BinaryKind, Refusal> {
    if bytes.is_empty() {
        return Err(Refusal::Empty);
    }
    match BinaryKind::of(bytes) {
        BinaryKind::Other => Err(Refusal::NotWasm(look_alike(bytes))),
        kind => Ok(kind),
    }
}

/// A name for common files that are no WebAssembly binaries.
fn look_alike(bytes: &[u8]) -> &'static str {
    if Engine::detect_precompiled(bytes)
        .is_some_and(|kind| matches!(kind, Precompiled::Module | Precompiled::Component))
    {
        return "machine code precompiled by wasmtime, which is never loaded from outside";
    }
    let starts = |magic: &[u8]| bytes.starts_with(magic);
    if starts(b"\x7fELF") {
        "an ELF executable"
    } else if starts(b"MZ") {
        "a Windows executable"
    } else if starts(b"\x1f\x8b") {
        "a gzip archive"
    } else if starts(b"PK\x03\x04") {
        "a zip archive"
    } else if starts(b"\0asm") {
        "WebAssembly of an unknown version"
    } else if bytes.trim_ascii_start().starts_with(b"(") {
        "WebAssembly text (WAT), which has to be translated first"
    } else if std::str::from_utf8(bytes).is_ok() {
        "a text file"
    } else {
        "a binary file of another kind"
    }
}
