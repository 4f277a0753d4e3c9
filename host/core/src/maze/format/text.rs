//! Lines, words and quotes: what all formats share before their own grammar.

use super::error::ParseError;
use super::kind::TEXT_BYTES_MAX;

/// The most digits of a number that a message quotes.
const DIGITS_MAX: usize = 9;

/// One line of a maze file, without its line ending.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    number: usize,
    text: &'a str,
}

impl<'a> Line<'a> {
    /// The text of the line.
    pub(super) const fn text(&self) -> &'a str {
        self.text
    }

    /// The number of the line, counted from 1.
    pub(super) const fn number(&self) -> usize {
        self.number
    }

    /// The error that `found` is where `expected` should be, after `before` characters of
    /// the line.
    pub(super) fn unexpected(
        &self,
        before: usize,
        expected: impl Into<String>,
        found: String,
    ) -> ParseError {
        ParseError::Unexpected {
            line: self.number,
            column: before + 1,
            expected: expected.into(),
            found,
        }
    }
}

/// The lines of a file, at least one, without blank lines at the end.
pub(super) fn lines(text: &str) -> Result<Vec<Line<'_>>, ParseError> {
    if text.len() > TEXT_BYTES_MAX {
        return Err(ParseError::TooLong { bytes: text.len() });
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines: Vec<Line<'_>> = text
        .split('\n')
        .zip(1..)
        .map(|(text, number)| Line {
            number,
            text: text.strip_suffix('\r').unwrap_or(text),
        })
        .collect();
    while lines.pop_if(|line| line.text.trim().is_empty()).is_some() {}
    if lines.is_empty() {
        return Err(ParseError::Empty);
    }
    Ok(lines)
}

/// A word of a line and the number of characters before it.
pub(super) struct Word<'a> {
    /// Characters of the line before the word.
    pub(super) before: usize,
    /// The word.
    pub(super) text: &'a str,
}

/// The parts of a line between separators, without the blanks around them.
pub(super) fn words<'a, const N: usize>(
    line: &Line<'a>,
    separators: [char; N],
) -> impl Iterator<Item = Word<'a>> {
    let mut before = 0;
    line.text().split(separators).map(move |part| {
        let text = part.trim_start_matches([' ', '\t']);
        let blanks = part.len() - text.len();
        let word = Word {
            before: before + blanks,
            text: text.trim_end_matches([' ', '\t']),
        };
        before += part.chars().count() + 1;
        word
    })
}

impl Word<'_> {
    /// The word as a number of at most `max`; `None` if it is not one.
    pub(super) fn number(&self, max: u8) -> Option<u8> {
        let digits = !self.text.is_empty() && self.text.bytes().all(|b| b.is_ascii_digit());
        let number: u8 = digits.then(|| self.text.parse().ok())??;
        (number <= max).then_some(number)
    }

    /// The word as messages quote it.
    pub(super) fn quoted(&self) -> String {
        quoted(self.text)
    }
}

/// A piece of the file as messages quote it: a short number, or the first character of anything
/// else. The file may be no maze at all but a link to something that its reader must not see,
/// and what is wrong is at that place. Control and other invisible characters are escaped, so
/// that no file can send control sequences to a terminal.
pub(super) fn quoted(text: &str) -> String {
    if text.is_empty() {
        return "nothing".to_owned();
    }
    let is_number = text.bytes().all(|it| it.is_ascii_digit() || it == b'-');
    let length = if is_number && text.len() <= DIGITS_MAX {
        text.len()
    } else {
        1
    };
    let mut characters = text.chars();
    let mut shown = String::from("`");
    for character in characters.by_ref().take(length) {
        match character {
            '"' | '\'' => shown.push(character),
            _ => shown.extend(character.escape_debug()),
        }
    }
    let rest = characters.next().is_some();
    shown.push_str(if rest { "...`" } else { "`" });
    shown
}

/// A character of a row as messages quote it; `None` is past the end of the line.
pub(super) fn quoted_character(character: Option<char>) -> String {
    match character {
        None => "the end of the line".to_owned(),
        Some(' ') => "a space".to_owned(),
        Some(character) => quoted(character.encode_utf8(&mut [0; 4])),
    }
}
