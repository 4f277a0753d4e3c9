//! [`Frame`]: where in its code a robot was when it failed.
//!
//! Only an engine made for it gathers frames ([`Runtime::for_backtraces`](super::Runtime)), so an
//! ordinary match pays nothing. Names and places come from the robot's own name section
//! and DWARF debug information: they are text that is untrusted, cut to a length here and
//! escaped by whoever shows them.

use serde::{Deserialize, Serialize};
use wasmtime::{FrameInfo, FrameSymbol, WasmBacktrace};

/// Frames that are kept, most recent call first.
pub(crate) const FRAMES_MAX: usize = 40;

/// Characters of a name or place that are kept.
const TEXT_CHARS_MAX: usize = 160;

/// Characters of a mangled name that are looked at: more than are kept, because the
/// mangled name is longer, and no name can be made out from a part of it.
const MANGLED_CHARS_MAX: usize = 2000;

/// How a function without a name is called; its index follows.
const UNNAMED: &str = "function ";

/// First parts of paths of the Rust runtime: the standard library, what the compiler
/// generates, and the bindings in the SDK, which hold its panic hook.
const RUNTIME_PATHS: [&str; 8] = [
    "__rustc",
    "alloc",
    "core",
    "hashbrown",
    "panic_abort",
    "rust_panic",
    "std",
    "wasmouse_sdk::bindings",
];

/// One call in progress.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Frame {
    /// The function: its name, or else its index.
    pub function: String,
    /// The byte in the module's file, when known.
    pub offset: Option<u64>,
    /// The file, line and column of the source code, as `src/lib.rs:12:5`, when the robot
    /// has debug information.
    pub source: Option<String>,
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
            Some(name) => format!(
                "{:#}",
                rustc_demangle::demangle(cut(name, MANGLED_CHARS_MAX))
            ),
            None => format!("{UNNAMED}{}", info.func_index()),
        };
        Self {
            function: cut(&function, TEXT_CHARS_MAX).to_owned(),
            offset: info.module_offset().and_then(|at| u64::try_from(at).ok()),
            source: symbol.and_then(source),
        }
    }

    /// The frames that say something about the robot, most recent call first: without those
    /// of the Rust runtime, which reports a panic. All of them when nothing else is left.
    pub fn of_robot(frames: &[Self]) -> Vec<&Self> {
        let mut of_robot = Vec::new();
        let mut called_by_runtime = false;
        for frame in frames.iter().rev() {
            // Components have functions without names that pass calls on to the host.
            let is_runtime = frame.is_runtime() || (called_by_runtime && !frame.is_named());
            if !is_runtime {
                of_robot.push(frame);
            }
            called_by_runtime = is_runtime;
        }
        if of_robot.is_empty() {
            return frames.iter().collect();
        }
        of_robot.reverse();
        of_robot
    }

    fn is_named(&self) -> bool {
        !self.function.starts_with(UNNAMED)
    }

    /// Whether the function belongs to the Rust runtime and not to the robot.
    fn is_runtime(&self) -> bool {
        let path = self.function.trim_start_matches(['<', '&', '*', '[', '(']);
        // A trait's function for a type that has no path, such as `<usize as core::...>`.
        let path = match path.split_once(" as ") {
            Some((subject, implemented)) if !subject.contains("::") => implemented,
            _ => path,
        };
        let is_within = |root: &&str| {
            let rest = path.strip_prefix(*root);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
        };
        RUNTIME_PATHS.iter().any(is_within)
    }

    /// The frame as it may have come from a worker that is not itself any more.
    pub(crate) fn checked(self) -> Self {
        Self {
            function: cut(&self.function, TEXT_CHARS_MAX).to_owned(),
            source: self.source.map(|it| cut(&it, TEXT_CHARS_MAX).to_owned()),
            ..self
        }
    }
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
    let wanted = TEXT_CHARS_MAX - ":4294967295:4294967295".len();
    match path.char_indices().nth_back(wanted) {
        Some((last_cut, character)) => &path[last_cut + character.len_utf8()..],
        None => path,
    }
}

/// The first characters of a text.
fn cut(name: &str, chars_max: usize) -> &str {
    match name.char_indices().nth(chars_max) {
        Some((end, _)) => &name[..end],
        None => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_cut_between_characters() {
        assert_eq!(cut("short", 5), "short");
        let long = "é".repeat(TEXT_CHARS_MAX + 5);
        assert_eq!(cut(&long, TEXT_CHARS_MAX).chars().count(), TEXT_CHARS_MAX);
    }

    #[test]
    fn frames_of_the_runtime_are_told_apart() {
        let is_runtime = |function: &str| {
            let function = function.to_owned();
            let (offset, source) = (None, None);
            Frame {
                function,
                offset,
                source,
            }
            .is_runtime()
        };
        for function in [
            "rust_panic",
            "__rustc::rust_begin_unwind",
            "core::panicking::panic_fmt",
            "core::option::expect_failed",
            "std::sys::backtrace::__rust_end_short_backtrace::<_, !>",
            "<usize as core::slice::index::SliceIndex<[u8]>>::index",
            "<alloc::vec::Vec<u8> as core::ops::index::Index<usize>>::index",
            "wasmouse_sdk::bindings::runtime::report_panics::{closure#0}",
        ] {
            assert!(is_runtime(function), "{function}");
        }
        for function in [
            "next_move",
            "std_robot::start",
            "core_sample::<u8>",
            "my_robot::plan",
            "<my_robot::Flood as wasmouse_sdk::robot::Robot>::start",
            "<my_robot::Grid as core::ops::index::Index<usize>>::index",
            "wasmouse_sdk::tracker::Tracker::new",
            "wasmouse:robot/controller@0.2.0#start",
            "function 7",
        ] {
            assert!(!is_runtime(function), "{function}");
        }
    }

    #[test]
    fn the_runtime_is_hidden_unless_nothing_else_is_left() {
        let shown = |functions: &[&str]| {
            let frames: Vec<Frame> = functions
                .iter()
                .map(|&function| Frame {
                    function: function.to_owned(),
                    offset: None,
                    source: None,
                })
                .collect();
            let of_robot = Frame::of_robot(&frames).into_iter();
            let names: Vec<String> = of_robot.map(|it| it.function.clone()).collect();
            names.join(" ")
        };
        let panicked = [
            "function 0",
            "std::panicking::panic_with_hook",
            "plan",
            "start",
        ];
        assert_eq!(shown(&panicked), "plan start");
        assert_eq!(shown(&["plan", "core::iter::fold", "start"]), "plan start");
        // Without names, nothing is known about a function.
        assert_eq!(
            shown(&["function 0", "function 7"]),
            "function 0 function 7"
        );
        assert_eq!(shown(&["function 3", "plan"]), "function 3 plan");
        assert_eq!(shown(&["core::panicking::panic"]), "core::panicking::panic");
        assert_eq!(shown(&[]), "");
    }

    #[test]
    fn paths_keep_their_end() {
        assert_eq!(cut_front("src/lib.rs"), "src/lib.rs");
        let long = format!("{}/src/lib.rs", "é".repeat(TEXT_CHARS_MAX));
        let short = cut_front(&long);
        assert!(short.ends_with("é/src/lib.rs"));
        assert_eq!(short.chars().count(), TEXT_CHARS_MAX - 22);
    }
}
