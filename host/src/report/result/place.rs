//! [`place`]: which field of a JSON text a byte belongs to.
//!
//! Works on broken text too, as far as it makes sense up to that byte, so that
//! messages about damage can name the field.

use super::super::visible;

/// Lists and objects that are followed into each other; the reader gives up earlier.
const DEPTH_MAX: usize = 128;

/// Characters of a name that are shown.
const NAME_SHOWN_MAX: usize = 40;

/// Where a byte is in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Place {
    /// Counted from 1.
    pub line: usize,
    /// In bytes, counted from 1.
    pub column: usize,
    /// Such as `matches[17].fuel`; empty outside the document's object.
    pub path: String,
}

/// A list or object that is open at some place.
enum Level<'a> {
    /// The place is in the element with this index, counted from 0.
    List(usize),
    /// The place is in the value of that name, once there is one.
    Object {
        name: Option<&'a [u8]>,
        is_value: bool,
    },
}

/// The place of the byte at `offset`, or of the text's end behind it.
pub(super) fn place(text: &[u8], offset: usize) -> Place {
    let before = &text[..offset.min(text.len())];
    let line_start = before.iter().rposition(|&byte| byte == b'\n');
    let line_start = line_start.map_or(0, |newline| newline + 1);
    Place {
        line: before.iter().filter(|&&byte| byte == b'\n').count() + 1,
        column: before.len() - line_start + 1,
        path: path(text, before.len()),
    }
}

/// The offset of a line and column as [`Place`] counts them.
pub(super) fn offset(text: &[u8], line: usize, column: usize) -> usize {
    let mut lines = text.split_inclusive(|&byte| byte == b'\n');
    let before: usize = lines
        .by_ref()
        .take(line.saturating_sub(1))
        .map(<[u8]>::len)
        .sum();
    (before + column.saturating_sub(1)).min(text.len())
}

fn path(text: &[u8], offset: usize) -> String {
    let mut levels = Vec::new();
    let mut at = 0;
    while at < offset && levels.len() <= DEPTH_MAX {
        let begin = at;
        at += 1;
        match text[begin] {
            b'"' => {
                at = string_end(text, at);
                if let Some(Level::Object { name, is_value }) = levels.last_mut()
                    && !*is_value
                {
                    *name = Some(text[begin..at].trim_ascii());
                }
            }
            b'[' => levels.push(Level::List(0)),
            b'{' => levels.push(Level::Object {
                name: None,
                is_value: false,
            }),
            b']' | b'}' => drop(levels.pop()),
            b':' => {
                if let Some(Level::Object { is_value, .. }) = levels.last_mut() {
                    *is_value = true;
                }
            }
            b',' => match levels.last_mut() {
                Some(Level::List(index)) => *index += 1,
                Some(level) => {
                    *level = Level::Object {
                        name: None,
                        is_value: false,
                    };
                }
                None => {}
            },
            _ => {}
        }
    }
    if matches!(text.get(offset), Some(b']' | b'}')) && at == offset {
        // The bracket belongs to the whole list or object.
        levels.pop();
    }
    written(&levels)
}

/// The offset behind the string that has begun, or the end of the text.
fn string_end(text: &[u8], begin: usize) -> usize {
    let mut at = begin;
    while let Some(byte) = text.get(at) {
        at += 1;
        match byte {
            b'"' => return at,
            b'\\' => at += 1,
            _ => {}
        }
    }
    text.len()
}

fn written(levels: &[Level<'_>]) -> String {
    let mut path = String::new();
    for level in levels {
        match level {
            Level::List(index) => path.push_str(&format!("[{index}]")),
            Level::Object { name: None, .. } => {}
            Level::Object {
                name: Some(name), ..
            } => {
                if !path.is_empty() {
                    path.push('.');
                }
                let name = String::from_utf8_lossy(name);
                let name: String = name
                    .trim_matches('"')
                    .chars()
                    .take(NAME_SHOWN_MAX)
                    .collect();
                path.push_str(&visible(&name));
            }
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"{"schema": 1, "seeds": [4, 5],
 "matches": [{"robot": "a\"]", "fault": {"x": 3}}, {"robot": "b"}]}"#;

    #[track_caller]
    fn check(text: &str, needle: &str, expected: (usize, usize, &str)) {
        let at = text.find(needle).expect("the needle is in the text");
        let found = place(text.as_bytes(), at);
        let (line, column, path) = expected;
        let path = path.to_owned();
        assert_eq!(found, Place { line, column, path }, "{needle}");
        assert_eq!(offset(text.as_bytes(), line, column), at, "{needle}");
    }

    #[test]
    fn bytes_are_named_by_their_fields() {
        check(TEXT, "1, ", (1, 12, "schema"));
        check(TEXT, "chema", (1, 4, "schema"));
        check(TEXT, "5]", (1, 28, "seeds[1]"));
        check(TEXT, "]\"", (2, 28, "matches[0].robot"));
        check(TEXT, "3}", (2, 47, "matches[0].fault.x"));
        check(TEXT, "}}", (2, 48, "matches[0].fault"));
        check(TEXT, "b\"", (2, 63, "matches[1].robot"));
        check(TEXT, "]}", (2, 66, "matches"));
        check(TEXT, "{", (1, 1, ""));
    }

    #[test]
    fn broken_text_has_places_too() {
        for text in [
            "",
            "]]]}",
            "\"",
            "\"\\",
            "{{{",
            ",:,",
            "\u{0}\u{7f}é",
            "[,,,",
        ] {
            for at in 0..=text.len() + 1 {
                let _ = place(text.as_bytes(), at);
            }
        }
        assert_eq!(place(b"[,,,", 4).path, "[3]");
        assert_eq!(place(b"{\"\x1b[31m\": 1", 10).path, "\\u{1b}[31m");
        let deep = "[".repeat(1_000_000);
        assert!(place(deep.as_bytes(), deep.len()).path.len() < 1000);
    }
}
