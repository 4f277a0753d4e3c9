//! [`Console`]: turns what a program writes into lines of the journal.
//!
//! Programs write in pieces: Go's runtime and Rust's standard error one for each part of a
//! line. So a line is logged when its end is written, and what is left of it when the call
//! of the robot ends, when the program exits, or when it is as long as a line may be.

use crate::excerpt::Excerpt;
use crate::text::{Text, boundary};

/// The longest line; what is longer is continued in another entry of the journal. Unit: bytes.
pub const LINE_BYTES_MAX: usize = 4096;

/// Room for the text of a line in which each byte is invalid and becomes a U+FFFD.
const TEXT_BYTES_MAX: usize = 3 * LINE_BYTES_MAX;

/// Where a program writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Standard output, logged as information.
    Output,
    /// Standard error, logged as errors.
    Error,
}

/// Takes the lines.
pub trait Log {
    /// Writes a line without its end.
    fn line(&mut self, stream: Stream, text: &str);
}

/// Both streams of a program.
#[derive(Debug)]
pub struct Console {
    output: Line,
    error: Line,
    excerpt: Excerpt,
    text: Text<TEXT_BYTES_MAX>,
}

impl Default for Console {
    fn default() -> Self {
        Self::new()
    }
}

impl Console {
    /// A console to which nothing was written.
    pub const fn new() -> Self {
        Self {
            output: Line::new(),
            error: Line::new(),
            excerpt: Excerpt::new(),
            text: Text::new(),
        }
    }

    /// Takes bytes of a stream; they need not be whole lines nor UTF-8.
    pub fn write(&mut self, stream: Stream, bytes: &[u8], log: &mut impl Log) {
        if stream == Stream::Error {
            self.excerpt.add(bytes);
        }
        let mut rest = bytes;
        while let Some(end) = rest.iter().position(|&byte| byte == b'\n') {
            let (line, after) = rest.split_at(end);
            self.add(stream, line, log);
            self.log(stream, log);
            rest = after.get(1..).unwrap_or_default();
        }
        self.add(stream, rest, log);
    }

    /// A call of the robot ends: logs lines that have no end yet, and forgets what
    /// [`exit_message`](Self::exit_message) would quote.
    pub fn end_call(&mut self, log: &mut impl Log) {
        self.flush(log);
        self.excerpt.clear();
    }

    /// Logs lines that have no end yet.
    pub fn flush(&mut self, log: &mut impl Log) {
        for stream in [Stream::Output, Stream::Error] {
            if self.line(stream).length > 0 {
                self.log(stream, log);
            }
        }
    }

    /// The program exits: logs all lines, and returns `exited with code N`, followed by what
    /// this call of the robot has written to standard error.
    pub fn exit_message(&mut self, code: u32, log: &mut impl Log) -> &str {
        self.flush(log);
        self.text.clear();
        self.text.push("exited with code ");
        self.text.push_number(code);
        self.excerpt.append_to(": ", &mut self.text);
        self.text.as_str()
    }

    /// Adds to the line of a stream; logs what is too long for one.
    fn add(&mut self, stream: Stream, bytes: &[u8], log: &mut impl Log) {
        let mut rest = bytes;
        while !rest.is_empty() {
            rest = self.line(stream).fill(rest);
            if !rest.is_empty() {
                self.log(stream, log);
            }
        }
    }

    /// Logs the line of a stream and begins another. A character whose bytes are not all there
    /// in a full line is left for the next one.
    fn log(&mut self, stream: Stream, log: &mut impl Log) {
        let line = match stream {
            Stream::Output => &mut self.output,
            Stream::Error => &mut self.error,
        };
        let bytes = &line.bytes[..line.length];
        let whole = if line.length == LINE_BYTES_MAX {
            boundary(bytes)
        } else {
            bytes.len()
        };
        self.text.clear();
        self.text.push_lossy(&bytes[..whole]);
        log.line(stream, self.text.as_str());
        line.bytes.copy_within(whole..line.length, 0);
        line.length -= whole;
    }

    const fn line(&mut self, stream: Stream) -> &mut Line {
        match stream {
            Stream::Output => &mut self.output,
            Stream::Error => &mut self.error,
        }
    }
}

/// The beginning of a line.
#[derive(Debug)]
struct Line {
    bytes: [u8; LINE_BYTES_MAX],
    length: usize,
}

impl Line {
    const fn new() -> Self {
        Self {
            bytes: [0; LINE_BYTES_MAX],
            length: 0,
        }
    }

    /// Takes as many bytes as there is room for, and returns the others.
    fn fill<'a>(&mut self, bytes: &'a [u8]) -> &'a [u8] {
        let taken = bytes.len().min(LINE_BYTES_MAX - self.length);
        let (taken, rest) = bytes.split_at(taken);
        self.bytes[self.length..][..taken.len()].copy_from_slice(taken);
        self.length += taken.len();
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Default)]
    struct Lines(Vec<(Stream, String)>);

    impl Log for Lines {
        fn line(&mut self, stream: Stream, text: &str) {
            self.0.push((stream, text.to_owned()));
        }
    }

    #[track_caller]
    fn check(pieces: &[&[u8]], ended: &[&str], expected: &[&str]) {
        let (mut console, mut lines) = (Console::new(), Lines::default());
        for piece in pieces {
            console.write(Stream::Output, piece, &mut lines);
        }
        let texts = |lines: &Lines| Vec::from_iter(lines.0.iter().map(|(_, it)| it.clone()));
        assert_eq!(texts(&lines), ended);
        console.end_call(&mut lines);
        assert_eq!(texts(&lines), expected);
        console.end_call(&mut lines);
        assert_eq!(texts(&lines), expected);
    }

    #[test]
    fn lines_are_logged_when_they_end() {
        check(&[], &[], &[]);
        check(&[b"a\n"], &["a"], &["a"]);
        check(&[b"a", b"b\nc"], &["ab"], &["ab", "c"]);
        check(&[b"a\n\nb\n"], &["a", "", "b"], &["a", "", "b"]);
        check(&[b"", b"a", b"", b"\n"], &["a"], &["a"]);
    }

    #[test]
    fn invalid_text_becomes_valid() {
        check(&[b"a\xffb\n"], &["a\u{fffd}b"], &["a\u{fffd}b"]);
        // A character in two pieces.
        check(&[b"\xc3", b"\xa4\n"], &["ä"], &["ä"]);
        check(&[b"\xc3"], &[], &["\u{fffd}"]);
    }

    #[test]
    fn long_lines_continue() {
        let long = "x".repeat(LINE_BYTES_MAX);
        check(&[long.as_bytes()], &[], &[&long]);
        check(&[long.as_bytes(), b"\n"], &[&long], &[&long]);
        check(&[long.as_bytes(), b"y\n"], &[&long, "y"], &[&long, "y"]);
        // No character is cut.
        let text = format!("{}ä!", "x".repeat(LINE_BYTES_MAX - 1));
        let (first, second) = text.split_at(LINE_BYTES_MAX - 1);
        check(&[text.as_bytes()], &[first], &[first, second]);
        let invalid = vec![0xff; LINE_BYTES_MAX];
        let shown = "\u{fffd}".repeat(LINE_BYTES_MAX);
        check(&[&invalid, b"\n"], &[&shown], &[&shown]);
    }

    #[test]
    fn both_streams_have_their_own_line() {
        let (mut console, mut lines) = (Console::new(), Lines::default());
        console.write(Stream::Output, b"a", &mut lines);
        console.write(Stream::Error, b"b", &mut lines);
        console.write(Stream::Output, b"c\n", &mut lines);
        console.end_call(&mut lines);
        let expected = [(Stream::Output, "ac".into()), (Stream::Error, "b".into())];
        assert_eq!(lines.0, expected);
    }

    #[test]
    fn exit_quotes_the_errors_of_the_call() {
        let (mut console, mut lines) = (Console::new(), Lines::default());
        console.write(Stream::Output, b"out\n", &mut lines);
        assert_eq!(console.exit_message(0, &mut lines), "exited with code 0");
        console.write(Stream::Error, b"old\n", &mut lines);
        console.end_call(&mut lines);
        console.write(Stream::Error, b"panic: ", &mut lines);
        console.write(Stream::Error, b"boom\n\nmain.go:3\n\n", &mut lines);
        console.write(Stream::Output, b"partial", &mut lines);
        let message = console.exit_message(2, &mut lines);
        assert_eq!(message, "exited with code 2: panic: boom\n\nmain.go:3");
        assert_eq!(lines.0.last(), Some(&(Stream::Output, "partial".into())));
    }
}
