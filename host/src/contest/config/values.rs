//! Types for the values of configuration files: numbers in a range, names, and paths.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};

/// An integer from `MIN` to `MAX`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Integer<const MIN: u64, const MAX: u64>(u64);

impl<const MIN: u64, const MAX: u64> Integer<MIN, MAX> {
    /// The number, if it is in the range.
    pub const fn new(number: u64) -> Option<Self> {
        if MIN <= number && number <= MAX {
            Some(Self(number))
        } else {
            None
        }
    }

    /// The number.
    pub const fn get(self) -> u64 {
        self.0
    }

    /// The number as a `u32`.
    ///
    /// # Panics
    ///
    /// Does not compile if the range has larger numbers.
    pub const fn get_u32(self) -> u32 {
        const { assert!(MAX <= u32::MAX as u64) };
        self.0 as u32
    }

    /// The number.
    ///
    /// # Panics
    ///
    /// Does not compile if the range has larger numbers.
    pub const fn get_u16(self) -> u16 {
        const { assert!(MAX <= u16::MAX as u64) };
        self.0 as u16
    }
}

impl<'de, const MIN: u64, const MAX: u64> Deserialize<'de> for Integer<MIN, MAX> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_u64(IntegerVisitor)
    }
}

struct IntegerVisitor<const MIN: u64, const MAX: u64>;

impl<const MIN: u64, const MAX: u64> Visitor<'_> for IntegerVisitor<MIN, MAX> {
    type Value = Integer<MIN, MAX>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (MIN, MAX) {
            (0, u64::MAX) => write!(f, "an integer below 2^64"),
            (_, u64::MAX) => write!(f, "an integer of at least {MIN}"),
            _ if MIN == MAX => write!(f, "the integer {MIN}"),
            _ => write!(f, "an integer from {MIN} to {MAX}"),
        }
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Self::Value, E> {
        Integer::new(number).ok_or_else(|| E::invalid_value(Unexpected::Unsigned(number), &self))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Self::Value, E> {
        match u64::try_from(number) {
            Ok(number) => self.visit_u64(number),
            Err(_) => Err(E::invalid_value(Unexpected::Signed(number), &self)),
        }
    }

    fn visit_i128<E: Error>(self, number: i128) -> Result<Self::Value, E> {
        let found = number.to_string();
        match u64::try_from(number) {
            Ok(number) => self.visit_u64(number),
            Err(_) => Err(E::invalid_value(Unexpected::Other(&found), &self)),
        }
    }

    fn visit_u128<E: Error>(self, number: u128) -> Result<Self::Value, E> {
        let found = number.to_string();
        match u64::try_from(number) {
            Ok(number) => self.visit_u64(number),
            Err(_) => Err(E::invalid_value(Unexpected::Other(&found), &self)),
        }
    }
}

/// A name that people give: 1 to 100 characters that can be seen or are spaces, with none at the
/// ends.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Name(String);

impl Name {
    /// The longest name, in characters.
    pub const CHARS_MAX: usize = 100;

    /// The name, if it is one.
    ///
    /// # Errors
    ///
    /// With what is wrong with it.
    pub fn new(text: &str) -> Result<Self, &'static str> {
        if text.is_empty() {
            Err("a name cannot be empty")
        } else if text.chars().count() > Self::CHARS_MAX {
            Err("a name can have at most 100 characters")
        } else if text.chars().any(is_invisible) {
            Err("a name cannot have control characters or invisible ones")
        } else if text.trim() != text {
            Err("a name cannot begin or end with a space")
        } else {
            Ok(Self(text.to_owned()))
        }
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The name.
    pub fn into_string(self) -> String {
        self.0
    }
}

/// A path or a pattern of paths: 1 to 4096 bytes without control characters.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FilePath(String);

impl FilePath {
    /// The longest path, in bytes.
    pub const BYTES_MAX: usize = 4096;

    /// The path.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether it is a pattern that may stand for any number of files: it has one of `*?[` in it.
    pub fn is_pattern(&self) -> bool {
        self.0.contains(['*', '?', '['])
    }
}

impl<'de> Deserialize<'de> for FilePath {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        if text.is_empty() {
            Err(D::Error::custom("a path cannot be empty"))
        } else if text.len() > Self::BYTES_MAX {
            Err(D::Error::custom("a path can have at most 4096 bytes"))
        } else if text.contains(char::is_control) {
            Err(D::Error::custom("a path cannot have control characters"))
        } else {
            Ok(Self(text))
        }
    }
}

/// Whether the standard library would escape it anywhere but at the beginning, where it also
/// escapes accents that combine with nothing.
fn is_invisible(character: char) -> bool {
    let text = format!("a{character}");
    !matches!(character, '"' | '\'' | '\\') && text.escape_debug().to_string() != text
}

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::new(&text).map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::super::read;
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Numbers {
        #[serde(default)]
        all: Option<Integer<0, { u64::MAX }>>,
        #[serde(default)]
        some: Option<Integer<1, { u64::MAX }>>,
    }

    #[test]
    fn integers_are_in_their_range_or_are_no_values() {
        let numbers: Numbers = read("all = 18446744073709551615\nsome = 0x10").expect("numbers");
        assert_eq!(numbers.all.map(Integer::get), Some(u64::MAX));
        assert_eq!(numbers.some.map(Integer::get), Some(16));
        for (text, message) in [
            (
                "all = -1",
                "`all`: expected an integer below 2^64, found -1",
            ),
            (
                "all = 18446744073709551616",
                "`all`: expected an integer below 2^64, found 18446744073709551616",
            ),
            (
                "some = 0",
                "`some`: expected an integer of at least 1, found 0",
            ),
            (
                "some = 1.5",
                "`some`: expected an integer of at least 1, found 1.5",
            ),
            (
                "some = \"1\"",
                "`some`: expected an integer of at least 1, found the string \"1\"",
            ),
            (
                "some = true",
                "`some`: expected an integer of at least 1, found true",
            ),
        ] {
            let error = read::<Numbers>(text).expect_err(text);
            assert_eq!(error.message, message);
        }
    }

    #[test]
    fn names_can_be_seen() {
        for name in ["Ann's \"bot\" \\ 1", "Zoë", "Zoe\u{308}", "名前", "🐭"] {
            assert_eq!(Name::new(name).as_ref().map(Name::as_str), Ok(name));
        }
        let long = "x".repeat(Name::CHARS_MAX + 1);
        for name in [
            "",
            " a",
            "a ",
            "a\nb",
            "a\u{1b}b",
            "a\u{202e}b",
            "a\u{200b}b",
            &long,
        ] {
            assert!(Name::new(name).is_err(), "{name:?}");
        }
    }
}
