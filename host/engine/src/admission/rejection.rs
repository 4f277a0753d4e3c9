//! [`Rejection`]: why a file is not admitted as a robot, with what to do about it.

use std::fmt;

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::{GuestText, guest_text};

use super::componentize::ComponentizeError;
use super::names::list;
use super::place::Place;
use super::proposal::Proposal;
use super::text::{TextError, TextPlace};
use super::version::{COMPATIBLE, CONTROLLER, REBUILD};

/// How the reason ends why a file cannot be compiled that takes too much processor time.
pub(crate) const OUT_OF_PROCESSOR_TIME: &str = "s of processor time";

/// Why a file was not admitted. Says nothing about how the robot would play.
///
/// It may quote the file. Displayed, it is escaped for a terminal; for anything else there is
/// [`Rejection::reason`].
#[derive(Debug)]
pub enum Rejection {
    /// The file has no bytes.
    Empty,
    /// The file is larger than the limits allow.
    TooLarge {
        /// The limit in bytes.
        max: u64,
    },
    /// The file is something else than WebAssembly.
    NotWasm(&'static str),
    /// A core module that cannot be turned into a component.
    CoreModule(ComponentizeError),
    /// A text that cannot be turned into binary form.
    Text(TextError),
    /// The file is malformed.
    Invalid {
        /// What is wrong.
        message: String,
        /// Where in the file, or in its binary form; `None` when only the engine knows.
        byte: Option<u64>,
    },
    /// The file uses a proposal that is off.
    Proposal {
        /// Which.
        proposal: &'static Proposal,
        /// Where in the file, or in its binary form.
        byte: u64,
        /// Where in the text of the file, where that is known.
        place: Option<TextPlace>,
    },
    /// The robot was built for an incompatible version of the interface.
    OtherVersion(GuestText),
    /// The component imports something that is not available to robots.
    UnknownImport(GuestText),
    /// The component does not export the controller.
    NoController(Vec<GuestText>),
    /// An import or export has a type that differs from the WIT.
    WrongType(GuestText),
    /// Its compilation took too much, or ended the process that compiled it.
    Uncompilable(GuestText),
    /// What a worker process reported.
    Reported {
        /// As [`Rejection::name`] there.
        name: GuestText,
        /// As [`Rejection::reason`] there.
        reason: GuestText,
        /// As [`Rejection::hint`] there.
        hint: GuestText,
    },
    /// The file exceeds a limit, before anything of it runs.
    OverLimit {
        /// What is counted, as the words after a number.
        what: &'static str,
        /// The value found up to that place; the whole file may have more.
        found: u64,
        /// The limit.
        max: u64,
        /// Where.
        at: Place,
    },
}

impl From<ComponentizeError> for Rejection {
    fn from(error: ComponentizeError) -> Self {
        Self::CoreModule(error)
    }
}

impl From<TextError> for Rejection {
    fn from(error: TextError) -> Self {
        Self::Text(error)
    }
}

/// The reason, escaped for a terminal.
impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.reason().escaped(), f)
    }
}

impl std::error::Error for Rejection {}

/// A rejection in words, as it is: to make a [`GuestText`] of.
struct Words<'a>(&'a Rejection);

impl fmt::Display for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Rejection::Empty => write!(f, "the file is empty"),
            Rejection::TooLarge { max } => write!(f, "the file has more than {max} bytes"),
            Rejection::NotWasm(what) => {
                write!(f, "the file is not WebAssembly: it looks like {what}")
            }
            Rejection::CoreModule(error) => write!(f, "{error}"),
            Rejection::Text(error) => write!(f, "{error}"),
            Rejection::Invalid { message, byte } => {
                let at = byte.map_or(String::new(), at_byte);
                write!(f, "the component is not valid: {message}{at}")
            }
            Rejection::Proposal {
                proposal,
                byte,
                place,
            } => {
                let (name, reason) = (proposal.name, proposal.reason);
                let at = place
                    .as_ref()
                    .map_or_else(|| at_byte(*byte), |place| format!(" in {place}"));
                write!(
                    f,
                    "the file uses {name}{at}, a proposal that is off: {reason}"
                )
            }
            Rejection::OtherVersion(version) => write!(
                f,
                "the robot was built for wasmouse:robot@{}; this host runs {COMPATIBLE}",
                version.raw()
            ),
            Rejection::UnknownImport(name) => write!(
                f,
                "the component imports `{}`, which is not available to robots",
                name.raw()
            ),
            Rejection::NoController(exports) => write!(
                f,
                "the component does not export `{CONTROLLER}`; it exports {}",
                list(exports.iter().map(GuestText::raw))
            ),
            Rejection::WrongType(what) => {
                let what = what.raw();
                write!(f, "the component does not fit the world `robot`: {what}")
            }
            Rejection::Uncompilable(reason) => {
                write!(f, "compiling the component {}", reason.raw())
            }
            Rejection::Reported { reason, .. } => f.write_str(reason.raw()),
            Rejection::OverLimit {
                what,
                found,
                max,
                at,
            } => write!(
                f,
                "the file has {found} {what}, and the limit is {max} ({at})"
            ),
        }
    }
}

impl Rejection {
    /// Why, as a sentence without its full stop. It may quote the file.
    pub fn reason(&self) -> GuestText {
        guest_text!("{}", Words(self))
    }

    /// A short name as in JSON: lowercase letters and hyphens, unless a worker that was taken over
    /// reported something else.
    pub fn name(&self) -> GuestStr<'_> {
        let name = match self {
            Self::Empty => "empty",
            Self::TooLarge { .. } => "too-large",
            Self::NotWasm(_) => "not-wasm",
            Self::CoreModule(ComponentizeError::OtherVersion { .. }) | Self::OtherVersion(_) => {
                "other-version"
            }
            Self::CoreModule(_) => "core-module",
            Self::Text(TextError::TooLarge { .. }) => "too-large",
            Self::Text(_) => "text",
            Self::Invalid { .. } => "invalid",
            Self::Proposal { .. } => "proposal",
            Self::UnknownImport(_) => "unknown-import",
            Self::NoController(_) => "no-controller",
            Self::WrongType(_) => "wrong-type",
            Self::OverLimit { .. } => "over-limit",
            Self::Uncompilable(_) => "uncompilable",
            Self::Reported { name, .. } => return name.as_guest(),
        };
        name.into()
    }

    /// Whether the same host would reject the same file again. All but one kind depend on the
    /// file and the limits alone; a compiler that crashed or ran out of memory may have been on a
    /// machine that was short of it.
    pub(crate) fn is_repeatable(&self) -> bool {
        match self {
            Self::Uncompilable(reason) => reason.raw().ends_with(OUT_OF_PROCESSOR_TIME),
            _ => true,
        }
    }

    /// What the author can do.
    pub fn hint(&self) -> GuestStr<'_> {
        let hint = match self {
            Self::Empty | Self::NotWasm(_) => {
                "a robot is a WebAssembly component or core module (.wasm), or WebAssembly text \
                 (.wat); `wasmouse build` makes one of a robot project"
            }
            Self::TooLarge { .. } => {
                "build in release mode, without debug information (`strip = \"debuginfo\"`)"
            }
            Self::CoreModule(ComponentizeError::OtherVersion { .. }) | Self::OtherVersion(_) => {
                REBUILD
            }
            Self::CoreModule(error) => error.hint(),
            Self::Text(error) => error.hint(),
            Self::Proposal { proposal, .. } => proposal.hint,
            Self::Invalid { .. } => {
                "rebuild it with a released toolchain and without experimental proposals"
            }
            Self::UnknownImport(name) if name.as_guest().starts_with("wasi:") => {
                "robots have no clock, files, randomness or network; `wasmouse build FILE.wasm` makes \
                 a robot of a component with WASI: it answers WASI inside (docs/WASI.md)"
            }
            Self::UnknownImport(_) => {
                "a robot may import the interface `journal` of `wit/robot.wit` and nothing else"
            }
            Self::NoController(_) => {
                "export the interface `controller` of `wit/robot.wit`; in Rust, call \
                 `export_robot!` in the crate's root"
            }
            Self::WrongType(_) => "rebuild it against this version's `wit/robot.wit`",
            Self::Uncompilable(_) => {
                "build it in release mode, as smaller functions with fewer local variables"
            }
            Self::Reported { hint, .. } => return hint.as_guest(),
            Self::OverLimit { .. } => {
                "`wasmouse inspect` shows every measure of a robot beside its limit; generated code \
                 and unrolled tables are better written as loops over data"
            }
        };
        hint.into()
    }
}

fn at_byte(byte: u64) -> String {
    format!(" at byte {byte}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_of_names_end() {
        let names = (1..=20).map(|number| format!("e{number}").into()).collect();
        let message = Rejection::NoController(names).reason();
        assert!(
            message
                .raw()
                .ends_with("it exports `e1`, `e2`, `e3`, `e4`, `e5`, `e6`, `e7`, `e8`, 12 more")
        );
        let message = Rejection::NoController(Vec::new()).reason();
        assert!(message.raw().ends_with("it exports nothing"), "{message:?}");
    }
}
