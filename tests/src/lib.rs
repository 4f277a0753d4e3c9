//! What the end-to-end tests in `it/` and the programs `corpus` and `fuzz` share: the `wasmouse`
//! binary, small robots in text, the hostile corpus, the targets of fuzzing, and the generator of
//! the SDK's bindings.

pub mod binary;
pub mod bindings;
pub mod bombs;
pub mod composite;
pub mod corpus;
pub mod module;
pub mod program;
pub mod wasm_target;
