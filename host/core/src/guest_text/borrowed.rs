//! [`GuestStr`]: text from outside, borrowed.

use std::fmt;

use serde::{Serialize, Serializer};

use super::escape::{Escaped, misleads};

/// Text from outside, borrowed: to [`GuestText`](super::GuestText) what `&str` is to `String`.
/// Serialises as a string.
///
/// What escapes text for an output takes `impl Into<GuestStr<'_>>`: texts of either kind.
///
/// ```
/// use wasmouse_core::guest_text::GuestStr;
///
/// let text = GuestStr::from("\u{1b}[2Jdone");
/// assert_eq!(text.escaped().to_string(), "\\u{1b}[2Jdone");
/// ```
///
/// ```compile_fail
/// use wasmouse_core::guest_text::GuestStr;
///
/// let text = GuestStr::from("\u{1b}[2Jdone");
/// assert_eq!(text.to_string(), "\\u{1b}[2Jdone");
/// ```
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GuestStr<'a>(&'a str);

impl<'a> GuestStr<'a> {
    /// The text as it is: not to be printed.
    pub const fn raw(self) -> &'a str {
        self.0
    }

    /// The text for a terminal: every character is escaped that could control it or mislead a
    /// reader, line breaks included.
    pub const fn escaped(self) -> Escaped<'a> {
        Escaped(self.0)
    }

    /// The length in bytes.
    pub const fn len(self) -> usize {
        self.0.len()
    }

    /// Whether there is no text.
    pub const fn is_empty(self) -> bool {
        self.0.is_empty()
    }

    /// The lines, without what separates them.
    pub fn lines(self) -> impl DoubleEndedIterator<Item = Self> {
        self.0.lines().map(Self)
    }

    /// Without white space at its ends.
    #[must_use]
    pub fn trim(self) -> Self {
        Self(self.0.trim())
    }

    /// Without white space at its end.
    #[must_use]
    pub fn trim_end(self) -> Self {
        Self(self.0.trim_end())
    }

    /// Whether the text starts so.
    pub fn starts_with(self, prefix: &str) -> bool {
        self.0.starts_with(prefix)
    }

    /// The first characters, that many at most, and whether there are more.
    pub fn cut(self, chars_max: usize) -> (Self, bool) {
        match self.0.char_indices().nth(chars_max) {
            Some((end, _)) => (Self(&self.0[..end]), true),
            None => (self, false),
        }
    }
}

impl<'a> From<&'a str> for GuestStr<'a> {
    fn from(text: &'a str) -> Self {
        Self(text)
    }
}

impl<'a> From<&'a String> for GuestStr<'a> {
    fn from(text: &'a String) -> Self {
        Self(text)
    }
}

/// For tests and comparisons with what the host has written itself.
impl PartialEq<str> for GuestStr<'_> {
    fn eq(&self, other: &str) -> bool {
        self.0 == other
    }
}

impl PartialEq<&str> for GuestStr<'_> {
    fn eq(&self, other: &&str) -> bool {
        self.0 == *other
    }
}

/// In quotes, escaped for a terminal.
impl fmt::Debug for GuestStr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = String::with_capacity(self.0.len() + 2);
        for character in self.0.chars() {
            if misleads(character) && !character.is_control() {
                shown.extend(character.escape_unicode());
            } else {
                shown.extend(character.escape_debug());
            }
        }
        write!(f, "\"{shown}\"")
    }
}

impl Serialize for GuestStr<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}
