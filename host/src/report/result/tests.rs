//! Documents with one changed byte, and documents of contests that did not end.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};

use super::fuzz::{contest, document, play, referee, verify};
use super::place::place;
use super::*;
use crate::robot::HostError;

/// Bytes that are changed, each in another copy.
const SAMPLES: usize = 2_000;

#[test]
fn any_changed_byte_is_named() {
    let referee = referee();
    let contest = contest(&referee);
    let text = document(&contest, &play(&contest, &referee));
    assert_eq!(verify(text.as_bytes(), &contest, &referee), [""; 0]);

    let mut random = ChaCha8Rng::seed_from_u64(4);
    let mut below = |end: usize| random.next_u64() as usize % end;
    for _ in 0..SAMPLES {
        let mut bytes = text.clone().into_bytes();
        let at = below(bytes.len());
        let old = bytes[at];
        // Mostly changes that leave it a document: digits and letters for others.
        let (first, last) = match below(8) {
            0 => (0, u8::MAX),
            1 => (b' ', b'~'),
            _ if old.is_ascii_digit() => (b'0', b'9'),
            _ => (b'a', b'z'),
        };
        bytes[at] = first + below(usize::from(last - first) + 1) as u8;
        if bytes[at] == old {
            continue;
        }
        let changed = place(text.as_bytes(), at);
        let told = verify(&bytes, &contest, &referee);
        let names_field = |line: &String| line.contains(&changed.path);
        // Broken JSON may only show in the line behind.
        let names_line = |line: &String| {
            (changed.line..=changed.line + 1).any(|it| line.starts_with(&format!("line {it}, ")))
        };
        assert!(
            told.iter()
                .any(|line| names_field(line) || names_line(line)),
            "byte {at} was {:?}, is {:?}, in {changed:?}: {told:#?}",
            char::from(old),
            char::from(bytes[at]),
        );
    }
}

/// Every byte that is left out, and every line that is there twice.
#[test]
fn cut_and_grown_documents_are_never_verified() {
    let referee = referee();
    let contest = contest(&referee);
    let text = document(&contest, &play(&contest, &referee));
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    for index in 0..lines.len() {
        let mut without = lines.clone();
        without.remove(index);
        let mut doubled = lines.clone();
        doubled.insert(index, lines[index]);
        for other in [without.concat(), doubled.concat()] {
            let told = verify(other.as_bytes(), &contest, &referee);
            assert!(!told.is_empty(), "line {index}: {other}");
        }
    }
    for end in (0..text.len()).step_by(97) {
        let told = verify(&text.as_bytes()[..end], &contest, &referee);
        assert!(!told.is_empty(), "cut at {end}");
    }
}

/// An interrupted contest is verified as far as it got, and a failure of the host is
/// one that has to come again.
#[test]
fn contests_that_did_not_end() {
    let referee = referee();
    let mut contest = contest(&referee);
    // The same maze twice has one name.
    contest.mazes.push(contest.mazes[0].clone());
    let mut played = play(&contest, &referee);
    let mut index = 0;
    played.results.retain(|_| {
        index += 1;
        index % 3 != 1
    });
    let text = document(&contest, &played);
    assert!(text.contains("\"complete\": false"));
    assert_eq!(verify(text.as_bytes(), &contest, &referee), [""; 0]);

    let late = text.replace("\"seeds\": [\n    0,", "\"seeds\": [\n    7,");
    let told = verify(late.as_bytes(), &contest, &referee);
    assert!(told[0].starts_with("matches["), "{told:#?}");

    let removed = played.results.remove(5).pairing();
    played.failed.push(FailedMatch {
        entrant: removed.entrant,
        maze: removed.maze,
        seed: removed.seed,
        error: HostError::Stalled,
    });
    let text = document(&contest, &played);
    let told = verify(text.as_bytes(), &contest, &referee);
    assert_eq!(told.len(), 1, "{told:#?}");
    assert!(told[0].starts_with("failed[0]: recorded "), "{told:#?}");
    assert!(
        told[0].contains(", played \"finished\" (`flood"),
        "{told:#?}"
    );
}

/// The digest is that of the text without it.
#[test]
fn the_digest_can_be_made_again() {
    let referee = referee();
    let contest = contest(&referee);
    let text = document(&contest, &Played::default());
    let (before, digest) = text
        .trim_end()
        .trim_end_matches(['}', '\n', '"'])
        .rsplit_once('"')
        .expect("the last field");
    let without = format!("{before}\"\"\n}}\n");
    assert_eq!(digest, Digest::of(without.as_bytes()).hex());
}
