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
/// What has been written is a document only after [`ResultsWriter::finish`]. Nothing is written
/// before the first match, so that a contest that cannot begin leaves no part of a document.
#[derive(Debug)]
pub struct ResultsWriter<W> {
    out: W,
    /// What comes before the matches, until it is written.
    head: Option<String>,
}

impl<W: io::Write> ResultsWriter<W> {
    /// Writes to `out`, which should be buffered.
    pub fn new(out: W, contest: &ContestInfo) -> Self {
        let contest = nested(&json::pretty(contest));
        Self {
            out,
            head: Some(format!(
                "{{\n  \"version\": {RESULTS_VERSION},\n  \"contest\": {contest},\n  \"matches\": ["
            )),
        }
    }

    /// Writes the next match.
    ///
    /// # Errors
    ///
    /// When writing fails.
    pub fn record(&mut self, record: &MatchRecord) -> io::Result<()> {
        let before = self.head.take().unwrap_or_else(|| ",".to_owned());
        write!(self.out, "{before}\n    {}", json::line(record))
    }

    /// Writes everything that comes after the matches, flushes the output and returns it.
    ///
    /// # Errors
    ///
    /// When writing fails.
    pub fn finish(mut self, summary: &Summary) -> io::Result<W> {
        let before = self.head.take().unwrap_or_else(|| "\n  ".to_owned());
        let summary = nested(&json::pretty(summary));
        write!(self.out, "{before}],\n  \"summary\": {summary}\n}}\n")?;
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
    let mut writer = ResultsWriter::new(out, &results.contest);
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

/// Reads a results document. White space and the order of fields do not matter. Unknown and
/// missing fields are errors, except that a missing field that may be null is null.
///
/// # Errors
///
/// When the bytes are not a results document of version [`RESULTS_VERSION`].
///
/// ```
/// use wasmouse::report::results_json::read_results;
///
/// let error = read_results(br#"{"version": 9, "contest": {"wasmouse": "0.9.0"}}"#);
/// assert_eq!(
///     error.expect_err("another version").to_string(),
///     "expected version 4 of the results document, found version 9, written by wasmouse 0.9.0"
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
        Err(error) => Err(other_version(bytes).unwrap_or_else(|| text_error(bytes, &error))),
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

fn text_error(bytes: &[u8], error: &serde_json::Error) -> ReadError {
    let (line, column) = (error.line(), error.column());
    let text = error.to_string();
    // serde writes the place after the reason.
    let place = format!(" at line {line} column {column}");
    let reason = if bytes.trim_ascii_start().starts_with(b"{") {
        escape::for_terminal(text.strip_suffix(&place).unwrap_or(&text))
    } else {
        "expected a results document, which is a JSON object".to_owned()
    };
    ReadError::Text {
        line,
        column,
        reason,
    }
}

#[cfg(test)]
mod tests {
    use wasmouse_core::record::Transcript;

    use super::super::sample::{HOSTILE, results};
    use super::*;

    fn written(results: &Results) -> String {
        let bytes = write_results(results, Vec::new()).expect("memory takes everything");
        String::from_utf8(bytes).expect("JSON is UTF-8")
    }

    #[test]
    fn what_is_streamed_is_read_back() {
        let mut results = results();
        for matches in [results.matches.clone(), Vec::new()] {
            results.matches = matches;
            let text = written(&results);
            let mut streamed = Vec::new();
            let mut writer = ResultsWriter::new(&mut streamed, &results.contest);
            for record in &results.matches {
                let played = writer.played(&ContestMatch {
                    player: 0,
                    record: record.clone(),
                    transcript: Transcript::default(),
                });
                played.expect("memory takes everything");
            }
            let finished = writer.finish(&results.summary);
            finished.expect("memory takes everything");
            assert_eq!(streamed, text.as_bytes());
            assert_eq!(read_results(text.as_bytes()), Ok(results.clone()));
            let one_per_line =
                |line: &&str| line.trim_start().starts_with("{\"version\":2,\"key\":");
            let lines = text.lines().filter(one_per_line).count();
            assert_eq!(lines, results.matches.len());
        }
    }

    #[test]
    fn nothing_is_written_before_the_first_match() {
        let results = results();
        let mut written = Vec::new();
        drop(ResultsWriter::new(&mut written, &results.contest));
        assert!(written.is_empty(), "{written:?}");
        let mut writer = ResultsWriter::new(&mut written, &results.contest);
        let recorded = writer.record(&results.matches[0]);
        recorded.expect("memory takes everything");
        assert!(!written.is_empty());
    }

    #[test]
    fn the_layout_is_that_of_an_indented_document() {
        let mut results = results();
        results.matches.clear();
        let text = written(&results);
        let harmful = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
        assert!(!text.contains(harmful), "{text:?}");
        assert!(text.contains('\u{1f9ff}'), "visible characters stay");
        let pretty = json::document(&results);
        assert_eq!(text, pretty);
    }

    #[test]
    fn other_layouts_of_the_same_values_are_read() {
        let expected = results();
        let text = written(&expected);
        let value: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
        let serde_json::Value::Object(fields) = &value else {
            panic!("a document is an object")
        };
        let reversed: Vec<String> = fields
            .iter()
            .rev()
            .map(|(name, value)| format!("\"{name}\": {value}"))
            .collect();
        for other in [
            text.replace('\n', "\r\n"),
            text.replace('\n', "\n\t"),
            format!("\u{feff}{text}"),
            serde_json::to_string(&value).expect("it was JSON"),
            serde_json::to_string_pretty(&value).expect("it was JSON"),
            format!("{{{}}}", reversed.join(",\n")),
        ] {
            assert_eq!(read_results(other.as_bytes()).as_ref(), Ok(&expected));
        }
    }

    #[track_caller]
    fn check_error(text: &str, expected: &str) {
        let error = read_results(text.as_bytes()).expect_err("no results document");
        assert_eq!(error.to_string(), expected);
        assert!(!error.hint().is_empty());
    }

    #[test]
    fn errors_say_where_and_what_was_expected() {
        let no_object = "expected a results document, which is a JSON object";
        check_error("", &format!("line 1, column 0: {no_object}"));
        check_error("[1]", &format!("line 1, column 3: {no_object}"));
        check_error("\nname,score", &format!("line 2, column 2: {no_object}"));
        check_error(
            "{\"version\": 4",
            "line 1, column 13: EOF while parsing an object",
        );
        check_error(
            "{\"schema\": 1, \"wasmouse\": \"0.1.0\"}",
            "expected version 4 of the results document, found version 1, \
             written by wasmouse 0.1.0",
        );
        check_error(
            "{\"version\": 7}",
            "expected version 4 of the results document, found version 7",
        );
        check_error(
            "{\"version\": 4,\n \"contest\": {\"wasmouse\": \"\\u001b\", \"engine\": 7}}",
            "line 2, column 46: invalid type: integer `7`, expected a string",
        );
        check_error(
            "{\"version\": 4, \"\\u001b[31m\": 0}",
            "line 1, column 27: unknown field `\\u{1b}[31m`, \
             expected one of `version`, `contest`, `matches`, `summary`",
        );
        let text = written(&results());
        let twice = text.replacen("\"matches\":", "\"version\": 4, \"matches\":", 1);
        let error = read_results(twice.as_bytes()).expect_err("a field is there twice");
        assert!(
            error.to_string().ends_with(": duplicate field `version`"),
            "{error}"
        );
        let deep = "[".repeat(100_000);
        read_results(deep.as_bytes()).expect_err("lists in lists");
    }

    #[test]
    fn a_document_of_another_version_is_named_with_its_writer() {
        let mut results = results();
        results.contest.wasmouse = HOSTILE.to_owned();
        let text = written(&results).replacen("\"version\": 4", "\"version\": 5", 1);
        assert_eq!(
            read_results(text.as_bytes()),
            Err(ReadError::Version {
                found: 5,
                wasmouse: Some(escape::for_terminal(HOSTILE)),
            })
        );
    }
}
