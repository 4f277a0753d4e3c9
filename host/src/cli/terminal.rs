//! How output looks on this terminal: colours, Unicode or ASCII.

use std::env;
use std::io::stdout;

use anstream::{AutoStream, ColorChoice};

use crate::report::picture::{Charset, TextStyle};
use crate::report::table::Lines;

/// Tables for standard output.
pub const fn table_lines(ascii: bool) -> Lines {
    if ascii { Lines::Ascii } else { Lines::Unicode }
}

/// Pictures for standard output: in colour on a terminal that has not been told
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
