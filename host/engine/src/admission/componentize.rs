//! [`componentize`]: turns a core WebAssembly module into a robot component.
//!
//! Compilers produce core modules; a match takes components. This file closes
//! the gap in process, so that neither contestants nor the host need another
//! tool. It only looks at the shape of a module: whether the component that
//! comes out may take part is decided by admission, and the size of what comes
//! in has to be limited by the caller.
//!
//! Submissions pass through here, so the types that a module says it has are
//! never decoded: `wit-parser` recurses for ever on some of them (packages that
//! need each other), which would end the host. There is one world a robot can
//! have, and every module is wrapped as that.

use std::collections::BTreeSet;

use thiserror::Error;
use wasmparser::{Parser, Payload, Validator};
use wit_component::{ComponentEncoder, StringEncoding, embed_component_metadata};
use wit_parser::{Resolve, WorldId};

use super::binary::BinaryKind;
use super::names::list_escaped;
use super::version::{self, COMPATIBLE, REBUILD, VERSION};

/// The text of the WIT package `wasmouse:robot`, the contract every robot keeps.
pub const ROBOT_WIT: &str = include_str!("../../../../wit/robot.wit");

/// The names under which a core module exports the functions of `controller`,
/// in the order of the WIT. Another compatible version may stand in them.
pub const CONTROLLER_EXPORTS: [&str; 2] = version::CONTROLLER_FUNCTIONS;

/// The module name under which a core module imports the functions of `journal`. The
/// version is that of the exports.
pub const JOURNAL_IMPORT: &str = version::JOURNAL;

/// Magic number and version, before the first section.
const HEADER_BYTES: usize = 8;

/// Bindings generators write the world of a module into custom sections with
/// this prefix.
const TYPE_SECTION_PREFIX: &str = "component-type";

/// The custom section inside those that says how the module encodes strings.
const ENCODING_SECTION: &str = "wit-component-encoding";

/// Why a module cannot become a robot.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum ComponentizeError {
    /// The bytes are no WebAssembly binary.
    #[error("not a WebAssembly binary: {found}")]
    NotWasm {
        /// What was found instead.
        found: String,
    },
    /// The bytes are a component, so there is nothing to do.
    #[error("already a component")]
    AlreadyComponent,
    /// The bytes begin like a core module and are none.
    #[error("malformed core module: {message}")]
    Malformed {
        /// What is wrong, and at which byte.
        message: String,
    },
    /// The module exports nothing of a robot.
    #[error(
        "core module {types} that exports neither `{start}` nor `{next}`; it exports {exports}",
        start = CONTROLLER_EXPORTS[0],
        next = CONTROLLER_EXPORTS[1],
    )]
    NotARobot {
        /// `with component types` or `without component types`.
        types: &'static str,
        /// The exports that the module has, for people.
        exports: String,
    },
    /// The module was built for an incompatible version of the interface.
    #[error("the robot was built for wasmouse:robot@{found}; this host runs {COMPATIBLE}")]
    OtherVersion {
        /// That version.
        found: String,
    },
    /// The module exports a part of a robot.
    #[error("core module without the export `{name}`")]
    MissingExport {
        /// The name that has to be exported.
        name: String,
    },
    /// The module imports something that a robot cannot have.
    #[error("core module imports `{name}` from `{module}`, which is not available to robots")]
    ForeignImport {
        /// The module name of the import.
        module: String,
        /// The name of the import.
        name: String,
    },
    /// The module has the names of a robot, but not its signatures.
    #[error("core module does not fit the world `wasmouse:robot/robot@{VERSION}`: {message}")]
    Mismatch {
        /// What does not fit.
        message: String,
    },
}

impl ComponentizeError {
    /// What the author of the robot can do about it.
    pub const fn hint(&self) -> &'static str {
        match self {
            Self::NotWasm { .. } => "a robot is a .wasm file; build one with `wasmouse build`",
            Self::AlreadyComponent => "use the file as it is",
            Self::Malformed { .. } => "the file is damaged or cut off; build it again",
            Self::NotARobot { .. } => {
                "in Rust, call `export_robot!` and set crate-type = [\"cdylib\"]; in other \
                 languages, export the functions under these exact names or embed the WIT world \
                 `robot` with a bindings generator"
            }
            Self::MissingExport { .. } => {
                "a robot exports `start`, `next-move` and its memory (as `memory`); see wit/robot.wit"
            }
            Self::ForeignImport { .. } => {
                "a robot has no files, clock, randomness or network: build for \
                 wasm32-unknown-unknown or another target without WASI, and drop what needs them"
            }
            Self::OtherVersion { .. } => REBUILD,
            Self::Mismatch { .. } => {
                "build the robot with bindings for this version's `wit/robot.wit`"
            }
        }
    }
}

/// Wraps a core module into a component.
///
/// The module has to export the functions of `controller` under their canonical
/// names ([`CONTROLLER_EXPORTS`]) and its memory, and may import functions of
/// `journal` ([`JOURNAL_IMPORT`]). Bindings generators do that and embed type
/// information as well (custom sections named `component-type*`); of that, only
/// the string encoding is used, so languages without a generator take part on
/// the same terms. Strings are UTF-8 where nothing is said.
///
/// The same module always gives the same component.
///
/// # Errors
///
/// [`ComponentizeError`] says what kind of file it is and what is missing;
/// [`ComponentizeError::hint`] says what to do.
///
/// ```
/// use wasmouse_engine::admission::{ComponentizeError, componentize};
///
/// let empty = b"\0asm\x01\0\0\0";
/// let error = componentize(empty).expect_err("an empty module is no robot");
/// assert!(matches!(error, ComponentizeError::NotARobot { .. }));
/// ```
pub fn componentize(core_module: &[u8]) -> Result<Vec<u8>, ComponentizeError> {
    let shape = Shape::of(core_module)?;
    let patch = shape.check_exports()?;
    shape.check_imports(patch)?;
    encode(&shape.with_robot_types(patch))
}

/// The robot world, parsed from [`ROBOT_WIT`], in the compatible version that ends in
/// `patch`: a component has the names that its module has.
fn robot_world(patch: u64) -> (Resolve, WorldId) {
    let mut resolve = Resolve::default();
    let package = resolve
        .push_str("robot.wit", ROBOT_WIT)
        .expect("the embedded WIT parses; a test holds it");
    let name = &mut resolve.packages[package].name;
    let version = name.version.as_mut();
    version
        .expect("the embedded WIT has a version; a test holds it")
        .patch = patch;
    let world = resolve
        .select_world(&[package], Some("robot"))
        .expect("the embedded WIT has the world `robot`; a test holds it");
    (resolve, world)
}

fn encode(typed_module: &[u8]) -> Result<Vec<u8>, ComponentizeError> {
    let mut encoder = ComponentEncoder::default();
    encoder
        .validate(true)
        .module(typed_module)
        .and_then(|encoder| encoder.encode())
        .map_err(|error| ComponentizeError::Mismatch {
            // `:#` joins the causes; the innermost one names the function. It
            // may quote the guest, so it must not reach a terminal raw.
            message: format!("{error:#}").replace(char::is_control, " "),
        })
}

/// What decides how a module is wrapped: its names, nothing of its code.
struct Shape {
    /// The module without its own type information.
    untyped: Vec<u8>,
    /// How the module encodes strings, where it carries type information.
    types: Option<StringEncoding>,
    exports: BTreeSet<String>,
    imports: Vec<(String, String)>,
}

impl Shape {
    fn of(bytes: &[u8]) -> Result<Self, ComponentizeError> {
        match BinaryKind::of(bytes) {
            BinaryKind::CoreModule => {}
            BinaryKind::Component => return Err(ComponentizeError::AlreadyComponent),
            BinaryKind::Other => {
                return Err(ComponentizeError::NotWasm {
                    found: describe_foreign(bytes),
                });
            }
        }
        // The encoder trusts the module's code, so a damaged one has to be
        // found here, where the message still names the byte.
        Validator::new().validate_all(bytes).map_err(malformed)?;
        let (header, _) = bytes.split_at(HEADER_BYTES);
        let mut shape = Self {
            untyped: header.to_vec(),
            types: None,
            exports: BTreeSet::new(),
            imports: Vec::new(),
        };
        // A section begins where the one before it ended: the range that the
        // parser gives leaves out the section's own header.
        let mut section_start = HEADER_BYTES;
        for payload in Parser::new(0).parse_all(bytes) {
            let payload = payload.map_err(malformed)?;
            let is_types = shape.add(&payload)?;
            if let Some((_, range)) = payload.as_section() {
                let section_end = usize::try_from(range.end).expect("an offset into a slice");
                if !is_types {
                    let section = &bytes[section_start..section_end];
                    shape.untyped.extend_from_slice(section);
                }
                section_start = section_end;
            }
        }
        Ok(shape)
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
                    let name = export.map_err(malformed)?.name;
                    self.exports.insert(name.to_owned());
                }
            }
            Payload::ImportSection(section) => {
                for import in section.clone().into_imports() {
                    let import = import.map_err(malformed)?;
                    self.imports
                        .push((import.module.to_owned(), import.name.to_owned()));
                }
            }
            _ => {}
        }
        Ok(false)
    }

    /// Are the exports there that make a module a robot? Returns the patch version of
    /// the interface that they belong to.
    fn check_exports(&self) -> Result<u64, ComponentizeError> {
        let has = |name: &str| self.exports.contains(name);
        let interfaces = self.exports.iter().filter_map(|name| {
            let (interface, _) = name.split_once('#')?;
            Some(interface)
        });
        let patch = interfaces
            .clone()
            .filter_map(|name| version::of_interface(name, Some("controller")))
            .find_map(version::patch);
        let Some(patch) = patch else {
            let imports = self.imports.iter().map(|(module, _)| module.as_str());
            if let Some(found) = version::other(interfaces.chain(imports)) {
                let found = found.to_owned();
                return Err(ComponentizeError::OtherVersion { found });
            }
            return Err(ComponentizeError::NotARobot {
                types: match self.types {
                    Some(_) => "with component types",
                    None => "without component types",
                },
                exports: list_escaped(&self.exports),
            });
        };
        // The answer of `next-move` is returned through memory.
        let [start, next_move] = CONTROLLER_EXPORTS.map(|name| with_patch(name, patch));
        match [start, next_move, "memory".to_owned()]
            .into_iter()
            .find(|name| !has(name))
        {
            None => Ok(patch),
            Some(name) => Err(ComponentizeError::MissingExport { name }),
        }
    }

    fn check_imports(&self, patch: u64) -> Result<(), ComponentizeError> {
        let journal = with_patch(JOURNAL_IMPORT, patch);
        let foreign = |(module, _): &&(String, String)| *module != journal;
        let Some((module, name)) = self.imports.iter().find(foreign) else {
            return Ok(());
        };
        if let Some(found) = version::other([module.as_str()]) {
            let found = found.to_owned();
            return Err(ComponentizeError::OtherVersion { found });
        }
        if version::is_compatible(module, "journal") {
            let message = format!("it imports `{module}`, where its exports need `{journal}`");
            return Err(ComponentizeError::Mismatch { message });
        }
        Err(ComponentizeError::ForeignImport {
            module: module.escape_debug().to_string(),
            name: name.escape_debug().to_string(),
        })
    }

    /// The module with the types of the world `robot`.
    fn with_robot_types(self, patch: u64) -> Vec<u8> {
        let (resolve, world) = robot_world(patch);
        let strings = self.types.unwrap_or_default();
        let mut bytes = self.untyped;
        embed_component_metadata(&mut bytes, &resolve, world, strings, false)
            .expect("the embedded WIT encodes; a test holds it");
        bytes
    }
}

/// A name of the interface with another patch version in it.
fn with_patch(name: &str, patch: u64) -> String {
    let version = format!("{}{patch}", COMPATIBLE.trim_end_matches('x'));
    name.replacen(VERSION, &version, 1)
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

fn malformed(error: wasmparser::BinaryReaderError) -> ComponentizeError {
    ComponentizeError::Malformed {
        message: format!("{} at byte {}", error.message(), error.offset()),
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
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(64)]).into_owned();
    let text = text.trim_start();
    if text.starts_with("(module") || text.starts_with("(component") {
        return "WebAssembly text; convert it to binary first".to_owned();
    }
    let first: Vec<String> = bytes.iter().take(4).map(|b| format!("{b:02x}")).collect();
    format!("it begins with the bytes {}", first.join(" "))
}

#[cfg(test)]
mod tests;
