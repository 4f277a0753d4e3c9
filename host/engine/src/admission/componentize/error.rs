//! [`ComponentizeError`]: why a core module is no robot, with what to do about it.

use thiserror::Error;

use super::super::version::{COMPATIBLE, CONTROLLER_FUNCTIONS, REBUILD, VERSION};

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
        start = CONTROLLER_FUNCTIONS[0],
        next = CONTROLLER_FUNCTIONS[1],
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

impl ComponentizeError {
    /// An invalid module.
    pub(super) fn malformed(error: wasmparser::BinaryReaderError) -> Self {
        Self::Malformed {
            message: format!("{} at byte {}", error.message(), error.offset()),
        }
    }
}
