//! [`visible`]: text from strangers, made harmless for a terminal.

use std::fmt::Write as _;

/// The text with everything escaped that could play with a terminal or with the
/// eye: control characters, line breaks, bidirectional overrides, zero-width and
/// other invisible characters.
///
/// ```
/// use wasmouse::report::visible;
/// assert_eq!(visible("ok"), "ok");
/// assert_eq!(visible("\u{1b}[31mred\n"), "\\u{1b}[31mred\\n");
/// assert_eq!(visible("a\u{202e}b"), "a\\u{202e}b");
/// ```
pub fn visible(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_control() {
            shown.extend(character.escape_debug());
        } else if is_invisible(character) {
            shown.extend(character.escape_unicode());
        } else {
            shown.push(character);
        }
    }
    shown
}

/// JSON with everything escaped that [`visible`] would escape: it means the same to a
/// program and does nothing to a terminal. JSON escapes only the first 32 characters by
/// itself.
pub(super) fn visible_json(json: &str) -> String {
    let mut shown = String::with_capacity(json.len());
    for character in json.chars() {
        // Line breaks are between values; those in text are escaped already. So are
        // all other such characters in text: nothing else of JSON needs them.
        if character != '\n' && (character.is_control() || is_invisible(character)) {
            for unit in character.encode_utf16(&mut [0; 2]) {
                write!(shown, "\\u{unit:04x}").expect("writing to a string cannot fail");
            }
        } else {
            shown.push(character);
        }
    }
    shown
}

/// Format characters (Unicode category Cf and the line separators): they change
/// how their neighbours look and have no look of their own.
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
