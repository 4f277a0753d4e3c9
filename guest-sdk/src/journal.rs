//! How a robot reports to people: log messages, colors, labels, beliefs about walls.
//!
//! In a match the functions call the host. In a native match of [`testing`](crate::testing)
//! they are recorded, and otherwise they do nothing. No call returns anything, so the journal
//! cannot influence a match.
//!
//! Every call costs fuel: 200, plus 1 per byte of text. Prefer fixed texts, because `format!`
//! costs more fuel than the call itself. To report an error from which the robot cannot
//! recover, panic.

pub use crate::bindings::wasmouse::robot::journal::{Belief, Color, Level};
use crate::{Cell, Heading};

#[cfg(not(target_arch = "wasm32"))]
use crate::record;

/// Writes a line of text.
#[inline]
pub fn log(level: Level, message: &str) {
    #[cfg(target_arch = "wasm32")]
    crate::bindings::wasmouse::robot::journal::log(level, message);
    #[cfg(not(target_arch = "wasm32"))]
    record::log(level, message);
}

/// Writes a line for the author of the robot.
pub fn debug(message: &str) {
    log(Level::Debug, message);
}

/// Writes a line for anyone who watches.
///
/// ```
/// use wasmouse_sdk::journal;
/// journal::info("everything explored");
/// ```
pub fn info(message: &str) {
    log(Level::Info, message);
}

/// Writes a line about something unexpected that the robot can handle.
pub fn warning(message: &str) {
    log(Level::Warning, message);
}

/// Writes a line about something that should not have happened.
pub fn error(message: &str) {
    log(Level::Error, message);
}

/// Colors a cell; [`Color::None`] removes the color.
#[inline]
pub fn paint(cell: Cell, color: Color) {
    #[cfg(target_arch = "wasm32")]
    crate::bindings::wasmouse::robot::journal::paint(cell, color);
    #[cfg(not(target_arch = "wasm32"))]
    record::paint(cell, color);
}

/// Writes a short text into a cell. At most 8 characters are shown; the empty text removes
/// the label.
#[inline]
pub fn label(cell: Cell, text: &str) {
    #[cfg(target_arch = "wasm32")]
    crate::bindings::wasmouse::robot::journal::label(cell, text);
    #[cfg(not(target_arch = "wasm32"))]
    record::label(cell, text);
}

/// States what the robot believes about the wall on one side of a cell.
#[inline]
pub fn wall(cell: Cell, side: Heading, belief: Belief) {
    #[cfg(target_arch = "wasm32")]
    crate::bindings::wasmouse::robot::journal::wall(cell, side, belief);
    #[cfg(not(target_arch = "wasm32"))]
    record::wall(cell, side, belief);
}
