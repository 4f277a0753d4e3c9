//! What the end-to-end tests in `it/` and the program `corpus` share: the `wasmouse` binary,
//! small robots in text, and the hostile corpus.

pub mod binary;
pub mod bombs;
pub mod composite;
pub mod corpus;
pub mod module;
pub mod program;
