//! [`Module`]: a core module as far as its conversion looks at it.

use std::collections::BTreeSet;

use wasmparser::{Parser, Payload, Validator};
use wit_component::StringEncoding;

use super::super::binary::BinaryKind;
use super::super::proposal::FEATURES;
use super::error::ComponentizeError;

/// Magic number and version, before the first section.
pub(super) const HEADER_BYTES: usize = 8;

/// Bindings generators write the world of a module into custom sections with
/// this prefix.
const TYPE_SECTION_PREFIX: &str = "component-type";

/// The custom section inside those that says how the module encodes strings.
const ENCODING_SECTION: &str = "wit-component-encoding";

/// What decides how a module is wrapped: its names, nothing of its code.
pub(super) struct Module {
    /// The module without its own type information.
    pub(super) untyped: Vec<u8>,
    /// How the module encodes strings, where it carries type information.
    pub(super) types: Option<StringEncoding>,
    pub(super) exports: BTreeSet<String>,
    pub(super) imports: Vec<(String, String)>,
}

impl Module {
    /// Reads and validates a module.
    pub(super) fn of(bytes: &[u8]) -> Result<Self, ComponentizeError> {
        match BinaryKind::of(bytes) {
            BinaryKind::CoreModule => {}
            BinaryKind::Component => return Err(ComponentizeError::AlreadyComponent),
            BinaryKind::Text | BinaryKind::Other => {
                return Err(ComponentizeError::NotWasm {
                    found: describe_foreign(bytes),
                });
            }
        }
        // The encoder trusts the module's code, so a damaged one has to be
        // found here, where the message still names the byte.
        Validator::new_with_features(FEATURES)
            .validate_all(bytes)
            .map_err(ComponentizeError::malformed)?;
        let (header, _) = bytes.split_at(HEADER_BYTES);
        let mut module = Self {
            untyped: header.to_vec(),
            types: None,
            exports: BTreeSet::new(),
            imports: Vec::new(),
        };
        // A section begins where the one before it ended: the range that the
        // parser gives leaves out the section's own header.
        let mut section_start = HEADER_BYTES;
        for payload in Parser::new(0).parse_all(bytes) {
            let payload = payload.map_err(ComponentizeError::malformed)?;
            let is_types = module.add(&payload)?;
            if let Some((_, range)) = payload.as_section() {
                let section_end = usize::try_from(range.end).expect("an offset into a slice");
                if !is_types {
                    let section = &bytes[section_start..section_end];
                    module.untyped.extend_from_slice(section);
                }
                section_start = section_end;
            }
        }
        Ok(module)
    }

    /// Whether it imports anything under that module name.
    pub(super) fn imports_from(&self, module: &str) -> bool {
        self.imports.iter().any(|(from, _)| from == module)
    }

    /// Takes in one section and says whether it is type information.
    fn add(&mut self, payload: &Payload<'_>) -> Result<bool, ComponentizeError> {
        match payload {
            Payload::CustomSection(section) if section.name().starts_with(TYPE_SECTION_PREFIX) => {
                self.types = Some(string_encoding(section.data()));
                return Ok(true);
            }
            Payload::ExportSection(section) => {
                for export in section.clone() {
                    let name = export.map_err(ComponentizeError::malformed)?.name;
                    self.exports.insert(name.to_owned());
                }
            }
            Payload::ImportSection(section) => {
                for import in section.clone().into_imports() {
                    let import = import.map_err(ComponentizeError::malformed)?;
                    self.imports
                        .push((import.module.to_owned(), import.name.to_owned()));
                }
            }
            _ => {}
        }
        Ok(false)
    }
}

/// How a module encodes strings, by its type information: a component that has
/// a custom section of two bytes, a version and the encoding.
fn string_encoding(types: &[u8]) -> StringEncoding {
    let encoding = Parser::new(0)
        .parse_all(types)
        .map_while(Result::ok)
        .find_map(|payload| match payload {
            Payload::CustomSection(section) if section.name() == ENCODING_SECTION => {
                section.data().get(1).copied()
            }
            _ => None,
        });
    match encoding {
        Some(1) => StringEncoding::UTF16,
        Some(2) => StringEncoding::CompactUTF16,
        _ => StringEncoding::UTF8,
    }
}

/// Names the usual wrong files; anything else is shown by its first bytes.
fn describe_foreign(bytes: &[u8]) -> String {
    if bytes.is_empty() {
        return "the file is empty".to_owned();
    }
    if bytes.starts_with(b"\0asm") {
        return "a WebAssembly header with an unknown version".to_owned();
    }
    if BinaryKind::of(bytes) == BinaryKind::Text {
        return "WebAssembly text; convert it to binary first".to_owned();
    }
    let first: Vec<String> = bytes.iter().take(4).map(|b| format!("{b:02x}")).collect();
    format!("it begins with the bytes {}", first.join(" "))
}
