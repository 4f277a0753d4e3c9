//! [`BinaryKind`]: what a file is, by its first bytes.

use serde::{Deserialize, Serialize};
use wasmtime::{Engine, Precompiled};

/// The mark with which some editors begin a file.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// What a sequence of bytes is, judged by how it begins.
///
/// ```
/// use wasmouse_engine::admission::BinaryKind;
///
/// assert_eq!(BinaryKind::of(b"\0asm\x01\0\0\0"), BinaryKind::CoreModule);
/// assert_eq!(BinaryKind::of(b"\0asm\x0d\0\x01\0"), BinaryKind::Component);
/// assert_eq!(BinaryKind::of(b"(module)"), BinaryKind::Text);
/// assert_eq!(BinaryKind::of(b"{}"), BinaryKind::Other);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BinaryKind {
    /// A component: what a match takes.
    Component,
    /// A core module: what [`componentize`](super::componentize) takes.
    CoreModule,
    /// WebAssembly text, of a core module or a component: what [`to_binary`](super::to_binary)
    /// takes.
    Text,
    /// Not WebAssembly, or a version of it that is not known.
    Other,
}

impl BinaryKind {
    /// Looks at the header alone; the rest may still be malformed.
    pub fn of(bytes: &[u8]) -> Self {
        match bytes.get(..8) {
            Some(b"\0asm\x01\0\0\0") => Self::CoreModule,
            Some(b"\0asm\x0d\0\x01\0") => Self::Component,
            _ if is_text(bytes) => Self::Text,
            _ => Self::Other,
        }
    }
}

/// Whether bytes are to be read as WebAssembly text: they begin, after white space, with a
/// parenthesis or a comment.
fn is_text(bytes: &[u8]) -> bool {
    let text = without_mark(bytes).trim_ascii_start();
    text.starts_with(b"(") || text.starts_with(b";;")
}

/// The bytes without a byte order mark.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes)
}

/// A name for common files that are not WebAssembly.
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
    } else if std::str::from_utf8(bytes).is_ok() {
        "a text file"
    } else {
        "a binary file of another kind"
    }
}
