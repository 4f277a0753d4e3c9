//! How output looks on this terminal: colours, Unicode or ASCII.

use std::env;
use std::io::{IsTerminal as _, stdout};

use anstream::{AutoStream, ColorChoice};

use super::tui::Look;
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

/// Programs that fill the terminal: in ASCII if asked for, or if the locale has no Unicode.
pub fn look(ascii: bool) -> Look {
    let charset = if ascii || !has_unicode() {
        Charset::Ascii
    } else {
        Charset::Unicode
    };
    Look {
        charset,
        color: wants_color(),
    }
}

/// Whether the locale has Unicode, as far as it says. Containers often set none, and their
/// terminals have it.
fn has_unicode() -> bool {
    let names = ["LC_ALL", "LC_CTYPE", "LANG"];
    let mut set = names
        .into_iter()
        .filter_map(env::var_os)
        .filter(|it| !it.is_empty());
    let Some(locale) = set.next() else {
        return true;
    };
    let locale = locale.to_string_lossy().to_ascii_lowercase();
    cfg!(windows) || locale.contains("utf-8") || locale.contains("utf8")
}

/// Whether standard output is a terminal that wants colour.
pub fn wants_color() -> bool {
    // anstream knows NO_COLOR, CLICOLOR and whether it is a terminal; in CI it
    // takes a dumb terminal for a good one.
    let is_dumb = env::var_os("TERM").is_some_and(|term| term == "dumb");
    let choice = AutoStream::choice(&stdout());
    !is_dumb && !matches!(choice, ColorChoice::Never)
}
