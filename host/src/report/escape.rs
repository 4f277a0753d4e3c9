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

/// Format characters (Unicode category Cf and the line separators): they change how their
/// neighbours look and cannot be seen themselves.
const fn is_invisible(character: char) -> bool {
    matches!(
        character,
        '\u{ad}'
            | '\u{61c}'
            | '\u{115f}'..='\u{1160}'
            | '\u{180e}'
            | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{3164}'
            | '\u{fe00}'..='\u{fe0f}'
            | '\u{feff}'
            | '\u{fff9}'..='\u{fffb}'
            | '\u{1d173}'..='\u{1d17a}'
            | '\u{e0000}'..='\u{e0fff}'
    )
}
