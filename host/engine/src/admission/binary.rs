//! [`BinaryKind`]: what a file is, by its first bytes.

use serde::{Deserialize, Serialize};
use wasmtime::{Engine, Precompiled};

/// What a sequence of bytes is, judged by its first 8 bytes.
///
/// ```
/// use wasmouse_engine::admission::BinaryKind;
///
/// assert_eq!(BinaryKind::of(b"\0asm\x01\0\0\0"), BinaryKind::CoreModule);
/// assert_eq!(BinaryKind::of(b"\0asm\x0d\0\x01\0"), BinaryKind::Component);
/// assert_eq!(BinaryKind::of(b"(module)"), BinaryKind::Other);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BinaryKind {
    /// A component: what a match takes.
    Component,
    /// A core module: what [`componentize`](super::componentize) takes.
    CoreModule,
    /// Not WebAssembly in binary form, or a version of it that is not known.
    Other,
}

impl BinaryKind {
    /// Looks at the header alone; the rest may still be malformed.
    pub fn of(bytes: &[u8]) -> Self {
        match bytes.get(..8) {
            Some(b"\0asm\x01\0\0\0") => Self::CoreModule,
            Some(b"\0asm\x0d\0\x01\0") => Self::Component,
            _ => Self::Other,
        }
    }
}

/// A name for common files that are no WebAssembly binaries.
pub(super) fn look_alike(bytes: &[u8]) -> &'static str {
    if Engine::detect_precompiled(bytes)
        .is_some_and(|kind| matches!(kind, Precompiled::Module | Precompiled::Component))
    {
        return "machine code precompiled by wasmtime, which is never accepted";
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
        "WebAssembly text (WAT), which must be converted to binary first"
    } else if std::str::from_utf8(bytes).is_ok() {
        "a text file"
    } else {
        "a binary file of another kind"
    }
}
