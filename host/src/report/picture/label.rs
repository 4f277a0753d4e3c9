//! [`Label`]: a short untrusted text that is safe to draw.

use std::fmt;

use wasmouse_core::guest_text::GuestStr;

/// The most characters of a label that are shown.
pub const LABEL_CHARS_MAX: usize = 8;

/// A text of at most [`LABEL_CHARS_MAX`] characters without any that control a
/// terminal, reverse the direction of writing, or cannot be seen.
///
/// Those are replaced by U+FFFD, so that a reader sees that something was there.
/// Longer texts are cut.
///
/// ```
/// use wasmouse::report::picture::Label;
/// assert_eq!(Label::new("\u{1b}[31m!").as_str(), "\u{fffd}[31m!");
/// assert_eq!(Label::new("far too long").as_str(), "far too ");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Label(String);

impl Label {
    /// The label for any text; the empty text is no label.
    pub fn new<'a>(text: impl Into<GuestStr<'a>>) -> Self {
        let shown = text.into().raw().chars().take(LABEL_CHARS_MAX);
        Self(shown.map(replaced).collect())
    }

    /// The text.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether there is nothing to show.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A text of any length, with the same characters replaced as in labels.
pub(in crate::report) fn replace_hostile<'a>(text: impl Into<GuestStr<'a>>) -> String {
    text.into().raw().chars().map(replaced).collect()
}

fn replaced(character: char) -> char {
    if is_hostile(character) {
        char::REPLACEMENT_CHARACTER
    } else {
        character
    }
}

/// Characters that could change what is around them or hide in it, and those
/// that XML does not allow at all.
const fn is_hostile(character: char) -> bool {
    matches!(
        character,
        // Controls: C0, delete, C1.
        '\0'..='\u{1f}' | '\u{7f}'..='\u{9f}'
        // Soft hyphen, Arabic letter mark, Hangul and Mongolian fillers.
        | '\u{ad}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{180b}'..='\u{180f}' | '\u{3164}'
        // Zero width, bidirectional marks, embeddings, overrides and isolates,
        // line and paragraph separators, invisible operators.
        | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
        // Variation selectors, byte order mark, annotations, non-characters.
        | '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{ffa0}' | '\u{fff0}'..='\u{fffb}'
        | '\u{fffe}' | '\u{ffff}'
        // Tags and further variation selectors.
        | '\u{e0000}'..='\u{e0fff}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_characters_are_replaced_one_by_one() {
        for (text, shown) in [
            ("", ""),
            ("goal", "goal"),
            ("<b>&\"'", "<b>&\"'"),
            ("\u{9b}2J", "\u{fffd}2J"),
            ("a\u{202e}b", "a\u{fffd}b"),
            ("\n\r\t\0", "\u{fffd}\u{fffd}\u{fffd}\u{fffd}"),
            ("\u{200b}\u{feff}\u{e0041}", "\u{fffd}\u{fffd}\u{fffd}"),
            ("über 9µm", "über 9µm"),
            ("123456789", "12345678"),
        ] {
            assert_eq!(Label::new(text).as_str(), shown, "{text:?}");
        }
    }
}
