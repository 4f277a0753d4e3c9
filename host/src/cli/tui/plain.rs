//! Untrusted text, made fit for the cells of a terminal: escaped as in messages, and with
//! nothing that a terminal could make wider or narrower than it is counted here.

use unicode_width::UnicodeWidthChar as _;
use wasmouse_core::guest_text::GuestStr;

use crate::report::escape::for_terminal;
use crate::report::picture::Charset;

/// The text with every character escaped that could control a terminal, and those replaced that
/// join with others: combining marks, flags and skin tones. In ASCII, everything else is `?`.
pub fn plain<'a>(text: impl Into<GuestStr<'a>>, charset: Charset) -> String {
    for_terminal(text)
        .chars()
        .map(|character| replaced(character, charset))
        .collect()
}

/// As [`plain`], and cut at a number of columns; a mark in the last ones says so. However long the
/// text is, only its beginning is looked at.
pub fn clipped<'a>(text: impl Into<GuestStr<'a>>, charset: Charset, columns: usize) -> String {
    // No character is narrower than a column.
    let (beginning, _) = text.into().cut(columns + 1);
    let text = plain(beginning, charset);
    if width(&text) <= columns {
        return text;
    }
    let mark = match charset {
        Charset::Unicode => "…",
        Charset::Ascii => "..",
    };
    let room = columns.saturating_sub(width(mark));
    let mut shown = String::new();
    let mut used = 0;
    for character in text.chars() {
        used += character.width().unwrap_or(0);
        if used > room {
            break;
        }
        shown.push(character);
    }
    shown.push_str(mark);
    shown.chars().take(columns).collect()
}

/// The columns of a text without control characters.
pub fn width(text: &str) -> usize {
    text.chars().filter_map(|it| it.width()).sum()
}

/// Whether a character takes exactly as many columns as are counted for it, whatever is beside it.
pub fn is_plain(character: char) -> bool {
    // Two of the first make a flag, and the second colours what is before them.
    let joins = matches!(character, '\u{1f1e6}'..='\u{1f1ff}' | '\u{1f3fb}'..='\u{1f3ff}');
    !joins && character.width().is_some_and(|width| width > 0)
}

fn replaced(character: char, charset: Charset) -> char {
    match (character, charset) {
        (' '..='~', _) => character,
        (_, Charset::Ascii) => '?',
        (character, Charset::Unicode) if is_plain(character) => character,
        (_, Charset::Unicode) => char::REPLACEMENT_CHARACTER,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_text_is_only_text() {
        for (text, unicode, ascii) in [
            ("flood", "flood", "flood"),
            ("\u{1b}[2J", "\\u{1b}[2J", "\\u{1b}[2J"),
            ("a\u{202e}b", "a\\u{202e}b", "a\\u{202e}b"),
            ("a\nb\r\0", "a\\nb\\r\\0", "a\\nb\\r\\0"),
            ("迷路", "迷路", "??"),
            (
                "e\u{301}\u{302}\u{303}",
                "e\u{fffd}\u{fffd}\u{fffd}",
                "e???",
            ),
            ("\u{1f1e9}\u{1f1ea}", "\u{fffd}\u{fffd}", "??"),
            ("\u{1f44d}\u{1f3fd}", "\u{1f44d}\u{fffd}", "??"),
        ] {
            assert_eq!(plain(text, Charset::Unicode), unicode, "{text:?}");
            assert_eq!(plain(text, Charset::Ascii), ascii, "{text:?}");
        }
    }

    #[test]
    fn long_and_wide_text_is_cut_at_a_column() {
        let long = "x".repeat(10_000);
        assert_eq!(clipped(&long, Charset::Unicode, 6), "xxxxx…");
        assert_eq!(clipped(&long, Charset::Ascii, 6), "xxxx..");
        assert_eq!(clipped("迷路迷路", Charset::Unicode, 6), "迷路…");
        assert_eq!(clipped("迷路迷路", Charset::Unicode, 8), "迷路迷路");
        assert_eq!(clipped("\u{1b}\u{1b}", Charset::Unicode, 8), "\\u{1b}\\…");
        assert_eq!(clipped("abc", Charset::Unicode, 0), "");
        assert_eq!(clipped("abc", Charset::Ascii, 1), ".");
        for columns in 0..12 {
            let shown = clipped("a迷\u{1b}e\u{301}\u{202e}路", Charset::Unicode, columns);
            assert!(width(&shown) <= columns, "{shown:?} in {columns} columns");
        }
    }
}
