//! [`document`]: a JSON document as text.

use serde::Serialize;

use super::visible::visible_json;

/// The value as JSON, indented, with a newline at the end. Text in it comes from
/// strangers; what could play with a terminal is escaped.
pub(super) fn document(value: &impl Serialize) -> String {
    let json = serde_json::to_string_pretty(value)
        .expect("reports hold strings, numbers, lists and maps with string keys");
    let mut text = visible_json(&json);
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_strangers_means_the_same_and_does_nothing() {
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
            "letters and pictures stay: {json}"
        );
        let read: Vec<String> = serde_json::from_str(&json).expect("it is JSON");
        assert_eq!(read, [text]);
    }
}
