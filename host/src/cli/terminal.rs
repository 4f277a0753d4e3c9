//! How output looks on this terminal: colours, Unicode or ASCII.

use std::env;
use std::io::{IsTerminal as _, stdout};

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
        color: stdout().is_terminal() && wants_color(),
    }
}

fn wants_color() -> bool {
    let is_set = |name| env::var_os(name).is_some_and(|value| !value.is_empty());
    let is_dumb = env::var_os("TERM").is_some_and(|term| term == "dumb");
    !is_set("NO_COLOR") && !is_dumb
}
