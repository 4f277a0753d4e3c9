//! What the end-to-end tests in `it/` and the program `corpus` share: the `wasmouse` binary,
//! small robots in text, the hostile corpus, contests for stores, and the generator of the SDK's bindings.

pub mod abi;
pub mod binary;
pub mod bindings;
pub mod bombs;
pub mod composite;
pub mod corpus;
pub mod fuzz;
pub mod module;
pub mod program;
pub mod rust_wasi;
pub mod slow;
pub mod stored;
pub mod wasi;
pub mod wasm_target;

/// Held by tests that take much memory: what one of them measures is that of the whole process.
#[cfg(test)]
static MUCH_MEMORY: std::sync::Mutex<()> = std::sync::Mutex::new(());
