//! Maze files: five text formats, recognised by content, parsed and printed.
//!
//! One file per format, except that three formats are styles of one picture. Parsing is strict:
//! an error names line, column, what was expected and what was found. All formats have in
//! common:
//!
//! - Lines end in LF or CRLF; the last line ending is optional; blank lines at the end are
//!   ignored. A byte order mark at the start is skipped.
//! - Mazes are square, with 2 to 64 cells along each side.
//! - The perimeter is closed, and two neighbouring cells agree about their wall.
//! - Text longer than [`TEXT_BYTES_MAX`] is rejected unread.
//!
//! The formats do not check contest rules: see [`violations`](super::violations).

mod edges;
mod error;
mod kind;
mod num;
mod parse;
mod picture;
mod print;
mod style;
#[cfg(test)]
mod tests;
mod text;
mod udacity;

pub use error::{Edge, ParseError, PrintError};
pub use kind::{Format, TEXT_BYTES_MAX, UnknownFormat};
pub use parse::{Parsed, parse, parse_as};
pub use print::print;
