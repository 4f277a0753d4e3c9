//! Places in a configuration file: of bytes as lines and columns, of keys as ranges of bytes, and
//! of ranges of bytes as keys.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Where a range of bytes is, up to the end of the line that it begins in.
pub(super) struct Position<'a> {
    /// Counted from 1.
    pub line: usize,
    /// In characters, counted from 1.
    pub column: usize,
    /// The line, without its break.
    pub text: &'a str,
    /// The range in the line.
    pub marked: Range<usize>,
}

impl<'a> Position<'a> {
    pub(super) fn new(text: &'a str, span: Range<usize>) -> Self {
        let start = floor_char_boundary(text, span.start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let rest = &text[line_start..];
        let line_text = rest.split('\n').next().unwrap_or_default();
        let line_text = line_text.strip_suffix('\r').unwrap_or(line_text);
        let marked_start = (start - line_start).min(line_text.len());
        let end = floor_char_boundary(text, span.end.max(start)) - line_start;
        Self {
            line: text[..line_start].matches('\n').count() + 1,
            column: line_text[..marked_start].chars().count() + 1,
            text: line_text,
            marked: marked_start..end.clamp(marked_start, line_text.len()),
        }
    }
}

fn floor_char_boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// The path of the key or value at a range of bytes, such as `robots[0].path`: of the smallest one
/// that holds it. Empty for a range that is in none.
pub(super) fn key_at(root: &DeTable<'_>, span: &Range<usize>) -> String {
    let mut found = Found {
        span,
        best: usize::MAX,
        path: String::new(),
    };
    found.table(root, "");
    found.path
}

struct Found<'a> {
    span: &'a Range<usize>,
    best: usize,
    path: String,
}

impl Found<'_> {
    fn table(&mut self, table: &DeTable<'_>, path: &str) {
        for (key, value) in table {
            let name: &str = key.get_ref();
            let path = if path.is_empty() {
                name.to_owned()
            } else {
                format!("{path}.{name}")
            };
            self.consider(&key.span(), &path);
            self.value(value, &path);
        }
    }

    fn value(&mut self, value: &Spanned<DeValue<'_>>, path: &str) {
        self.consider(&value.span(), path);
        match value.get_ref() {
            DeValue::Table(table) => self.table(table, path),
            DeValue::Array(elements) => {
                for (index, element) in elements.iter().enumerate() {
                    self.value(element, &format!("{path}[{index}]"));
                }
            }
            _ => {}
        }
    }

    /// Later candidates win when they are as small: they are deeper.
    fn consider(&mut self, candidate: &Range<usize>, path: &str) {
        let holds = candidate.start <= self.span.start && self.span.end <= candidate.end;
        if holds && candidate.len() <= self.best {
            self.best = candidate.len();
            path.clone_into(&mut self.path);
        }
    }
}

/// The range of bytes of a key's value, or of the last part of its path that is there: for a
/// table that is its header.
pub(super) fn span_of(root: &Spanned<DeTable<'_>>, path: &str) -> Range<usize> {
    let mut parts = path.split(['.', '[']).filter(|part| !part.is_empty());
    let Some(value) = parts.next().and_then(|key| root.get_ref().get(key)) else {
        return 0..0;
    };
    let mut value = value;
    for part in parts {
        let next = match (value.get_ref(), part.strip_suffix(']')) {
            (DeValue::Array(elements), Some(index)) => {
                index.parse().ok().and_then(|it: usize| elements.get(it))
            }
            (DeValue::Table(table), None) => table.get(part),
            _ => None,
        };
        match next {
            Some(next) => value = next,
            None => break,
        }
    }
    value.span()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "a = 1\n[[b]]\nc = [\"ä\", 22]\n[[b]]\nd.e = { f = true }\n";

    #[track_caller]
    fn check(path: &str, found: &str) {
        let root = DeTable::parse(TEXT).expect("TOML");
        let span = span_of(&root, path);
        assert_eq!(&TEXT[span.clone()], found, "{path}");
        assert_eq!(key_at(root.get_ref(), &span), path);
    }

    #[test]
    fn keys_and_places_belong_together() {
        check("a", "1");
        check("b[0]", "[[b]]");
        check("b[0].c", "[\"ä\", 22]");
        check("b[0].c[1]", "22");
        check("b[1].d.e.f", "true");
    }

    #[test]
    fn a_key_that_is_missing_has_the_place_of_its_table() {
        let root = DeTable::parse(TEXT).expect("TOML");
        assert_eq!(
            span_of(&root, "b[1].x.y").start,
            TEXT.rfind("[[b").expect("it")
        );
        assert_eq!(span_of(&root, "x"), 0..0);
    }

    #[test]
    fn positions_count_characters_and_end_with_the_line() {
        let at = |span| {
            let Position {
                line,
                column,
                text,
                marked,
            } = Position::new("ä = 1\r\nbc", span);
            (line, column, text, marked)
        };
        assert_eq!(at(5..6), (1, 5, "ä = 1", 5..6));
        assert_eq!(at(3..9), (1, 3, "ä = 1", 3..6));
        assert_eq!(at(8..10), (2, 1, "bc", 0..2));
        assert_eq!(at(99..120), (2, 3, "bc", 2..2));
        assert_eq!(at(1..1), (1, 1, "ä = 1", 0..0));
    }
}
