//! Names of functions, as people write them: [`readable`]; and whose code a function is:
//! [`Origin`].
//!
//! Both work on names of untrusted robots. A name that is made to look like one of a runtime hides
//! nothing but itself, in messages about its own robot.

use cpp_demangle::Symbol;
use wasmouse_core::GuestText;

/// Characters of a name that are kept.
pub(super) const NAME_CHARS_MAX: usize = 160;

/// Characters of a mangled name that are looked at: more than are kept, because the
/// mangled name is longer, and no name can be made out from a part of it.
const MANGLED_CHARS_MAX: usize = 2000;

/// The name without the mangling of Rust or C++, cut.
pub(crate) fn readable(name: &str) -> String {
    let name = cut(name, MANGLED_CHARS_MAX);
    let rust = rustc_demangle::try_demangle(name).map(|it| format!("{it:#}"));
    let readable = rust.unwrap_or_else(|_| {
        let is_mangled = name.starts_with("_Z");
        let symbol = Symbol::new(name).ok().filter(|_| is_mangled);
        let demangled = symbol.and_then(|it| it.demangle().ok());
        demangled.unwrap_or_else(|| name.to_owned())
    });
    cut(&readable, NAME_CHARS_MAX).to_owned()
}

/// The name, cut.
pub(crate) fn shortened(name: &GuestText) -> GuestText {
    name.as_guest().cut(NAME_CHARS_MAX).0.into()
}

/// The first characters of a text.
fn cut(text: &str, chars_max: usize) -> &str {
    match text.char_indices().nth(chars_max) {
        Some((end, _)) => &text[..end],
        None => text,
    }
}

/// What a function belongs to that is not written by the author of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The standard library of Rust, what the compiler generates, and the bindings of the SDK.
    Rust,
    /// CPython, and what componentize-py puts around it.
    Python,
    /// QuickJS, and what componentize-qjs puts around it.
    QuickJs,
    /// StarlingMonkey, which is SpiderMonkey.
    StarlingMonkey,
    /// The runtime and the standard library of Go.
    Go,
    /// The C library, the C++ runtime, and adapters that answer for WASI.
    C,
    /// The runtime safety and panics of Zig.
    Zig,
    /// The standard library of AssemblyScript.
    AssemblyScript,
}

/// First parts of paths of the Rust runtime: the standard library, what the compiler
/// generates, and the bindings in the SDK, which hold its panic hook.
const RUST_PATHS: [&str; 8] = [
    "__rustc",
    "alloc",
    "core",
    "hashbrown",
    "panic_abort",
    "rust_panic",
    "std",
    "wasmouse_sdk::bindings",
];

/// How names of the other origins begin.
const BEGINNINGS: [(Origin, &[&str]); 7] = [
    (
        Origin::Python,
        &[
            "Py",
            "_Py",
            "__Py",
            "cfunction_",
            "pyo3::",
            "<pyo3::",
            "componentize_py",
        ],
    ),
    (
        Origin::QuickJs,
        &["JS_", "__JS_", "js_", "lre_", "rquickjs", "<rquickjs"],
    ),
    (
        Origin::StarlingMonkey,
        &[
            "js::",
            "JS::",
            "mozilla::",
            "Interpret(",
            "JS_ExecuteScript",
        ],
    ),
    (
        Origin::Go,
        &[
            "runtime.",
            "internal/",
            "syscall.",
            "syscall/",
            "sync.",
            "sync/",
            "reflect.",
            "fmt.",
            "_rt0_wasm",
            "wasm_export_",
            "wasm_pc_",
            "go:",
            "gogo",
            "callRet",
            "memeqbody",
        ],
    ),
    (
        Origin::C,
        &[
            "__wasi",
            "__imported_wasi",
            "__assert",
            "__stdio",
            "__cxa_",
            "__cxx",
            "std::terminate",
            "std::__",
            "abort_message",
            "dlmalloc",
            "dlfree",
            "wasmouse:wasi/",
            "wit_dylib_",
            "tcp_create_socket_",
            "udp_create_socket_",
        ],
    ),
    (
        Origin::Zig,
        // And what the templates give it to end a match with.
        &[
            "debug.",
            "builtin.default_panic",
            "start.wasm",
            "interface.panic",
            "journal.fail",
            "journal.fatal",
        ],
    ),
    (Origin::AssemblyScript, &["~lib/"]),
];

/// Names of the C library that are whole.
const C_NAMES: [&str; 10] = [
    "abort",
    "exit",
    "exit_exit",
    "_Exit",
    "_exit",
    "raise",
    "malloc",
    "free",
    "realloc",
    "socket",
];

impl Origin {
    /// Whose function this is by its name, demangled; `None` if it may be the robot's.
    pub(super) fn of(function: &str) -> Option<Self> {
        if is_rust(function) {
            return Some(Self::Rust);
        }
        if C_NAMES.contains(&function) {
            return Some(Self::C);
        }
        let begins = |names: &[&str]| names.iter().any(|it| function.starts_with(it));
        let found = BEGINNINGS.iter().find(|(_, names)| begins(names));
        found.map(|&(origin, _)| origin)
    }

    /// Whether robots are data to this: what it calls belongs to it.
    pub(super) const fn is_interpreter(self) -> bool {
        matches!(self, Self::Python | Self::QuickJs | Self::StarlingMonkey)
    }

    /// What it is called in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rust => "the Rust runtime",
            Self::Python => "the Python interpreter",
            Self::QuickJs => "QuickJS",
            Self::StarlingMonkey => "StarlingMonkey",
            Self::Go => "the Go runtime",
            Self::C => "the C library",
            Self::Zig => "the Zig runtime",
            Self::AssemblyScript => "the AssemblyScript runtime",
        }
    }
}

/// Whether the function belongs to the Rust runtime and not to the robot.
fn is_rust(function: &str) -> bool {
    let path = function.trim_start_matches(['<', '&', '*', '[', '(']);
    // A trait's function for a type that has no path, such as `<usize as core::...>`.
    let path = match path.split_once(" as ") {
        Some((subject, implemented)) if !subject.contains("::") => implemented,
        _ => path,
    };
    // Names of C++ begin so, too.
    if path.starts_with("std::__") || path.starts_with("std::terminate") {
        return false;
    }
    let is_within = |root: &&str| {
        let rest = path.strip_prefix(*root);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
    };
    RUST_PATHS.iter().any(is_within)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_cut_between_characters() {
        assert_eq!(cut("short", 5), "short");
        let long = "é".repeat(NAME_CHARS_MAX + 5);
        assert_eq!(readable(&long).chars().count(), NAME_CHARS_MAX);
    }

    #[test]
    fn names_of_rust_and_cpp_are_demangled() {
        for (mangled, name) in [
            ("_ZN5robot4plan17h0123456789abcdefE", "robot::plan"),
            ("_ZN5Robot4planEi", "Robot::plan(int)"),
            ("_ZNSt3__115basic_stringIcE", "_ZNSt3__115basic_stringIcE"),
            ("main.plan", "main.plan"),
            ("i", "i"),
        ] {
            assert_eq!(readable(mangled), name);
        }
    }

    #[test]
    fn functions_of_the_rust_runtime_are_told_apart() {
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
            assert_eq!(Origin::of(function), Some(Origin::Rust), "{function}");
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
            "main.plan",
            "Robot::plan(int)",
            "assembly/index/plan",
        ] {
            assert_eq!(Origin::of(function), None, "{function}");
        }
    }

    #[test]
    fn other_runtimes_have_their_names() {
        for (function, origin) in [
            ("_PyEval_EvalFrameDefault", Origin::Python),
            ("JS_CallInternal", Origin::QuickJs),
            (
                "js::Interpret(JSContext*, js::RunState&)",
                Origin::StarlingMonkey,
            ),
            ("runtime.gopanic", Origin::Go),
            ("__wasilibc_populate_preopens", Origin::C),
            ("std::terminate()", Origin::C),
            ("abort", Origin::C),
            ("debug.defaultPanic", Origin::Zig),
            ("interface.panic__struct_0.report", Origin::Zig),
            ("~lib/builtins/abort", Origin::AssemblyScript),
        ] {
            assert_eq!(Origin::of(function), Some(origin), "{function}");
        }
    }
}
