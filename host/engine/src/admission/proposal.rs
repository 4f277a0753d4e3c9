//! [`FEATURES`]: the proposals that are on. [`Proposal`]: those that are off, and why.
//!
//! `runtime/config.rs` turns them on and off; a test compares it with these lists.

use wasmparser::{BinaryReaderError, WasmFeatures};

/// The proposals that a robot may use: those that `compiler_config` leaves on.
/// What this lets through by mistake, the engine rejects when it compiles.
pub(super) const FEATURES: WasmFeatures = WasmFeatures::WASM2
    .union(WasmFeatures::TAIL_CALL)
    .union(WasmFeatures::EXTENDED_CONST)
    .union(WasmFeatures::MULTI_MEMORY)
    .union(WasmFeatures::COMPONENT_MODEL)
    .difference(WasmFeatures::GC_TYPES);

/// A proposal of WebAssembly or of the component model that robots cannot use.
#[derive(Debug)]
pub struct Proposal {
    /// What people call it.
    pub name: &'static str,
    /// Why it is off, as a clause.
    pub reason: &'static str,
    /// How to build without it.
    pub hint: &'static str,
    features: WasmFeatures,
    /// What the validator says where it does not name a feature.
    messages: &'static [&'static str],
}

impl Proposal {
    /// The proposal that a file uses which is not valid without it.
    pub(super) fn needed(error: &BinaryReaderError) -> Option<&'static Self> {
        let is_needed = |it: &&Self| match error.missing_wasm_feature() {
            Some(features) => it.features.intersects(features),
            // Some checks do not say which feature it is.
            None => it.messages.contains(&error.message()),
        };
        PROPOSALS.iter().find(is_needed)
    }
}

const NO_NEED: &str = "no known toolchain needs it for a robot, and each proposal is more code that a robot can attack";

/// All proposals that a validator knows and robots cannot use.
pub(super) const PROPOSALS: &[Proposal] = &[
    Proposal {
        name: "threads",
        reason: "threads run in another order each time, and a match has to be reproducible",
        hint: "build without threads and atomics (in C and C++ without `-pthread`)",
        features: WasmFeatures::THREADS
            .union(WasmFeatures::SHARED_EVERYTHING_THREADS)
            .union(WasmFeatures::ACQUIRE_RELEASE_ATOMICS)
            .union(WasmFeatures::CM_THREADING),
        messages: &[],
    },
    Proposal {
        name: "relaxed SIMD",
        reason: "its results differ between processors, and a match has to be reproducible",
        hint: "build without it (in C and C++ without `-mrelaxed-simd`); SIMD itself is on",
        features: WasmFeatures::RELAXED_SIMD,
        messages: &[],
    },
    Proposal {
        name: "exceptions",
        reason: "exceptions live on a heap of the engine that no rule limits",
        hint: "build without exceptions (in C++ `-fno-exceptions`, in Rust `panic = \"abort\"`)",
        features: WasmFeatures::EXCEPTIONS.union(WasmFeatures::LEGACY_EXCEPTIONS),
        messages: &[],
    },
    Proposal {
        name: "garbage collection",
        reason: "objects live on a heap of the engine that no rule limits",
        hint: "use a compiler that brings its own memory management in linear memory; those for \
               Kotlin, Dart and OCaml need this proposal",
        features: WasmFeatures::GC
            .union(WasmFeatures::GC_TYPES)
            .union(WasmFeatures::CUSTOM_DESCRIPTORS)
            .union(WasmFeatures::MULTIBYTE_ARRAY_ACCESS)
            .union(WasmFeatures::CM_GC),
        messages: &["gc proposal not supported"],
    },
    Proposal {
        name: "typed function references",
        reason: NO_NEED,
        hint: "call functions through a table (`call_indirect`)",
        features: WasmFeatures::FUNCTION_REFERENCES,
        messages: &[],
    },
    Proposal {
        name: "memory64",
        reason: "a robot has far less memory than 32 bits can address",
        hint: "build for a target of 32 bits, such as `wasm32-unknown-unknown`",
        features: WasmFeatures::MEMORY64.union(WasmFeatures::CM64),
        messages: &[],
    },
    Proposal {
        name: "custom page sizes",
        reason: NO_NEED,
        hint: "build without it; memory has pages of 64 KiB",
        features: WasmFeatures::CUSTOM_PAGE_SIZES,
        messages: &[],
    },
    Proposal {
        name: "wide arithmetic",
        reason: NO_NEED,
        hint: "build without it (in C and C++ without `-mwide-arithmetic`)",
        features: WasmFeatures::WIDE_ARITHMETIC,
        messages: &[],
    },
    Proposal {
        name: "stack switching",
        reason: NO_NEED,
        hint: "build without it",
        features: WasmFeatures::STACK_SWITCHING,
        messages: &["stack switching proposal not supported"],
    },
    Proposal {
        name: "memory control",
        reason: NO_NEED,
        hint: "build without it",
        features: WasmFeatures::MEMORY_CONTROL,
        messages: &[],
    },
    Proposal {
        name: "compact imports",
        reason: NO_NEED,
        hint: "build without it",
        features: WasmFeatures::COMPACT_IMPORTS,
        messages: &[],
    },
    Proposal {
        name: "component model async",
        reason: "a robot is called and returns; nothing happens meanwhile",
        hint: "build without it (`--sync` in componentize-qjs)",
        features: WasmFeatures::CM_ASYNC
            .union(WasmFeatures::CM_ASYNC_STACKFUL)
            .union(WasmFeatures::CM_MORE_ASYNC_BUILTINS)
            .union(WasmFeatures::CM_ERROR_CONTEXT)
            .union(WasmFeatures::CM_FORWARD),
        messages: &[],
    },
    Proposal {
        name: "component model maps",
        reason: NO_NEED,
        hint: "build without it",
        features: WasmFeatures::CM_MAP,
        messages: &[],
    },
    Proposal {
        name: "component model lists of fixed length",
        reason: NO_NEED,
        hint: "build without it",
        features: WasmFeatures::CM_FIXED_LENGTH_LISTS,
        messages: &[],
    },
    Proposal {
        name: "component model values",
        reason: NO_NEED,
        hint: "build without it",
        features: WasmFeatures::CM_VALUES,
        messages: &[],
    },
];
