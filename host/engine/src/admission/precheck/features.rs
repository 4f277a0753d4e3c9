//! [`FEATURES`]: the proposals that are on.

use wasmparser::WasmFeatures;

/// The proposals that a robot may use: those that `compiler_config` leaves on.
/// What this lets through by mistake, the engine rejects when it compiles.
pub(super) const FEATURES: WasmFeatures = WasmFeatures::WASM2
    .union(WasmFeatures::TAIL_CALL)
    .union(WasmFeatures::EXTENDED_CONST)
    .union(WasmFeatures::MULTI_MEMORY)
    .union(WasmFeatures::COMPONENT_MODEL)
    .difference(WasmFeatures::GC_TYPES);
