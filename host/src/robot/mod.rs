//! Everything about WebAssembly: from the bytes of a robot to its answers.

pub mod componentize;
