//! Untrusted text, escaped for where it is shown.

use std::fmt::Write as _;

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
pub fn for_terminal(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_control() {
            escaped.extend(character.escape_debug());
        } else if is_invisible(character) {
            escaped.extend(character.escape_unicode());
        } else {
            escaped.push(character);
        }
    }
    escaped
}

/// JSON with every character escaped that [`for_terminal`] escapes: a program reads the same
/// values, and a terminal shows them as they are. JSON itself requires that only of the first
/// 32 characters.
pub(super) fn json_for_terminal(json: &str) -> String {
    let mut escaped = String::with_capacity(json.len());
    for character in json.chars() {
        // A line break is always between values, because one in a string is escaped already.
        // All other characters of this kind are in strings: no other part of JSON has them.
        if character != '\n' && (character.is_control() || is_invisible(character)) {
            for unit in character.encode_utf16(&mut [0; 2]) {
                write!(escaped, "\\u{unit:04x}").expect("writing to a string cannot fail");
            }
        } else {
            escaped.push(character);
        }
    }
    escaped
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
