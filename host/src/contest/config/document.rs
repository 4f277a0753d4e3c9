//! [`Document`]: a configuration file that is TOML, with the places of its values.

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, Deserializer};

use super::error::ConfigError;
use super::explain::explain;
use super::place::{key_at, span_of};

/// The most bytes that a configuration file may have: 1 MiB.
pub const BYTES_MAX: usize = 1 << 20;

/// A TOML document with the places of its values.
pub struct Document<'a> {
    text: &'a str,
    root: Spanned<DeTable<'a>>,
}

/// Reads a value from the text of a configuration file.
///
/// The value's type should deny unknown fields; [`Integer`](super::Integer) and
/// [`Name`](super::Name) are types for its fields.
///
/// # Errors
///
/// With the first thing that is wrong.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, ConfigError> {
    Document::parse(text)?.read()
}

/// The text of a configuration file: its bytes as UTF-8, without the byte order mark that some
/// editors write.
///
/// # Errors
///
/// When there are more than [`BYTES_MAX`] bytes, or they are not UTF-8.
pub fn decode(bytes: &[u8]) -> Result<&str, ConfigError> {
    let whole = |message: String| ConfigError::new("", 0..0, String::new(), message);
    if bytes.len() > BYTES_MAX {
        let message = format!("the file has more than {BYTES_MAX} bytes");
        return Err(whole(message));
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        let message = "expected UTF-8, found UTF-16".to_owned();
        return Err(whole(message).hint("save the file as UTF-8"));
    }
    match str::from_utf8(bytes) {
        Ok(text) => Ok(text.strip_prefix('\u{feff}').unwrap_or(text)),
        Err(error) => {
            let valid = error.valid_up_to();
            let message = format!("expected UTF-8, found the byte 0x{:02x}", bytes[valid]);
            let text = String::from_utf8_lossy(&bytes[..valid]);
            let error = ConfigError::new(&text, valid..valid, String::new(), message);
            Err(error.hint("save the file as UTF-8"))
        }
    }
}

impl<'a> Document<'a> {
    /// Parses a text as TOML.
    ///
    /// # Errors
    ///
    /// When it is too long or no TOML.
    pub fn parse(text: &'a str) -> Result<Self, ConfigError> {
        decode(text.as_bytes())?;
        match DeTable::parse(text) {
            Ok(root) => Ok(Self { text, root }),
            Err(error) => {
                let span = error.span().unwrap_or(0..0);
                let message = format!("invalid TOML: {}", error.message().to_lowercase());
                Err(ConfigError::new(text, span, String::new(), message))
            }
        }
    }

    /// Makes a value of it.
    ///
    /// # Errors
    ///
    /// With the first thing that the value's type does not accept.
    pub fn read<T: DeserializeOwned>(&self) -> Result<T, ConfigError> {
        T::deserialize(Deserializer::from(self.root.clone())).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            let key = key_at(self.root.get_ref(), &span);
            let (mut message, hint) = explain(error.message(), &key);
            // For serde, a date is a table of a secret kind. No other value begins with a digit and
            // is called a table.
            let value = self.text.get(span.clone()).unwrap_or_default();
            if value.starts_with(|it: char| it.is_ascii_digit())
                && let Some(start) = message.strip_suffix("found a table")
            {
                message = format!("{start}found a date or a time");
            }
            let error = ConfigError::new(self.text, span, key, message);
            ConfigError { hint, ..error }
        })
    }

    /// An error at the value of a key, such as `robots[0].path` with elements counted from 0. For
    /// a key that is missing, it is at the table that it should be in.
    pub fn error(&self, key: &str, message: impl Into<String>) -> ConfigError {
        let span = span_of(&self.root, key);
        ConfigError::new(self.text, span, key.to_owned(), message.into())
    }

    /// The line of a key's value, counted from 1.
    pub fn line(&self, key: &str) -> usize {
        self.error(key, "").line
    }

    /// Whether the file has a key at its top.
    pub fn has(&self, key: &str) -> bool {
        self.root.get_ref().contains_key(key)
    }
}
