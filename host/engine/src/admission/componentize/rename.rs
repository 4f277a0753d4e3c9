//! [`with_full_names`]: a module with plain names, under the names that the encoder knows.

use wasm_encoder::reencode::{Error, Reencode as _, RoundtripReencoder};
use wasm_encoder::{ExportSection, ImportSection, Section as _};
use wasmparser::{Parser, Payload};

use super::error::ComponentizeError;
use super::module::HEADER_BYTES;
use super::names::Names;

/// The module under full names. Its other sections stay as they are, to the byte, so that debug
/// information still fits.
///
/// # Errors
///
/// None, of a module that was read before.
pub(super) fn with_full_names(module: Vec<u8>, names: Names) -> Result<Vec<u8>, ComponentizeError> {
    if names != Names::Plain {
        return Ok(module);
    }
    let (header, _) = module.split_at(HEADER_BYTES);
    let mut renamed = header.to_vec();
    let mut section_start = HEADER_BYTES;
    for payload in Parser::new(0).parse_all(&module) {
        let payload = payload.map_err(ComponentizeError::malformed)?;
        let Some((_, range)) = payload.as_section() else {
            continue;
        };
        let section_end = usize::try_from(range.end).expect("an offset into a slice");
        match payload {
            Payload::ExportSection(section) => {
                let mut exports = ExportSection::new();
                for export in section {
                    let export = export.map_err(ComponentizeError::malformed)?;
                    let name = names.full_export(export.name).unwrap_or(export.name);
                    let kind = RoundtripReencoder
                        .export_kind(export.kind)
                        .map_err(malformed)?;
                    exports.export(name, kind, export.index);
                }
                exports.append_to(&mut renamed);
            }
            Payload::ImportSection(section) => {
                let mut imports = ImportSection::new();
                for import in section.into_imports() {
                    let import = import.map_err(ComponentizeError::malformed)?;
                    let module = names.full_import(import.module).unwrap_or(import.module);
                    let ty = RoundtripReencoder
                        .entity_type(import.ty)
                        .map_err(malformed)?;
                    imports.import(module, import.name, ty);
                }
                imports.append_to(&mut renamed);
            }
            _ => renamed.extend_from_slice(&module[section_start..section_end]),
        }
        section_start = section_end;
    }
    Ok(renamed)
}

fn malformed(error: Error) -> ComponentizeError {
    match error {
        Error::ParseError(error) => ComponentizeError::malformed(error),
        other => ComponentizeError::Malformed {
            message: other.to_string(),
        },
    }
}
