//! A door for fuzzing and for tests: what any bytes do to who verifies them.
//!
//! Hidden from the documentation and used by the tests alone.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::{ContestReport, Verification};
use crate::contest::{Contest, ContestMaze, Entrant, Played, standings};
use crate::maze::generate::GenSpec;
use crate::robot::bundled::find;
use crate::robot::{Digest, Isolation, Referee, Trust};
use crate::sim::Ruleset;

/// A contest in this process, on that referee: a robot in two settings, one that uses its seed, one
/// that is refused, two mazes, two seeds.
///
/// # Panics
///
/// When the host fails.
pub fn contest(referee: &Referee) -> Contest {
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

/// A referee that trusts all robots, with the default rules.
pub fn referee() -> Referee {
    Referee::new(Ruleset::default(), 1, None, Isolation::None)
}

/// What is recorded of a contest.
pub fn document(contest: &Contest, played: &Played) -> String {
    let ranked = standings(contest, &played.results);
    ContestReport::new(contest, played, &ranked).to_json()
}

/// Plays a contest.
///
/// # Panics
///
/// When there is no thread for it.
pub fn play(contest: &Contest, referee: &Referee) -> Played {
    let nobody = AtomicBool::new(false);
    contest
        .run(referee, 1, &nobody, &|| ())
        .expect("there is a thread")
}

/// What verifying says, line by line; what it needs is taken from `original`, as long
/// as the digests fit.
///
/// # Panics
///
/// When there is no thread for it, or there is a mistake in verifying.
pub fn verify(bytes: &[u8], original: &Contest, referee: &Referee) -> Vec<String> {
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
