//! What the end-to-end tests in `it/` and the programs `corpus` and `fuzz` share: the `wasmouse`
//! binary, small robots in text, the hostile corpus, and the targets of fuzzing.

pub mod binary;
pub mod bombs;
pub mod composite;
pub mod corpus;
pub mod module;
pub mod program;
