//! [`Digest`]: the identity of a component, maze, ruleset, match or transcript by its content.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use sha2::{Digest as _, Sha256};

/// A SHA-256 digest.
///
/// The text form has 64 lowercase hexadecimal digits. Serialises as text in formats for people
/// such as JSON, and as 32 bytes in binary formats.
///
/// ```
/// use wasmouse_core::Digest;
/// let digest = Digest::of(b"");
/// assert!(digest.to_string().starts_with("e3b0c44298fc1c14"));
/// assert_eq!(digest.to_string().parse(), Ok(digest));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Digest([u8; 32]);

/// The text is not 64 lowercase hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a SHA-256 digest of 64 lowercase hexadecimal digits")]
pub struct ParseDigestError;

impl Digest {
    /// The digest of these bytes.
    pub fn of(bytes: &[u8]) -> Self {
        Self(Sha256::digest(bytes).into())
    }

    /// The digest with this value.
    pub const fn from_bytes(bytes: [u8; 32]) -> Self {
        Self(bytes)
    }

    /// The 32 bytes.
    pub const fn as_bytes(&self) -> &[u8; 32] {
        &self.0
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl FromStr for Digest {
    type Err = ParseDigestError;

    fn from_str(text: &str) -> Result<Self, ParseDigestError> {
        let text: &[u8; 64] = text.as_bytes().try_into().map_err(|_| ParseDigestError)?;
        let mut bytes = [0; 32];
        for (byte, pair) in bytes.iter_mut().zip(text.chunks_exact(2)) {
            *byte = hex_digit(pair[0])? << 4 | hex_digit(pair[1])?;
        }
        Ok(Self(bytes))
    }
}

/// The value of a lowercase digit. Uppercase is rejected, so that a digest has one text form.
const fn hex_digit(digit: u8) -> Result<u8, ParseDigestError> {
    match digit {
        b'0'..=b'9' => Ok(digit - b'0'),
        b'a'..=b'f' => Ok(digit - b'a' + 10),
        _ => Err(ParseDigestError),
    }
}

impl Serialize for Digest {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            serializer.collect_str(self)
        } else {
            self.0.serialize(serializer)
        }
    }
}

impl<'de> Deserialize<'de> for Digest {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            let text = String::deserialize(deserializer)?;
            text.parse().map_err(serde::de::Error::custom)
        } else {
            <[u8; 32]>::deserialize(deserializer).map(Self)
        }
    }
}

/// Computes the digest of a value from its canonical encoding.
///
/// The encoding starts with its name and version, followed by a zero byte. Then come the
/// values: a number as 8 bytes, little endian; a digest as its 32 bytes; bytes as their length
/// (a number) and themselves. Two different sequences of values of the same types never have
/// the same bytes, and the bytes do not depend on `Debug`, on the order of a map or on the
/// machine.
///
/// ```
/// use wasmouse_core::{Digest, DigestBuilder};
/// let digest = DigestBuilder::new("example.pair.1").numbers(&[1]).bytes(b"xy").finish();
/// assert_eq!(
///     digest,
///     Digest::of(b"example.pair.1\0\x01\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0xy"),
/// );
/// ```
#[derive(Clone, Debug)]
pub struct DigestBuilder(Sha256);

impl DigestBuilder {
    /// Starts an encoding with a name such as `wasmouse.rules.1`.
    pub fn new(encoding: &str) -> Self {
        let mut hasher = Sha256::new();
        hasher.update(encoding);
        hasher.update([0]);
        Self(hasher)
    }

    /// Adds numbers, in order.
    #[must_use]
    pub fn numbers(mut self, numbers: &[u64]) -> Self {
        // In pieces, because each call of the hash function costs more than eight bytes do.
        let mut buffer = [0; 128];
        for piece in numbers.chunks(buffer.len() / 8) {
            let bytes = &mut buffer[..8 * piece.len()];
            for (bytes, number) in bytes.chunks_exact_mut(8).zip(piece) {
                bytes.copy_from_slice(&number.to_le_bytes());
            }
            self.0.update(bytes);
        }
        self
    }

    /// Adds a digest.
    #[must_use]
    pub fn digest(mut self, digest: &Digest) -> Self {
        self.0.update(digest.as_bytes());
        self
    }

    /// Adds bytes of any length.
    #[must_use]
    pub fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.update((bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
        self
    }

    /// The digest of all added values.
    pub fn finish(self) -> Digest {
        Digest(self.0.finalize().into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_canonical_text_is_parsed() {
        let text = Digest::of(b"x").to_string();
        assert_eq!(text.parse::<Digest>(), Ok(Digest::of(b"x")));
        for wrong in [
            text.to_uppercase(),
            text[1..].to_owned(),
            format!("{text}0"),
            text.replacen(|c: char| c.is_ascii_digit(), "g", 1),
        ] {
            assert_eq!(wrong.parse::<Digest>(), Err(ParseDigestError), "{wrong}");
        }
    }

    #[test]
    fn the_serialised_form_is_checked() {
        let json = serde_json::to_string(&Digest::of(b"x")).expect("it serialises");
        assert_eq!(json, format!("\"{}\"", Digest::of(b"x")));
        assert_eq!(serde_json::from_str(&json).ok(), Some(Digest::of(b"x")));
        let error = serde_json::from_str::<Digest>(&json.to_uppercase()).expect_err("uppercase");
        assert!(error.to_string().contains("64 lowercase"), "{error}");
    }

    #[test]
    fn the_name_of_the_encoding_is_part_of_the_digest() {
        let digest = |name: &str| DigestBuilder::new(name).numbers(&[1]).finish();
        assert_ne!(digest("a"), digest("b"));
    }
}
