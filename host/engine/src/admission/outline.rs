//! [`Outline`]: what a component imports and exports, without a look at what is in it.
//!
//! It measures and validates nothing, so it decides nothing about a file.

use wasmparser::{
    BinaryReader, BinaryReaderError, ComponentExportSectionReader, ComponentImportSectionReader,
};

use super::shell::{section, sections};

/// The names of imports and exports of a component, in its order.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Outline {
    /// What it imports.
    pub imports: Vec<String>,
    /// What it exports.
    pub exports: Vec<String>,
}

impl Outline {
    /// Reads the outermost sections of a component.
    ///
    /// # Errors
    ///
    /// When an import or export cannot be read.
    pub fn of(component: &[u8]) -> Result<Self, BinaryReaderError> {
        let mut outline = Self::default();
        for (id, data) in sections(component) {
            let reader = BinaryReader::new(data, 0);
            if id == section::IMPORT {
                for import in ComponentImportSectionReader::new(reader)? {
                    outline.imports.push(import?.name.name.to_owned());
                }
            } else if id == section::EXPORT {
                for export in ComponentExportSectionReader::new(reader)? {
                    outline.exports.push(export?.name.name.to_owned());
                }
            }
        }
        Ok(outline)
    }
}
