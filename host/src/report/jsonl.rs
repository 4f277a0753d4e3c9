//! [`JsonLines`]: matches as JSON Lines, each as soon as it has been played.

use std::io;

use wasmouse_core::record::MatchRecord;

use super::json;
use crate::contest::{ContestMatch, Sink};

/// Writes one [`MatchRecord`] a line, in its serialised
/// form. Matches that the host could not play have no record and no line.
#[derive(Debug)]
pub struct JsonLines<W>(W);

impl<W: io::Write> JsonLines<W> {
    /// Writes to `out`, which should be buffered.
    pub const fn new(out: W) -> Self {
        Self(out)
    }

    /// Flushes the output and returns it.
    ///
    /// # Errors
    ///
    /// When flushing fails.
    pub fn finish(mut self) -> io::Result<W> {
        self.0.flush()?;
        Ok(self.0)
    }
}

impl<W: io::Write + Send> Sink for JsonLines<W> {
    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        self.0.write_all(record_line(&played.record).as_bytes())
    }
}

/// A record as a line, with its end, escaped for terminals.
pub fn record_line(record: &MatchRecord) -> String {
    let mut line = json::line(record);
    line.push('\n');
    line
}

#[cfg(test)]
mod tests {
    use wasmouse_core::record::Transcript;

    use super::super::sample::results;
    use super::*;

    #[test]
    fn every_match_has_a_line() {
        let records = results().matches;
        let mut lines = JsonLines::new(Vec::new());
        for record in &records {
            let (record, transcript) = (record.clone(), Transcript::default());
            let played = ContestMatch {
                player: 0,
                record,
                transcript,
            };
            lines.played(&played).expect("memory takes everything");
        }
        let bytes = lines.finish().expect("memory takes everything");
        let text = String::from_utf8(bytes).expect("JSON is UTF-8");
        assert!(text.ends_with('\n') && !text.contains(['\u{1b}', '\u{2028}']));
        let read = text.lines().map(serde_json::from_str);
        let read: Vec<MatchRecord> = read.collect::<Result<_, _>>().expect("records");
        assert_eq!(read, records);
    }
}
