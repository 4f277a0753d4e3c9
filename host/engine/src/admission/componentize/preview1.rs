//! Modules that import `wasi_snapshot_preview1`: Go, C and C++ with libc, Rust on wasm32-wasip1.
//!
//! They get an adapter that shares their memory and answers everything inside the component, and
//! a component behind it that puts lines of output together. `docs/WASI.md` says what is answered.

use wasm_encoder::reencode::{Reencode as _, RoundtripReencoder};
use wasm_encoder::{ExportSection, ImportSection, RawSection};
use wasmparser::{BinaryReader, ExportSectionReader, ImportSectionReader};
use wit_component::{ComponentEncoder, StringEncoding, embed_component_metadata};
use wit_parser::{Resolve, WorldId};

use super::super::shell::{ADAPTER, ADAPTER_WIT, PREVIEW1, sections};
use super::super::version::{self, with_patch};
use super::encode::{mismatch, robot_package};
use super::error::ComponentizeError;

/// The module name under which preview 1 is imported.
pub(super) const MODULE: &str = "wasi_snapshot_preview1";

/// Whether the adapter has the function.
pub(super) fn answers(function: &str) -> bool {
    sections(ADAPTER)
        .filter(|(id, _)| *id == EXPORTS)
        .filter_map(|(_, data)| ExportSectionReader::new(BinaryReader::new(data, 0)).ok())
        .flat_map(|section| section.into_iter().flatten())
        .any(|export| export.name == function)
}

/// The component around a module that imports preview 1 from [`MODULE`].
pub(super) fn encode(
    untyped: Vec<u8>,
    strings: Option<StringEncoding>,
    patch: u64,
) -> Result<Vec<u8>, ComponentizeError> {
    let strings = strings.unwrap_or_default();
    // The module's controller is called by the adapter, so the world of the module has none.
    let main = with_world(untyped, MAIN_WIT, "main", patch, strings);
    let adapter = with_world(
        adapter(patch),
        ADAPTER_WIT,
        "adapter",
        patch,
        StringEncoding::UTF8,
    );
    let mut encoder = ComponentEncoder::default();
    let robot = encoder
        .validate(true)
        .module(&main)
        .and_then(|encoder| encoder.adapter(MODULE, &adapter))
        .and_then(|encoder| encoder.encode())
        .map_err(mismatch)?;
    let arguments = PREVIEW1.instances();
    let arguments = arguments
        .iter()
        .map(|name| (with_patch(name, patch), name.clone()));
    let arguments = Vec::from_iter(arguments);
    let arguments = arguments
        .iter()
        .map(|(name, of)| (name.as_str(), of.clone()));
    Ok(PREVIEW1.with_robot(&robot, arguments, &with_patch(version::CONTROLLER, patch)))
}

/// The world of the module.
const MAIN_WIT: &str = "package wasmouse:main; world main { import wasmouse:robot/journal@0.2.0; }";

/// A module with the type information of a world.
fn with_world(
    mut module: Vec<u8>,
    wit: &str,
    world: &str,
    patch: u64,
    strings: StringEncoding,
) -> Vec<u8> {
    let (resolve, world) = resolve(wit, world, patch);
    embed_component_metadata(&mut module, &resolve, world, strings, false)
        .expect("the embedded WIT encodes; a test holds it");
    module
}

fn resolve(wit: &str, world: &str, patch: u64) -> (Resolve, WorldId) {
    let (mut resolve, _) = robot_package(patch);
    let package = resolve
        .push_str("wasi.wit", &with_patch(wit, patch))
        .expect("the embedded WIT parses; a test holds it");
    let world = resolve
        .select_world(&[package], Some(world))
        .expect("the embedded WIT has the world; a test holds it");
    (resolve, world)
}

/// Numbers of sections in a core module.
const IMPORTS: u8 = 2;
const EXPORTS: u8 = 7;

/// The adapter with the names of another patch version of the interface.
fn adapter(patch: u64) -> Vec<u8> {
    let mut module = wasm_encoder::Module::new();
    for (id, data) in sections(ADAPTER) {
        let reader = BinaryReader::new(data, 0);
        match id {
            IMPORTS => {
                let section = ImportSectionReader::new(reader).expect(OURS);
                let mut renamed = ImportSection::new();
                for import in section.into_imports() {
                    let import = import.expect(OURS);
                    let ty = RoundtripReencoder.entity_type(import.ty).expect(OURS);
                    renamed.import(import.module, &with_patch(import.name, patch), ty);
                }
                module.section(&renamed);
            }
            EXPORTS => {
                let section = ExportSectionReader::new(reader).expect(OURS);
                let mut renamed = ExportSection::new();
                for export in section {
                    let export = export.expect(OURS);
                    let kind = RoundtripReencoder.export_kind(export.kind).expect(OURS);
                    renamed.export(&with_patch(export.name, patch), kind, export.index);
                }
                module.section(&renamed);
            }
            _ => {
                module.section(&RawSection { id, data });
            }
        }
    }
    module.finish()
}

/// Why the adapter can be read.
const OURS: &str = "the adapter is ours; a test holds it";
