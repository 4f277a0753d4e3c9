//! How output looks on this terminal: colours, Unicode or ASCII.

use std::env;
use std::io::{IsTerminal as _, stdout};

use anstream::{AutoStream, ColorChoice};

use crate::report::picture::{Charset, TextStyle};
use crate::report::table::{Layout, Lines};

/// Tables for standard output: as wide as the terminal, if it is one.
pub fn table_layout(ascii: bool) -> Layout {
    let is_terminal = stdout().is_terminal();
    let size = is_terminal
        .then(|| crossterm::terminal::size().ok())
        .flatten();
    Layout {
        lines: if ascii { Lines::Ascii } else { Lines::Unicode },
        width: size.map(|(columns, _)| columns),
    }
}

/// Pictures for standard output: in colour on a terminal unless the environment says
/// otherwise (`NO_COLOR`, `TERM=dumb`).
pub fn picture_style(ascii: bool) -> TextStyle {
    TextStyle {
        charset: if ascii {
            Charset::Ascii
        } else {
            Charset::Unicode
        },
        color: wants_color(),
    }
}

/// Whether standard output is a terminal that wants colour.
pub fn wants_color() -> bool {
    // anstream knows NO_COLOR, CLICOLOR and whether it is a terminal; in CI it
    // takes a dumb terminal for a good one.
    let is_dumb = env::var_os("TERM").is_some_and(|term| term == "dumb");
    let choice = AutoStream::choice(&stdout());
    !is_dumb && !matches!(choice, ColorChoice::Never)
}
