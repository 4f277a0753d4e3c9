//! [`ConfigError`]: what is wrong with a configuration file, and where.

use std::ops::Range;

use super::place::Position;

/// The longest message, in characters. Messages quote values of the file, which may be long.
const MESSAGE_CHARS_MAX: usize = 400;

/// The longest excerpt, in characters.
const EXCERPT_CHARS_MAX: usize = 100;

/// Something that is wrong with a configuration file. All texts may have any characters of the
/// file in them: `report::config` escapes them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}: {message}")]
pub struct ConfigError {
    /// The line, counted from 1.
    pub line: usize,
    /// The column in characters, counted from 1.
    pub column: usize,
    /// The path of the key, such as `robots[0].path`, with elements counted from 0; empty for
    /// the whole file and for what is no TOML.
    pub key: String,
    /// What is wrong, as a lowercase fragment.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
    /// The line of the file.
    pub excerpt: Box<Excerpt>,
}

/// A line of a configuration file, or the part of it around an error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The text, without its line break.
    pub text: String,
    /// The part of the text that is wrong, in bytes. Empty at the end of a line.
    pub marked: Range<usize>,
}

impl ConfigError {
    /// An error at a range of bytes of a text.
    pub(super) fn new(text: &str, span: Range<usize>, key: String, message: String) -> Self {
        let Position {
            line,
            column,
            text,
            marked,
        } = Position::new(text, span);
        Self {
            line,
            column,
            key,
            message: shortened(message),
            hint: None,
            excerpt: Box::new(Excerpt::new(text, marked)),
        }
    }

    /// The same error with what to do about it.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl Excerpt {
    /// The part of a line around what is marked in it.
    fn new(line: &str, marked: Range<usize>) -> Self {
        let before = line[..marked.start].char_indices().rev();
        let start = before
            .take(EXCERPT_CHARS_MAX / 2)
            .last()
            .map_or(marked.start, |(at, _)| at);
        let shown = &line[start..];
        let end = shown
            .char_indices()
            .nth(EXCERPT_CHARS_MAX)
            .map_or(shown.len(), |(at, _)| at);
        let text = shown[..end].to_owned();
        let marked = (marked.start - start)..(marked.end - start).min(end);
        Self { text, marked }
    }
}

fn shortened(message: String) -> String {
    match message.char_indices().nth(MESSAGE_CHARS_MAX) {
        None => message,
        Some((at, _)) => format!("{}...", &message[..at]),
    }
}
