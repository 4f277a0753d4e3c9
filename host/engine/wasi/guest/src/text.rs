//! [`Text`]: a string of limited length, without an allocator.

/// A string of at most `MAX` bytes; what does not fit is left out.
#[derive(Debug)]
pub struct Text<const MAX: usize> {
    bytes: [u8; MAX],
    length: usize,
}

impl<const MAX: usize> Default for Text<MAX> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const MAX: usize> Text<MAX> {
    /// The empty text.
    pub const fn new() -> Self {
        Self {
            bytes: [0; MAX],
            length: 0,
        }
    }

    /// Makes it the empty text.
    pub const fn clear(&mut self) {
        self.length = 0;
    }

    /// Adds a text, or nothing if it does not fit.
    pub fn push(&mut self, text: &str) {
        let end = self.length + text.len();
        if let Some(room) = self.bytes.get_mut(self.length..end) {
            room.copy_from_slice(text.as_bytes());
            self.length = end;
        }
    }

    /// Adds a decimal number.
    pub fn push_number(&mut self, number: u32) {
        if number >= 10 {
            self.push_number(number / 10);
        }
        let digits = "0123456789";
        let digit = (number % 10) as usize;
        self.push(&digits[digit..=digit]);
    }

    /// Adds bytes, with U+FFFD for what is no UTF-8.
    pub fn push_lossy(&mut self, bytes: &[u8]) {
        for chunk in bytes.utf8_chunks() {
            self.push(chunk.valid());
            if !chunk.invalid().is_empty() {
                self.push("\u{fffd}");
            }
        }
    }

    /// The text.
    pub fn as_str(&self) -> &str {
        let bytes = self.bytes.get(..self.length).unwrap_or_default();
        // SAFETY: only whole strings are added.
        unsafe { core::str::from_utf8_unchecked(bytes) }
    }
}

/// Where to cut bytes that go on, so that no character is divided: at the end, or before a
/// character that begins within the last three bytes and is not complete.
pub fn boundary(bytes: &[u8]) -> usize {
    let last = bytes.iter().rev().take(3);
    let tail = last.take_while(|&&byte| byte & 0xc0 == 0x80).count();
    let begin = bytes.len().saturating_sub(tail + 1);
    let length = match bytes.get(begin) {
        Some(0xc0..=0xdf) => 2,
        Some(0xe0..=0xef) => 3,
        Some(0xf0..=0xff) => 4,
        _ => 1,
    };
    if begin > 0 && bytes.len() - begin < length {
        begin
    } else {
        bytes.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_left_out() {
        let mut text = Text::<5>::new();
        text.push_number(429);
        text.push("ä");
        text.push("!");
        assert_eq!(text.as_str(), "429ä");
        text.clear();
        text.push_number(0);
        text.push_lossy(b"\xff");
        assert_eq!(text.as_str(), "0\u{fffd}");
    }

    #[test]
    fn characters_are_not_divided() {
        for (bytes, expected) in [
            (b"".as_slice(), 0),
            (b"ab", 2),
            ("aä".as_bytes(), 3),
            (b"a\xc3", 1),
            (b"a\xe2\x82", 1),
            (b"a\xf0\x9f\x98", 1),
            ("a😀".as_bytes(), 5),
            (b"a\x80\x80\x80\x80", 5),
            (b"\xf0", 1),
        ] {
            assert_eq!(boundary(bytes), expected, "{bytes:x?}");
        }
    }
}
