//! The core of wasmouse for web pages, as a module of WebAssembly.
//!
//! A page opens a match from its maze, rules and transcript, or from a replay file, and asks what
//! to show at a step. All of it is computed by `wasmouse-core`, so a page shows what was judged.
//! Nothing here draws; that is the work of the page's script (`host/web/src`).
//!
//! # Interface
//!
//! Functions take and return numbers. Bytes go through two buffers:
//!
//! 1. `reserve(length)` makes room for input and returns its address, or 0 if it is too much.
//! 2. The page writes its bytes there and calls a function, which returns what it says below, or
//!    0 on failure.
//! 3. `output()` and `output_length()` are the address and the length in bytes of the result, or
//!    of a message in UTF-8 on failure. They are valid until the next call.
//!
//! | function | result | output |
//! |---|---|---|
//! | `open_match()` | a handle | none; the input is what [`input::read_match`] reads |
//! | `open_replay()` | a handle | none; the input is a [replay](wasmouse_core::replay) file |
//! | `about(handle)` | 1 | [`About`](about::About) as JSON |
//! | `poses(handle)` | 1 | for each position 4 bytes: run, x, y, heading |
//! | `audit(handle)` | 1 | for each position 3 numbers: new walls, optimistic, pessimistic |
//! | `frame(handle, step)` | 1 | the numbers of [`frame::frame`] |
//! | `close(handle)` | 1 | none |
//!
//! Numbers are signed, 32 bits, little endian; -1 stands for none. Handles start at 1, and are used
//! again after `close`. Input of any kind fails with a message and not with a trap; should there
//! be one, the page starts a new instance.

pub mod about;
pub mod frame;
pub mod input;
mod interface;
pub mod open;
mod session;
