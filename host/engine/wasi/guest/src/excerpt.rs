//! [`Excerpt`]: the beginning and the end of what was written.

use crate::text::Text;

/// How much is kept of the beginning: Go writes the message there. Unit: bytes.
const HEAD_BYTES_MAX: usize = 700;

/// How much is kept in all: the end as well, where Python writes the message. The host keeps
/// 2,000 bytes of the message of a panic. Unit: bytes.
const BYTES_MAX: usize = 1900;

/// Stands for what was left out.
const LEFT_OUT: &str = "\n[...]\n";

/// The beginning and the end of what was written to standard error.
#[derive(Debug)]
pub struct Excerpt {
    bytes: [u8; BYTES_MAX],
    length: usize,
    is_cut: bool,
}

impl Excerpt {
    /// Of nothing.
    pub const fn new() -> Self {
        Self {
            bytes: [0; BYTES_MAX],
            length: 0,
            is_cut: false,
        }
    }

    /// Forgets everything.
    pub const fn clear(&mut self) {
        self.length = 0;
        self.is_cut = false;
    }

    /// Adds bytes at the end.
    pub fn add(&mut self, bytes: &[u8]) {
        let head = HEAD_BYTES_MAX.saturating_sub(self.length).min(bytes.len());
        let (head, rest) = bytes.split_at(head);
        self.append(head);
        let tail_max = BYTES_MAX - HEAD_BYTES_MAX;
        let skipped = rest.len().saturating_sub(tail_max);
        let rest = &rest[skipped..];
        let surplus = (self.length + rest.len()).saturating_sub(BYTES_MAX);
        if surplus > 0 {
            let kept = HEAD_BYTES_MAX + surplus..self.length;
            self.length -= surplus;
            self.bytes.copy_within(kept, HEAD_BYTES_MAX);
        }
        self.is_cut |= surplus + skipped > 0;
        self.append(rest);
    }

    fn append(&mut self, bytes: &[u8]) {
        self.bytes[self.length..][..bytes.len()].copy_from_slice(bytes);
        self.length += bytes.len();
    }

    /// Adds the excerpt to a text after `prefix`, without white space around it; nothing if there
    /// is nothing.
    pub fn append_to<const MAX: usize>(&self, prefix: &str, text: &mut Text<MAX>) {
        let all = self.bytes[..self.length].trim_ascii();
        if all.is_empty() {
            return;
        }
        text.push(prefix);
        if self.is_cut {
            let (head, tail) = self.bytes[..self.length].split_at(HEAD_BYTES_MAX);
            text.push_lossy(head.trim_ascii());
            text.push(LEFT_OUT);
            text.push_lossy(tail.trim_ascii());
        } else {
            text.push_lossy(all);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(pieces: &[&[u8]]) -> String {
        let mut excerpt = Excerpt::new();
        for piece in pieces {
            excerpt.add(piece);
        }
        let mut text = Text::<4000>::new();
        excerpt.append_to("! ", &mut text);
        text.as_str().to_owned()
    }

    #[test]
    fn short_texts_are_kept() {
        assert_eq!(shown(&[]), "");
        assert_eq!(shown(&[b"\n \n"]), "");
        assert_eq!(shown(&[b"a", b" b\n", b"\n"]), "! a b");
    }

    /// However it is divided, the beginning and the end are those of the whole.
    #[test]
    fn the_middle_of_long_texts_is_left_out() {
        let whole: Vec<u8> = b"abcdefghijklmnopqrstuvw".repeat(218);
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        for length in [1899, 1900, 1901, 2500, 5000] {
            let whole = &whole[..length];
            let tail = &whole[length.saturating_sub(1200)..];
            let expected = if length <= 1900 {
                format!("! {}", text(whole))
            } else {
                format!("! {}\n[...]\n{}", text(&whole[..700]), text(tail))
            };
            for size in [1, 7, 699, 700, 701, 1900, 5000] {
                let pieces: Vec<&[u8]> = whole.chunks(size).collect();
                assert_eq!(shown(&pieces), expected, "{length} bytes by {size}");
            }
        }
    }
}
