//! Documents with one changed byte, and documents of contests that did not end.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};

use super::place::place;
use super::*;
use crate::maze::generate::GenSpec;
use crate::robot::bundled::find;
use crate::robot::{HostError, Isolation, Referee, Trust};

/// Bytes that are changed, each in another copy.
const SAMPLES: usize = 2_000;

/// A contest in this process: a robot in two settings, one that uses its seed, one
/// that is refused, two mazes, two seeds.
fn contest(referee: &Referee) -> Contest {
    let rules = *referee.rules();
    let flood = find("flood").expect("a bundled robot").component;
    let random = find("random").expect("a bundled robot").component;
    let robots: [(&str, &[u8], u32); 4] = [
        ("flood", flood, 0),
        ("flood:1", flood, 1),
        ("random", random, 0),
        ("text", b"I am a robot", 0),
    ];
    let entrants = robots.map(|(name, component, setting)| Entrant {
        name: name.to_owned(),
        digest: Digest::of(component),
        setting,
        admission: referee
            .admit(component, Trust::Trusted)
            .expect("the host works")
            .map(Arc::new)
            .map_err(Arc::new),
    });
    let mazes: GenSpec = "gen:division:12:1..=2".parse().expect("a specification");
    Contest {
        entrants: entrants.into(),
        mazes: mazes
            .expand()
            .map(|(name, maze)| ContestMaze::new(name, maze, &rules))
            .collect(),
        seeds: vec![0, 1],
        rules,
    }
}

fn referee() -> Referee {
    Referee::new(Ruleset::default(), 1, None, Isolation::None)
}

fn document(contest: &Contest, played: &Played) -> String {
    let standings = crate::contest::standings(contest, &played.results);
    ContestReport::new(contest, played, &standings).to_json()
}

fn play(contest: &Contest, referee: &Referee) -> Played {
    let nobody = AtomicBool::new(false);
    contest
        .run(referee, 1, &nobody, &|| ())
        .expect("there is a thread")
}

/// What verifying says, line by line; what it needs is taken from `original`, as long
/// as the digests fit.
fn verify(bytes: &[u8], original: &Contest, referee: &Referee) -> Vec<String> {
    let report = match ContestReport::read(bytes) {
        Ok(report) => report,
        Err(error) => return vec![error.to_string()],
    };
    let Some(rules) = Ruleset::by_name(report.ruleset()) else {
        return vec!["ruleset.name: unknown".to_owned()];
    };
    let mut verification = Verification::new(&report);
    let mut contest = Contest {
        entrants: Vec::new(),
        mazes: Vec::new(),
        seeds: report.seeds().to_vec(),
        rules,
    };
    let mut missing = Vec::new();
    for (index, recorded) in report.robots().enumerate() {
        let mut known = original.entrants.iter();
        match known.find(|it| it.digest.hex() == recorded.sha256) {
            Some(entrant) => contest.entrants.push(Entrant {
                name: recorded.name.to_owned(),
                setting: recorded.setting,
                ..entrant.clone()
            }),
            None => missing.push(format!("robots[{index}].sha256: not at hand")),
        }
    }
    for (index, recorded) in report.mazes().enumerate() {
        let mut known = original.mazes.iter();
        match known.find(|it| it.digest.hex() == recorded.sha256) {
            Some(maze) => contest.mazes.push(ContestMaze {
                name: recorded.name.to_owned(),
                ..maze.clone()
            }),
            None => missing.push(format!("mazes[{index}].sha256: not at hand")),
        }
    }
    if missing.is_empty() {
        let schedule = verification.schedule(&contest);
        let nobody = AtomicBool::new(false);
        let played = contest
            .run_only(&schedule.pairings(), referee, 1, &nobody, &|| ())
            .expect("there is a thread");
        let _ = verification.compare(&contest, &schedule, played, bytes);
    }
    let found = verification.differences().kept().iter();
    found.map(ToString::to_string).chain(missing).collect()
}

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
