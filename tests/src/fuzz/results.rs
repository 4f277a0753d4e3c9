//! Recorded results: everything that is not what was recorded is told.

use wasmouse::report::result::fuzz::{contest, document, play, referee, verify};

use super::Target;

pub(super) const TARGET: Target = Target {
    name: "results",
    about: "recorded results, held against the matches played again",
    seeds: || {
        let (whole, interrupted) = documents();
        vec![whole, interrupted]
    },
    words: &[
        b"0",
        b"1",
        b"-1",
        b"1e999",
        b"0.0000000000000000000001",
        b"18446744073709551615",
        b"18446744073709551616",
        b"null",
        b"[]",
        b"{}",
        b"\"\"",
        b"\\u0000",
        b"\\ud800",
        b"\"flood\"",
        b"\"flood:1\"",
        b"\"random\"",
        b"\"finished\"",
        b"\"seeds\"",
        b"\"failed\"",
        b"\n",
        b",\n",
    ],
    bytes_max: 64 << 10,
    make,
    short: 600,
    takes_modules: false,
};

/// A contest that was played to its end, and one that was interrupted.
fn documents() -> (Vec<u8>, Vec<u8>) {
    let referee = referee();
    let contest = contest(&referee);
    let mut played = play(&contest, &referee);
    let whole = document(&contest, &played).into_bytes();
    played.results.truncate(5);
    let interrupted = document(&contest, &played).into_bytes();
    (whole, interrupted)
}

fn make() -> super::Run {
    let (referee, true_documents) = (referee(), documents());
    let contest = contest(&referee);
    Box::new(move |bytes| {
        let told = verify(bytes, &contest, &referee);
        if told.is_empty() {
            let is_true = bytes == true_documents.0 || bytes == true_documents.1;
            assert!(is_true, "a false result is accepted");
        }
        let mut kinds: Vec<&str> = told.iter().map(|line| kind(line)).collect();
        kinds.dedup();
        kinds.truncate(2);
        kinds.join("; ")
    })
}

/// Why a document cannot be read, in the words of the reader.
const REASONS: [&str; 14] = [
    "no UTF-8",
    "key must be",
    "unknown field",
    "missing field",
    "duplicate field",
    "invalid type",
    "invalid value",
    "invalid length",
    "control character",
    "escape",
    "trailing",
    "EOF",
    "number out of range",
    "expected",
];

/// What a line says, without what the input says: of a document that cannot be read the
/// reason, of another the field that differs.
fn kind(line: &str) -> &str {
    if line.starts_with("line ") {
        let reason = REASONS.into_iter().find(|reason| line.contains(reason));
        return reason.unwrap_or("unreadable");
    }
    let (field, _) = line.split_once(": ").unwrap_or((line, ""));
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_.[]".contains(c);
    if field.chars().all(is_plain) {
        field
    } else {
        "other"
    }
}
