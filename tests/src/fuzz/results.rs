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
        // The kinds of places, without the values: the rest is the input.
        let places = told.iter().map(|line| {
            let end = line.find(": ").unwrap_or(line.len()).min(60);
            line.get(..end).unwrap_or_default()
        });
        let mut places: Vec<&str> = places.collect();
        places.dedup();
        places.truncate(4);
        places.join("; ")
    })
}
