//! [`Names`]: whether the names of a module are those of a robot, and in which spelling.
//!
//! The full names are those of the component model, with the interface and its version in them;
//! bindings generators write them. The plain names are for people: `start`, `next_move` and
//! imports from `journal`. They mean the version of this host.

use super::super::names::list_escaped;
use super::super::version::{self, VERSION, with_patch};
use super::error::ComponentizeError;
use super::module::Module;
use super::preview1;

/// The full names under which a core module exports the functions of `controller`,
/// in the order of the WIT. Another compatible version may stand in them.
pub const CONTROLLER_EXPORTS: [&str; 2] = version::CONTROLLER_FUNCTIONS;

/// The full name of the module from which a core module imports the functions of `journal`. The
/// version is that of the exports.
pub const JOURNAL_IMPORT: &str = version::JOURNAL;

/// The plain names of the functions of `controller`, in the order of the WIT.
pub const PLAIN_EXPORTS: [&str; 2] = ["start", "next_move"];

/// The plain name of the module from which the functions of `journal` are imported.
pub const PLAIN_JOURNAL: &str = "journal";

/// `next_move` as the WIT writes it.
const NEXT_MOVE_OF_WIT: &str = "next-move";

/// The names of the component model's build targets begin so.
const BUILD_TARGET: &str = "cm32p2";

/// How a module spells the names of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Names {
    /// Full, in the compatible version that ends in this number.
    Full {
        /// The last number of the version.
        patch: u64,
    },
    /// Plain.
    Plain,
}

impl Names {
    /// Checks the exports and imports by name.
    ///
    /// # Errors
    ///
    /// What is missing or foreign.
    pub(super) fn of(module: &Module) -> Result<Self, ComponentizeError> {
        let names = check_exports(module)?;
        names.check_imports(module)?;
        Ok(names)
    }

    /// The patch version of the interface that the names belong to.
    pub(super) fn patch(self) -> u64 {
        match self {
            Self::Full { patch } => patch,
            Self::Plain => version::patch(VERSION).expect("the version of the host is one"),
        }
    }

    /// The full name of an export, where it is that of a robot in its plain spelling.
    pub(super) fn full_export(self, name: &str) -> Option<&'static str> {
        let [start, next_move] = CONTROLLER_EXPORTS;
        match (self, name) {
            (Self::Plain, "start") => Some(start),
            (Self::Plain, "next_move" | NEXT_MOVE_OF_WIT) => Some(next_move),
            _ => None,
        }
    }

    /// The full name of the module of an import, where it is `journal`.
    pub(super) fn full_import(self, module: &str) -> Option<&'static str> {
        (self == Self::Plain && module == PLAIN_JOURNAL).then_some(JOURNAL_IMPORT)
    }

    fn check_imports(self, module: &Module) -> Result<(), ComponentizeError> {
        let journal = match self {
            Self::Full { patch } => with_patch(JOURNAL_IMPORT, patch),
            Self::Plain => PLAIN_JOURNAL.to_owned(),
        };
        let foreign = |(module, name): &&(String, String)| {
            *module != journal && !(module == preview1::MODULE && preview1::answers(name))
        };
        let Some((from, name)) = module.imports.iter().find(foreign) else {
            return Ok(());
        };
        if let Some(found) = version::other([from.as_str()]) {
            let found = found.to_owned();
            return Err(ComponentizeError::OtherVersion { found });
        }
        let is_full = version::is_compatible(from, "journal");
        match self {
            Self::Full { .. } if from == PLAIN_JOURNAL => Err(ComponentizeError::MixedNames {
                plain: format!("imports from `{PLAIN_JOURNAL}`"),
                full: "its exports".into(),
            }),
            Self::Plain if is_full => Err(ComponentizeError::MixedNames {
                plain: "its exports".into(),
                full: format!("imports from `{from}`"),
            }),
            Self::Full { .. } if is_full => {
                let message = format!("it imports `{from}`, where its exports need `{journal}`");
                Err(ComponentizeError::Mismatch { message })
            }
            _ => Err(ComponentizeError::ForeignImport {
                module: from.escape_debug().to_string(),
                name: name.escape_debug().to_string(),
            }),
        }
    }
}

/// Are the exports there that make a module a robot?
fn check_exports(module: &Module) -> Result<Names, ComponentizeError> {
    let has = |name: &str| module.exports.contains(name);
    let interfaces = module.exports.iter().filter_map(|name| {
        let (interface, _) = name.split_once('#')?;
        Some(interface)
    });
    let patch = interfaces
        .clone()
        .filter_map(|name| version::of_interface(name, Some("controller")))
        .find_map(version::patch);
    // The result of `next-move` is returned through memory.
    let missing = |name: &str| {
        let name = name.to_owned();
        Err(ComponentizeError::MissingExport { name })
    };
    let plain_next_moves = ["next_move", NEXT_MOVE_OF_WIT];
    let plain = [&["start"][..], &plain_next_moves];
    if let Some(patch) = patch {
        // Further exports under plain names mean nothing: linkers export more than they are told.
        for (full, plain) in CONTROLLER_EXPORTS.iter().zip(plain) {
            let full = with_patch(full, patch);
            match plain.iter().find(|name| has(name)) {
                _ if has(&full) => {}
                Some(name) => {
                    return Err(ComponentizeError::MixedNames {
                        plain: format!("export `{name}`"),
                        full: "others".into(),
                    });
                }
                None => return missing(&full),
            }
        }
        return if has("memory") {
            Ok(Names::Full { patch })
        } else {
            missing("memory")
        };
    }
    let imports = module.imports.iter().map(|(module, _)| module.as_str());
    if let Some(found) = version::other(interfaces.chain(imports.clone())) {
        let found = found.to_owned();
        return Err(ComponentizeError::OtherVersion { found });
    }
    match plain_next_moves.map(has) {
        [true, true] => return Err(ComponentizeError::TwoNextMoves),
        [false, false] if has("start") => return missing("next_move"),
        [false, false] => {}
        _ if !has("start") => return missing("start"),
        _ if !has("memory") => return missing("memory"),
        _ => return Ok(Names::Plain),
    }
    let exports = module.exports.iter().map(String::as_str);
    if exports
        .chain(imports)
        .any(|it| it.starts_with(BUILD_TARGET))
    {
        return Err(ComponentizeError::BuildTarget);
    }
    Err(ComponentizeError::NotARobot {
        types: match module.types {
            Some(_) => "with component types",
            None => "without component types",
        },
        exports: list_escaped(&module.exports),
    })
}
