//! [`ComponentizeError`]: why a core module is no robot, with what to do about it.

use thiserror::Error;

use super::super::proposal::Proposal;
use super::super::version::{COMPATIBLE, CONTROLLER, REBUILD, VERSION};

/// Why a module cannot become a robot.
#[derive(Clone, Debug, Error)]
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
    /// The module uses a proposal that is off.
    #[error(
        "core module that uses {name} at byte {byte}, a proposal that is off: {reason}",
        name = .proposal.name,
        reason = .proposal.reason,
    )]
    Proposal {
        /// Which.
        proposal: &'static Proposal,
        /// Where in the module.
        byte: u64,
    },
    /// The module exports nothing of a robot.
    #[error(
        "core module {types} that exports neither `start` nor `next_move`, also not under their \
         full names (`{CONTROLLER}#...`); it exports {exports}"
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
    /// The module uses plain names for one thing and full names for another.
    #[error("core module that mixes plain and full names: plain for {plain}, full for {full}")]
    MixedNames {
        /// What has a plain name.
        plain: String,
        /// What has a full name.
        full: String,
    },
    /// The module exports `next_move` and `next-move`.
    #[error("core module that exports both `next_move` and `next-move`")]
    TwoNextMoves,
    /// The module has the names of the component model's build targets.
    #[error(
        "core module with the names of the build target `cm32p2`, which wasmouse does not read"
    )]
    BuildTarget,
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
            Self::NotWasm { .. } => {
                "a core module in binary form begins with the bytes 00 61 73 6d 01 00 00 00"
            }
            Self::AlreadyComponent => "use the file as it is",
            Self::Malformed { .. } => "the file is damaged or cut off; build it again",
            Self::Proposal { proposal, .. } => proposal.hint,
            Self::NotARobot { .. } => {
                "in Rust, call `export_robot!` and set crate-type = [\"cdylib\"]; in other \
                 languages, export `start`, `next_move` and `memory` as docs/ABI.md says, or use a \
                 bindings generator with the world `robot` of wit/robot.wit"
            }
            Self::MixedNames { .. } => {
                "use plain names for everything (`start`, `next_move`, imports from `journal`), or \
                 full names for everything"
            }
            Self::TwoNextMoves => "export one of them",
            Self::BuildTarget => {
                "use the plain names `start`, `next_move`, `memory` and `journal`, or the default \
                 names of wit-bindgen"
            }
            Self::MissingExport { .. } => {
                "a robot exports `start`, `next_move` and its memory (as `memory`); see docs/ABI.md"
            }
            Self::ForeignImport { .. } => {
                "a robot has no files, clock, randomness or network: build for \
                 wasm32-unknown-unknown or another target without WASI, and drop what needs them"
            }
            Self::OtherVersion { .. } => REBUILD,
            Self::Mismatch { .. } => {
                "docs/ABI.md has every function with its parameters; wit/robot.wit is what bindings \
                 generators read"
            }
        }
    }
}

impl ComponentizeError {
    /// An invalid module.
    pub(super) fn malformed(error: wasmparser::BinaryReaderError) -> Self {
        let (message, byte) = (error.message(), error.offset());
        match Proposal::needed(&error) {
            Some(proposal) => Self::Proposal { proposal, byte },
            None => Self::Malformed {
                message: format!("{message} at byte {byte}"),
            },
        }
    }
}
