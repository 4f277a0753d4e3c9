//! [`document`]: a small JSON document as text.

use serde::Serialize;

use super::escape;

/// The value as indented JSON with a newline at the end, escaped for terminals.
pub(super) fn document(value: &impl Serialize) -> String {
    let mut text = pretty(value);
    text.push('\n');
    text
}

/// The value as indented JSON without a newline at the end, escaped for terminals.
pub(super) fn pretty(value: &impl Serialize) -> String {
    escaped(serde_json::to_string_pretty(value))
}

/// The value as JSON on one line, escaped for terminals.
pub(super) fn line(value: &impl Serialize) -> String {
    escaped(serde_json::to_string(value))
}

fn escaped(json: serde_json::Result<String>) -> String {
    let json = json.expect("reports hold strings, numbers, lists and maps with string keys");
    escape::json_for_terminal(&json)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escaped_text_is_read_back_unchanged() {
        let text = "a\u{1b}[31m\u{9b}\u{7f}\u{202e}\u{e0041}\"\\\n\u{e9}\u{1f9ff}";
        let json = document(&[text]);
        let harmful =
            |c: char| (c.is_control() && c != '\n') || c == '\u{202e}' || c == '\u{e0041}';
        assert!(!json.contains(harmful), "{json:?}");
        assert!(
            json.contains("\\u009b\\u007f\\u202e\\udb40\\udc41"),
            "{json}"
        );
        assert!(
            json.contains('\u{1f9ff}'),
            "visible characters stay: {json}"
        );
        let read: Vec<String> = serde_json::from_str(&json).expect("it is JSON");
        assert_eq!(read, [text]);
        assert_eq!(line(&[text]).lines().count(), 1);
    }
}
