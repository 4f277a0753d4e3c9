//! What answers WASI inside of a robot, so that the host need not: lines of output, random
//! numbers from the seed of the match, a clock that counts, and exit.
//!
//! The library is what can be tested natively. For wasm32 it becomes one of two core modules: with
//! the feature `preview1` what the adapter for preview 1 calls, with `preview2` all of
//! preview 2. `cargo xtask wasi` makes components of them; `docs/WASI.md` says what they answer.
//!
//! There is no allocator and no formatting, to keep them small: each robot carries its own.
#![cfg_attr(target_arch = "wasm32", no_std)]

pub mod console;
pub mod excerpt;
pub mod random;
pub mod text;

#[cfg(target_arch = "wasm32")]
mod guest;
#[cfg(all(target_arch = "wasm32", feature = "preview2"))]
mod missing;
#[cfg(all(target_arch = "wasm32", feature = "preview1"))]
mod preview1;
#[cfg(all(target_arch = "wasm32", feature = "preview2"))]
mod preview2;
