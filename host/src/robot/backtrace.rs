//! [`Frame`]: where in its code a robot was when it failed.
//!
//! Only an engine made for it gathers frames ([`Host::explaining`](super::Host)), so an
//! ordinary match pays nothing. Names come from the robot's own name section: they are
//! text from a stranger, cut to a length here and escaped by whoever shows them.

use serde::{Deserialize, Serialize};
use wasmtime::{FrameInfo, WasmBacktrace};

/// Frames that are told, from the innermost.
pub(super) const FRAMES_MAX: usize = 20;

/// Characters of a name that are told.
const NAME_CHARS_MAX: usize = 160;

/// One call in progress.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Frame {
    /// The function: its name, or else its index.
    pub function: String,
    /// The byte in the module's file, when known.
    pub offset: Option<u64>,
}

/// The frames of an error of a call, the innermost first; none when the engine gathers
/// none.
pub(super) fn frames(error: &wasmtime::Error) -> Vec<Frame> {
    let Some(backtrace) = error.downcast_ref::<WasmBacktrace>() else {
        return Vec::new();
    };
    let frames = backtrace.frames().iter().take(FRAMES_MAX);
    frames.map(Frame::new).collect()
}

impl Frame {
    fn new(info: &FrameInfo) -> Self {
        let function = match info.func_name() {
            Some(name) => format!("{:#}", rustc_demangle::demangle(cut(name))),
            None => format!("function {}", info.func_index()),
        };
        Self {
            function: cut(&function).to_owned(),
            offset: info.module_offset().and_then(|at| u64::try_from(at).ok()),
        }
    }

    /// The frame as it may have come from a worker that is not itself any more.
    pub(super) fn checked(self) -> Self {
        Self {
            function: cut(&self.function).to_owned(),
            ..self
        }
    }
}

/// The first characters of a name.
fn cut(name: &str) -> &str {
    match name.char_indices().nth(NAME_CHARS_MAX) {
        Some((end, _)) => &name[..end],
        None => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_cut_between_characters() {
        assert_eq!(cut("short"), "short");
        let long = "é".repeat(NAME_CHARS_MAX + 5);
        assert_eq!(cut(&long).chars().count(), NAME_CHARS_MAX);
    }
}
