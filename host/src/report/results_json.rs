//! The results document: [`ResultsWriter`] writes it match by match, [`read_results`] reads it
//! back.
//!
//! The document is [`Results`] as JSON; `host/schema/results.schema.json` describes it. The
//! contest and the summary are indented, and each match has a line of its own, so that two
//! documents can be compared line by line.

use std::io;

use serde::Deserialize;
use wasmouse_core::record::MatchRecord;

use super::{escape, json};
use crate::contest::{ContestInfo, ContestMatch, RESULTS_VERSION, Results, Sink, Summary};

/// Writes a results document while the contest is played.
///
/// What has been written is a document only after [`ResultsWriter::finish`].
#[derive(Debug)]
pub struct ResultsWriter<W> {
    out: W,
    has_matches: bool,
}

impl<W: io::Write> ResultsWriter<W> {
    /// Writes everything that comes before the matches to `out`, which should be buffered.
    ///
    /// # Errors
    ///
    /// When writing fails.
    pub fn new(mut out: W, contest: &ContestInfo) -> io::Result<Self> {
        write!(
            out,
            "{{\n  \"version\": {RESULTS_VERSION},\n  \"contest\": {},\n  \"matches\": [",
            nested(&json::pretty(contest))
        )?;
        Ok(Self {
            out,
            has_matches: false,
        })
    }

    /// Writes the next match.
    ///
    /// # Errors
    ///
    /// When writing fails.
    pub fn record(&mut self, record: &MatchRecord) -> io::Result<()> {
        let comma = if self.has_matches { "," } else { "" };
        self.has_matches = true;
        write!(self.out, "{comma}\n    {}", json::line(record))
    }

    /// Writes everything that comes after the matches, flushes the output and returns it.
    ///
    /// # Errors
    ///
    /// When writing fails.
    pub fn finish(mut self, summary: &Summary) -> io::Result<W> {
        let end = if self.has_matches { "\n  " } else { "" };
        let summary = nested(&json::pretty(summary));
        write!(self.out, "{end}],\n  \"summary\": {summary}\n}}\n")?;
        self.out.flush()?;
        Ok(self.out)
    }
}

impl<W: io::Write + Send> Sink for ResultsWriter<W> {
    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        self.record(&played.record)
    }
}

/// Writes a whole results document: the same bytes as [`ResultsWriter`] match by match.
///
/// # Errors
///
/// When writing fails.
pub fn write_results<W: io::Write>(results: &Results, out: W) -> io::Result<W> {
    let mut writer = ResultsWriter::new(out, &results.contest)?;
    for record in &results.matches {
        writer.record(record)?;
    }
    writer.finish(&results.summary)
}

/// Indented JSON as a value inside an object. Line breaks are only between values.
fn nested(json: &str) -> String {
    json.replace('\n', "\n  ")
}

/// Why bytes are not a results document that can be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// Another version of the document, usually of another version of wasmouse.
    #[error(
        "expected version {RESULTS_VERSION} of the results document, found version {found}{}",
        writer(wasmouse.as_ref())
    )]
    Version {
        /// The version of the document.
        found: u64,
        /// The version of wasmouse that wrote it, escaped for terminals; `None` when the
        /// document does not say.
        wasmouse: Option<String>,
    },
    /// Not JSON, or JSON of something else.
    #[error("line {line}, column {column}: {reason}")]
    Text {
        /// Counted from 1.
        line: usize,
        /// In bytes, counted from 1; 0 before the first byte of a line.
        column: usize,
        /// What was expected and what was found, escaped for terminals.
        reason: String,
    },
}

impl ReadError {
    /// What to do.
    pub const fn hint(&self) -> &'static str {
        match self {
            Self::Version { .. } => "use the version of wasmouse that wrote the document",
            Self::Text { .. } => "pass the output of `wasmouse run --json`",
        }
    }
}

fn writer(wasmouse: Option<&String>) -> String {
    wasmouse.map_or_else(String::new, |it| format!(", written by wasmouse {it}"))
}

/// The parts of a document of any version that say which version it is. Version 1 called its
/// number `schema`.
#[derive(Deserialize)]
struct AnyVersion {
    #[serde(alias = "schema")]
    version: u64,
    wasmouse: Option<String>,
    contest: Option<AnyContest>,
}

#[derive(Deserialize)]
struct AnyContest {
    wasmouse: Option<String>,
}

/// Reads a results document. White space and the order of fields do not matter; unknown and
/// missing fields are errors.
///
/// # Errors
///
/// When the bytes are not a results document of version [`RESULTS_VERSION`].
///
/// ```
/// use wasmouse::report::results_json::read_results;
///
/// let error = read_results(br#"{"version": 3, "contest": {"wasmouse": "0.9.0"}}"#);
/// assert_eq!(
///     error.expect_err("another version").to_string(),
///     "expected version 2 of the results document, found version 3, written by wasmouse 0.9.0"
/// );
/// ```
pub fn read_results(bytes: &[u8]) -> Result<Results, ReadError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let results = serde_json::from_slice::<Results>(bytes);
    match results {
        Ok(results) if results.version == RESULTS_VERSION => Ok(results),
        Ok(results) => Err(ReadError::Version {
            found: results.version.into(),
            wasmouse: Some(escape::for_terminal(&results.contest.wasmouse)),
        }),
        Err(error) => Err(other_version(bytes).unwrap_or_else(|| text_error(&error))),
    }
}

/// The error of a document that says that it has another version.
fn other_version(bytes: &[u8]) -> Option<ReadError> {
    let any: AnyVersion = serde_json::from_slice(bytes).ok()?;
    let wasmouse = any.contest.and_then(|it| it.wasmouse).or(any.wasmouse);
    (any.version != u64::from(RESULTS_VERSION)).then(|| ReadError::Version {
        found: any.version,
        wasmouse: wasmouse.map(|it| escape::for_terminal(&it)),
    })
}

fn text_error(error: &serde_json::Error) -> ReadError {
    let (line, column) = (error.line(), error.column());
    let text = error.to_string();
    // serde writes the place after the reason.
    let place = format!(" at line {line} column {column}");
    ReadError::Text {
        line,
        column,
        reason: escape::for_terminal(text.strip_suffix(&place).unwrap_or(&text)),
    }
}
