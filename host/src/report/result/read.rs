//! Reading a contest's JSON: strictly, with the place of whatever is wrong.
//!
//! Names and values are only read here; whether they are true is for
//! [`Verification`](super::Verification) to say.

use serde::Deserialize;

use super::super::visible;
use super::place::{Place, offset, place};
use super::{ContestReport, SCHEMA};

/// Why a text is no document of a contest.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// It was written by a version of wasmouse that writes other documents.
    #[error("schema: expected {SCHEMA}, which this version reads, found {found}")]
    Schema {
        /// The schema of the text.
        found: u64,
    },
    /// It is no JSON, or not the JSON of a contest.
    #[error("line {line}, column {column}{}: {reason}", in_field(field))]
    Text {
        /// Counted from 1.
        line: usize,
        /// In bytes, counted from 1.
        column: usize,
        /// The field, such as `matches[17].score`; may be empty.
        field: String,
        /// What is wrong, without characters that could play with a terminal.
        reason: String,
    },
}

fn in_field(field: &str) -> String {
    if field.is_empty() {
        String::new()
    } else {
        format!(", in `{field}`")
    }
}

/// What can be known of a document of any schema.
#[derive(Deserialize)]
struct AnySchema {
    schema: u64,
}

/// A robot as a document names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedRobot<'a> {
    /// The name in results.
    pub name: &'a str,
    /// The digest of its file: 64 lowercase hexadecimal digits, if nobody changed it.
    pub sha256: &'a str,
    /// The variant.
    pub setting: u32,
}

/// A maze as a document names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedMaze<'a> {
    /// The name in results.
    pub name: &'a str,
    /// The digest of the maze: 64 lowercase hexadecimal digits, if nobody changed it.
    pub sha256: &'a str,
}

impl<'a> ContestReport<'a> {
    /// Reads a document.
    ///
    /// # Errors
    ///
    /// When it has another schema, or is not exactly of this form: fields that are
    /// missing, unknown or of another type are named.
    ///
    /// ```
    /// use wasmouse::report::result::ContestReport;
    ///
    /// let error = ContestReport::read(br#"{"schema": 1, "engine": 7}"#);
    /// assert_eq!(
    ///     error.expect_err("a number").to_string(),
    ///     "line 1, column 25, in `engine`: \
    ///      invalid type: integer `7`, expected a string"
    /// );
    /// ```
    pub fn read(bytes: &'a [u8]) -> Result<Self, ReadError> {
        let text = str::from_utf8(bytes).map_err(|error| {
            let place = place(bytes, error.valid_up_to());
            ReadError::new(place, "no UTF-8 character begins here".to_owned())
        })?;
        if let Ok(AnySchema { schema: found }) = serde_json::from_str(text)
            && found != u64::from(SCHEMA)
        {
            return Err(ReadError::Schema { found });
        }
        serde_json::from_str(text).map_err(|error| {
            let at = offset(bytes, error.line(), error.column());
            ReadError::new(place(bytes, at), reason(&error))
        })
    }

    /// The name of the ruleset.
    pub fn ruleset(&self) -> &str {
        &self.ruleset.name
    }

    /// The robots, in their order.
    pub fn robots(&self) -> impl ExactSizeIterator<Item = RecordedRobot<'_>> {
        self.robots.iter().map(|robot| RecordedRobot {
            name: &robot.name,
            sha256: &robot.sha256,
            setting: robot.setting,
        })
    }

    /// The mazes, in their order.
    pub fn mazes(&self) -> impl ExactSizeIterator<Item = RecordedMaze<'_>> {
        self.mazes.iter().map(|maze| RecordedMaze {
            name: &maze.name,
            sha256: &maze.sha256,
        })
    }

    /// The seeds, in their order.
    pub fn seeds(&self) -> &[u64] {
        &self.seeds
    }

    /// How many matches have a result.
    pub const fn matches(&self) -> usize {
        self.matches.len()
    }

    /// How many matches the contest had, as the document says who was refused.
    pub fn matches_expected(&self) -> u128 {
        let admitted = self.robots.iter().filter(|it| it.refusal.is_none());
        admitted.count() as u128 * self.mazes.len() as u128 * self.seeds.len() as u128
    }
}

impl ReadError {
    fn new(place: Place, reason: String) -> Self {
        Self::Text {
            line: place.line,
            column: place.column,
            field: place.path,
            reason,
        }
    }
}

/// The reason without the place, which serde writes behind it.
fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    visible(text.strip_suffix(&place).unwrap_or(&text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_documents_are_named_with_the_place() {
        let bad: [(&[u8], &str); 8] = [
            (b"", "line 1, column 1: EOF while parsing a value"),
            (
                b"[]",
                "line 1, column 2: invalid length 0, expected the JSON of a contest",
            ),
            (
                b"{\"schema\": 2, \"news\": 0}",
                "schema: expected 1, which this version reads, found 2",
            ),
            (
                b"{\"schema\": \"1\"}",
                "line 1, column 14, in `schema`: invalid type: string \"1\", expected u32",
            ),
            (
                b"{\"schema\": 1,\n \"robots\": [{\"nume\": 0}]}",
                "line 2, column 19, in `robots[0].nume`: unknown field `nume`, \
                 expected one of `name`, `sha256`, `setting`, `refusal`",
            ),
            (
                b"{\"schema\": 1, \"\x1b[31m\": 0}",
                "line 1, column 16, in `\\u{1b}[31m`: \
                 control character (\\u0000-\\u001F) found while parsing a string",
            ),
            (
                b"{\"schema\": 1, \"schema\": 1}",
                "line 1, column 22, in `schema`: duplicate field `schema`",
            ),
            (
                b"{\"seeds\": [1, \xff]}",
                "line 1, column 15, in `seeds[1]`: no UTF-8 character begins here",
            ),
        ];
        let read = |text| {
            ContestReport::read(text)
                .expect_err("no document")
                .to_string()
        };
        let found: Vec<String> = bad.iter().map(|&(text, _)| read(text)).collect();
        assert_eq!(found, bad.map(|(_, expected)| expected));
        let deep = format!("{{\"schema\": {}", "[".repeat(100_000));
        let error = ContestReport::read(deep.as_bytes()).expect_err("too deep");
        assert!(error.to_string().contains("schema"), "{error}");
    }
}
