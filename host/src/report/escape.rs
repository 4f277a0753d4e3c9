//! Untrusted text, escaped for where it is shown.

use std::fmt::Write as _;

use wasmouse_core::guest_text::{GuestStr, misleads};

/// The text with every character escaped that could control a terminal or mislead a reader:
/// control characters, line breaks, bidirectional overrides, zero-width and other invisible
/// characters.
///
/// ```
/// use wasmouse::report::escape::for_terminal;
/// assert_eq!(for_terminal("ok"), "ok");
/// assert_eq!(for_terminal("\u{1b}[31mred\n"), "\\u{1b}[31mred\\n");
/// assert_eq!(for_terminal("a\u{202e}b"), "a\\u{202e}b");
/// ```
pub fn for_terminal<'a>(text: impl Into<GuestStr<'a>>) -> String {
    text.into().escaped().to_string()
}

/// JSON with every character escaped that [`for_terminal`] escapes: a program reads the same
/// values, and a terminal shows them as they are. JSON itself requires that only of the first
/// 32 characters.
pub(super) fn json_for_terminal(json: &str) -> String {
    let mut escaped = String::with_capacity(json.len());
    for character in json.chars() {
        // A line break is always between values, because one in a string is escaped already.
        // All other characters of this kind are in strings: no other part of JSON has them.
        if character != '\n' && misleads(character) {
            for unit in character.encode_utf16(&mut [0; 2]) {
                write!(escaped, "\\u{unit:04x}").expect("writing to a string cannot fail");
            }
        } else {
            escaped.push(character);
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_that_cannot_be_seen_are_escaped() {
        for character in [
            '\u{0}',
            '\t',
            '\n',
            '\r',
            '\u{1b}',
            '\u{7f}',
            '\u{85}',
            '\u{9b}',
            '\u{ad}',
            '\u{34f}',
            '\u{61c}',
            '\u{200b}',
            '\u{200e}',
            '\u{2028}',
            '\u{202e}',
            '\u{2066}',
            '\u{2069}',
            '\u{feff}',
            '\u{fe0f}',
            '\u{1345f}',
            '\u{e0001}',
            '\u{e0100}',
        ] {
            let text = format!("a{character}b");
            let escaped = for_terminal(&text);
            assert!(escaped.is_ascii(), "{escaped}");
            assert!(!escaped.contains(|it: char| it.is_control()), "{escaped}");
            assert_eq!(for_terminal(&escaped), escaped, "nothing is escaped twice");
            let json = serde_json::to_string(&text).expect("a string");
            let safe = json_for_terminal(&json);
            assert!(safe.is_ascii(), "{safe}");
            let back: String = serde_json::from_str(&safe).expect("the same string");
            assert_eq!(back, text);
        }
        assert_eq!(for_terminal("Grüße, 迷路 ✓"), "Grüße, 迷路 ✓");
    }
}
