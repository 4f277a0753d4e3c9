//! [`Escaped`]: text from outside, for a terminal.

use std::fmt;

/// Text in which every character is escaped that [misleads]. Escaping it again changes nothing.
///
/// ```
/// use wasmouse_core::GuestText;
///
/// let text = GuestText::from("ok\u{1b}[31m\na\u{202e}b");
/// assert_eq!(text.escaped().to_string(), "ok\\u{1b}[31m\\na\\u{202e}b");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Escaped<'a>(pub(super) &'a str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if f.width().is_none() && f.precision().is_none() {
            return escape(self.0, f);
        }
        let mut escaped = String::with_capacity(self.0.len());
        escape(self.0, &mut escaped)?;
        f.pad(&escaped)
    }
}

fn escape(text: &str, to: &mut impl fmt::Write) -> fmt::Result {
    let mut rest = text;
    while let Some((at, character)) = rest.char_indices().find(|(_, it)| misleads(*it)) {
        to.write_str(&rest[..at])?;
        if character.is_control() {
            write!(to, "{}", character.escape_debug())?;
        } else {
            write!(to, "{}", character.escape_unicode())?;
        }
        rest = &rest[at + character.len_utf8()..];
    }
    to.write_str(rest)
}

/// Whether a character could control a terminal or mislead a reader: control characters, line
/// breaks, bidirectional overrides, zero-width and other invisible characters.
pub fn misleads(character: char) -> bool {
    character.is_control() || is_invisible(character)
}

/// Characters that cannot be seen and change how their neighbours look, or hide that two names
/// differ: Unicode's category Cf, its separators of lines and paragraphs, and what it calls
/// default ignorable (joiners, fillers, variation selectors, tags), assigned or not.
const fn is_invisible(character: char) -> bool {
    matches!(
        character,
        '\u{ad}'
            | '\u{34f}'
            | '\u{600}'..='\u{605}'
            | '\u{61c}'
            | '\u{6dd}'
            | '\u{70f}'
            | '\u{890}'..='\u{891}'
            | '\u{8e2}'
            | '\u{115f}'..='\u{1160}'
            | '\u{17b4}'..='\u{17b5}'
            | '\u{180b}'..='\u{180f}'
            | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{2800}'
            | '\u{3164}'
            | '\u{fe00}'..='\u{fe0f}'
            | '\u{feff}'
            | '\u{ffa0}'
            | '\u{fff0}'..='\u{fffb}'
            | '\u{110bd}'
            | '\u{110cd}'
            | '\u{13430}'..='\u{1345f}'
            | '\u{1bca0}'..='\u{1bca3}'
            | '\u{1d173}'..='\u{1d17a}'
            | '\u{e0000}'..='\u{e0fff}'
    )
}

#[cfg(test)]
mod tests {
    use crate::GuestText;

    #[test]
    fn widths_count_what_is_shown() {
        let text = GuestText::from("a\t");
        assert_eq!(
            format!("<{:<5}|{:.2}>", text.escaped(), text.escaped()),
            "<a\\t  |a\\>"
        );
    }
}
