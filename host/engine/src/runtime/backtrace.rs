//! [`Frame`]: where in its code a robot was when it failed.
//!
//! Only an engine made for it gathers frames ([`Runtime::for_backtraces`](super::Runtime)), so an
//! ordinary match pays nothing. Names and places come from the robot's own name section
//! and DWARF debug information: they are guest text, cut to a length here.

use serde::{Deserialize, Serialize};
use wasmouse_core::GuestText;
use wasmtime::{FrameInfo, FrameSymbol, WasmBacktrace};

use super::names::{NAME_CHARS_MAX, Origin, readable};

/// Frames that are kept, most recent call first.
pub(crate) const FRAMES_MAX: usize = 40;

/// Characters of a place that are kept.
const PLACE_CHARS_MAX: usize = NAME_CHARS_MAX;

/// How a function without a name is called; its index follows.
const UNNAMED: &str = "function ";

/// One call in progress.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Frame {
    /// The function: its name, or else its index.
    pub function: GuestText,
    /// The byte in the module's file, when known.
    pub offset: Option<u64>,
    /// The file, line and column of the source code, as `src/lib.rs:12:5`, when the robot
    /// has debug information.
    pub source: Option<GuestText>,
}

/// A part of a backtrace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FramePart<'a> {
    /// A call of a function of the robot.
    Frame(&'a Frame),
    /// Calls within a runtime or an interpreter.
    Folded {
        /// Whose.
        of: Origin,
        /// How many, at least 1.
        frames: usize,
    },
}

/// Whose code the functions are; `None` for the robot's.
fn origins(frames: &[Frame]) -> Vec<Option<Origin>> {
    let mut origins: Vec<_> = frames
        .iter()
        .map(|it| Origin::of(it.function.raw()))
        .collect();
    // An interpreter runs no code of the robot: what it calls is its own, under whatever name.
    let interpreters = origins.iter().enumerate();
    let oldest = interpreters.rev().find_map(|(at, it)| {
        let interpreter = it.filter(|it| it.is_interpreter());
        interpreter.map(|it| (at, it))
    });
    if let Some((oldest, interpreter)) = oldest {
        // And what calls it to get there, which is made from Rust or C.
        let glue = origins[oldest + 1..].iter().take_while(|it| it.is_some());
        let glue = glue.count();
        origins[..=oldest + glue].fill(Some(interpreter));
        return origins;
    }
    // Components have functions without names that pass calls on to the host.
    for at in (0..frames.len().saturating_sub(1)).rev() {
        if !frames[at].is_named() {
            origins[at] = origins[at + 1];
        }
    }
    origins
}

/// The frames of an error of a call, most recent call first; none when the engine gathers
/// none.
pub(crate) fn frames(error: &wasmtime::Error) -> Vec<Frame> {
    let Some(backtrace) = error.downcast_ref::<WasmBacktrace>() else {
        return Vec::new();
    };
    let calls = backtrace.frames().iter().flat_map(Frame::of_call);
    calls.take(FRAMES_MAX).collect()
}

impl Frame {
    /// The frames of one call of compiled code: debug information knows the functions
    /// that the compiler inlined into it, most recent call first.
    fn of_call(info: &FrameInfo) -> Vec<Self> {
        let symbols = info.symbols();
        if symbols.is_empty() {
            return vec![Self::new(info, None)];
        }
        let frames = symbols.iter().take(FRAMES_MAX);
        frames.map(|it| Self::new(info, Some(it))).collect()
    }

    fn new(info: &FrameInfo, symbol: Option<&FrameSymbol>) -> Self {
        let named = symbol.and_then(FrameSymbol::name).or(info.func_name());
        let function = match named {
            Some(name) => readable(name).into(),
            None => format!("{UNNAMED}{}", info.func_index()).into(),
        };
        Self {
            function,
            offset: info.module_offset().and_then(|at| u64::try_from(at).ok()),
            source: symbol.and_then(source).map(GuestText::from),
        }
    }

    /// The frames for a person who wrote the robot, most recent call first: those of the same
    /// runtime or interpreter that follow each other become one part. All of them one by one when
    /// nothing of the robot is left, unless an interpreter is all that there is.
    pub fn folded(frames: &[Self]) -> Vec<FramePart<'_>> {
        let origins = origins(frames);
        let is_interpreter = |it: &Option<Origin>| it.is_some_and(Origin::is_interpreter);
        if origins.iter().all(Option::is_some) && !origins.iter().any(is_interpreter) {
            return frames.iter().map(FramePart::Frame).collect();
        }
        let mut parts: Vec<FramePart<'_>> = Vec::new();
        for (frame, origin) in frames.iter().zip(origins) {
            match (origin, parts.last_mut()) {
                (None, _) => parts.push(FramePart::Frame(frame)),
                (Some(origin), Some(FramePart::Folded { of, frames })) if *of == origin => {
                    *frames += 1;
                }
                (Some(of), _) => parts.push(FramePart::Folded { of, frames: 1 }),
            }
        }
        parts
    }

    fn is_named(&self) -> bool {
        !self.function.as_guest().starts_with(UNNAMED)
    }

    /// The frame as it may have come from a worker that is not itself any more.
    pub(crate) fn checked(self) -> Self {
        Self {
            function: cut(&self.function, NAME_CHARS_MAX),
            source: self.source.map(|it| cut(&it, PLACE_CHARS_MAX)),
            ..self
        }
    }
}

fn cut(text: &GuestText, chars_max: usize) -> GuestText {
    text.as_guest().cut(chars_max).0.into()
}

/// A place in source code, when its file is known.
fn source(symbol: &FrameSymbol) -> Option<String> {
    let mut place = cut_front(symbol.file()?).to_owned();
    for number in [symbol.line(), symbol.column()] {
        match number {
            Some(number) => place.push_str(&format!(":{number}")),
            None => break,
        }
    }
    Some(place)
}

/// The last characters of a path, which say more than the first; with room for a line and
/// a column.
fn cut_front(path: &str) -> &str {
    let wanted = PLACE_CHARS_MAX - ":4294967295:4294967295".len();
    match path.char_indices().nth_back(wanted) {
        Some((last_cut, character)) => &path[last_cut + character.len_utf8()..],
        None => path,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(functions: &[&str]) -> Vec<Frame> {
        let frame = |function: &&str| Frame {
            function: (*function).into(),
            offset: None,
            source: None,
        };
        functions.iter().map(frame).collect()
    }

    #[test]
    fn frames_of_runtimes_are_folded_unless_nothing_else_is_left() {
        let shown = |functions: &[&str]| {
            let frames = frames(functions);
            let parts = Frame::folded(&frames).into_iter();
            let parts: Vec<String> = parts
                .map(|part| match part {
                    FramePart::Frame(frame) => frame.function.raw().to_owned(),
                    FramePart::Folded { of, frames } => format!("{frames} of {}", of.name()),
                })
                .collect();
            parts.join(", ")
        };
        let panicked = [
            "function 0",
            "std::panicking::panic_with_hook",
            "plan",
            "start",
        ];
        assert_eq!(shown(&panicked), "2 of the Rust runtime, plan, start");
        assert_eq!(
            shown(&["plan", "core::iter::fold", "start"]),
            "plan, 1 of the Rust runtime, start"
        );
        // Without names, nothing is known about a function.
        assert_eq!(
            shown(&["function 0", "function 7"]),
            "function 0, function 7"
        );
        assert_eq!(shown(&["function 3", "plan"]), "function 3, plan");
        assert_eq!(shown(&["core::panicking::panic"]), "core::panicking::panic");
        assert_eq!(
            shown(&[
                "function 1",
                "stat",
                "os_stat",
                "PyObject_Call",
                "wit_dylib_export_call",
                "wasmouse:robot/controller@0.2.0#next-move"
            ]),
            "5 of the Python interpreter, wasmouse:robot/controller@0.2.0#next-move"
        );
        assert_eq!(
            shown(&["PyObject_Call", "wit_dylib_x"]),
            "2 of the Python interpreter"
        );
        assert_eq!(
            shown(&[
                "runtime.fatalpanic",
                "runtime.gopanic",
                "main.plan",
                "main.next"
            ]),
            "2 of the Go runtime, main.plan, main.next"
        );
        assert_eq!(shown(&[]), "");
    }

    #[test]
    fn paths_keep_their_end() {
        assert_eq!(cut_front("src/lib.rs"), "src/lib.rs");
        let long = format!("{}/src/lib.rs", "é".repeat(PLACE_CHARS_MAX));
        let short = cut_front(&long);
        assert!(short.ends_with("é/src/lib.rs"));
        assert_eq!(short.chars().count(), PLACE_CHARS_MAX - 22);
    }
}
