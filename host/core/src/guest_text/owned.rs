//! [`GuestText`]: text from outside.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::borrowed::GuestStr;
use super::escape::Escaped;

/// Text from outside: from a robot, a file name, a maze, a file of results. Serialises as a string.
///
/// Any string becomes one. To print it, say for what:
///
/// ```
/// use wasmouse_core::GuestText;
///
/// let text = GuestText::from("\u{1b}[2Jdone");
/// println!("{}", text.escaped());
/// assert_eq!(text.escaped().to_string(), "\\u{1b}[2Jdone");
/// assert_eq!(format!("{text:?}"), "\"\\u{1b}[2Jdone\"");
/// assert_eq!(serde_json::to_string(&text)?, r#""\u001b[2Jdone""#);
/// # Ok::<(), serde_json::Error>(())
/// ```
///
/// Nothing else compiles. Not a format:
///
/// ```compile_fail
/// let text = wasmouse_core::GuestText::from("\u{1b}[2Jdone");
/// println!("{}", text);
/// ```
///
/// ```compile_fail
/// let text = wasmouse_core::GuestText::from("\u{1b}[2Jdone");
/// println!("{text}");
/// ```
///
/// ```compile_fail
/// use std::fmt::Write as _;
/// let text = wasmouse_core::GuestText::from("\u{1b}[2Jdone");
/// let mut output = String::new();
/// write!(output, "{}", text).expect("a string takes any text");
/// ```
///
/// Not a conversion:
///
/// ```compile_fail
/// let text = wasmouse_core::GuestText::from("\u{1b}[2Jdone");
/// let string: String = text.to_string();
/// ```
///
/// ```compile_fail
/// let text = wasmouse_core::GuestText::from("\u{1b}[2Jdone");
/// let string: String = text.into();
/// ```
///
/// ```compile_fail
/// let text = wasmouse_core::GuestText::from("\u{1b}[2Jdone");
/// let string: &str = text.as_ref();
/// ```
///
/// And not a string's methods or a place where one is expected:
///
/// ```compile_fail
/// let text = wasmouse_core::GuestText::from("\u{1b}[2Jdone");
/// let shown = text.replace('\u{1b}', "");
/// ```
///
/// ```compile_fail
/// let text = wasmouse_core::GuestText::from("\u{1b}[2Jdone");
/// let mut output = String::new();
/// output.push_str(&text);
/// ```
#[derive(Clone, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct GuestText(String);

impl GuestText {
    /// No text.
    pub const fn new() -> Self {
        Self(String::new())
    }

    /// The text, borrowed.
    pub fn as_guest(&self) -> GuestStr<'_> {
        GuestStr::from(self.0.as_str())
    }

    /// The text as it is: not to be printed.
    pub fn raw(&self) -> &str {
        &self.0
    }

    /// The text for a terminal: every character is escaped that could control it or mislead a
    /// reader, line breaks included.
    pub fn escaped(&self) -> Escaped<'_> {
        self.as_guest().escaped()
    }

    /// The length in bytes.
    pub const fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is no text.
    pub const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds text to the end.
    pub fn push<'a>(&mut self, text: impl Into<GuestStr<'a>>) {
        self.0.push_str(text.into().raw());
    }
}

/// Writes text to the end.
impl fmt::Write for GuestText {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write_str(text)
    }
}

impl From<String> for GuestText {
    fn from(text: String) -> Self {
        Self(text)
    }
}

impl From<&str> for GuestText {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

impl From<GuestStr<'_>> for GuestText {
    fn from(text: GuestStr<'_>) -> Self {
        Self(text.raw().to_owned())
    }
}

impl<'a> From<&'a GuestText> for GuestStr<'a> {
    fn from(text: &'a GuestText) -> Self {
        text.as_guest()
    }
}

/// For tests and comparisons with what the host has written itself.
impl PartialEq<str> for GuestText {
    fn eq(&self, other: &str) -> bool {
        self.0 == other
    }
}

impl PartialEq<&str> for GuestText {
    fn eq(&self, other: &&str) -> bool {
        self.0 == *other
    }
}

/// In quotes, escaped for a terminal.
impl fmt::Debug for GuestText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.as_guest(), f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn debug_output_is_escaped_and_quoted() {
        for (text, shown) in [
            ("plain", "\"plain\""),
            ("a \"b\" \\", r#""a \"b\" \\""#),
            ("\u{1b}[31m\n", r#""\u{1b}[31m\n""#),
            ("a\u{202e}b\u{115f}", r#""a\u{202e}b\u{115f}""#),
            ("迷路", "\"迷路\""),
        ] {
            assert_eq!(format!("{:?}", GuestText::from(text)), shown);
            assert_eq!(format!("{:?}", GuestStr::from(text)), shown);
        }
    }

    #[test]
    fn the_serialised_form_is_a_string() {
        let text = GuestText::from("\u{1b}\"é");
        let json = serde_json::to_string(&text).expect("it serialises");
        assert_eq!(json, serde_json::to_string("\u{1b}\"é").expect("a string"));
        assert_eq!(
            serde_json::to_string(&text.as_guest()).expect("it serialises"),
            json
        );
        assert_eq!(serde_json::from_str::<GuestText>(&json).ok(), Some(text));
        assert!(serde_json::from_str::<GuestText>("1").is_err());
    }

    #[test]
    fn texts_are_cut_between_characters() {
        let text = GuestStr::from("éa\u{202e}b");
        assert_eq!(text.cut(1), ("é".into(), true));
        assert_eq!(text.cut(4), (text, false));
        assert_eq!(text.cut(0), ("".into(), true));
    }
}
