//! [`Shape`]: what a file is and what it imports and exports, found by reading
//! it, without compiling anything.

use serde::{Deserialize, Serialize};
use wasmparser::{Parser, Payload};
use wasmtime::{Engine, Precompiled};

use super::Refusal;
use super::componentize::BinaryKind;

/// What a component declares at its outermost level.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shape {
    /// Names of imports, in order.
    pub imports: Vec<String>,
    /// Names of exports, in order.
    pub exports: Vec<String>,
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

impl Shape {
    /// Reads the names at the outermost level of a component.
    ///
    /// # Errors
    ///
    /// [`Refusal::Invalid`] when the file is malformed, or its types are nested too deep.
    pub(super) fn read(component: &[u8]) -> Result<Self, Refusal> {
        let invalid = |error: wasmparser::BinaryReaderError| Refusal::Invalid(error.to_string());
        let mut shape = Self::default();
        // Nested modules and components are stepped over: only the outermost
        // names count.
        let mut depth = 0_u32;
        for payload in Parser::new(0).parse_all(component) {
            match payload.map_err(invalid)? {
                Payload::ModuleSection { .. } | Payload::ComponentSection { .. } => depth += 1,
                Payload::End(_) => depth = depth.saturating_sub(1),
                Payload::ComponentImportSection(section) if depth == 0 => {
                    for import in section {
                        shape
                            .imports
                            .push(import.map_err(invalid)?.name.name.to_owned());
                    }
                }
                Payload::ComponentExportSection(section) if depth == 0 => {
                    for export in section {
                        shape
                            .exports
                            .push(export.map_err(invalid)?.name.name.to_owned());
                    }
                }
                // This parser refuses types that are nested too deep, at any depth of
                // components; that of wasmtime would overflow the stack.
                Payload::ComponentTypeSection(section) => {
                    for item in section {
                        item.map_err(invalid)?;
                    }
                }
                Payload::CoreTypeSection(section) => {
                    for item in section {
                        item.map_err(invalid)?;
                    }
                }
                _ => {}
            }
        }
        Ok(shape)
    }
}
