//! `wasmouse run --twice`: all matches once more, with as little in common with the
//! first time as possible.
//!
//! The second time has its own engine and workers, robots that are read and compiled
//! anew, another number of threads, and the matches from the last to the first.

use std::sync::atomic::Ordering;

use super::exit::Exit;
use super::failure::Failure;
use super::robots::{self, Specification};
use super::setup::{IsolationArgs, independent_referee};
use super::{interrupt, run};
use crate::contest::{Contest, Played, standings};
use crate::report::result::{ContestReport, Verification};

/// Differences that a message lists.
const LISTED_MAX: usize = 20;

/// Plays a contest a second time. Interrupted when it did not get to the end; what
/// it got to was the same then.
///
/// # Errors
///
/// When anything is not the same.
pub fn check(
    contest: &Contest,
    played: &Played,
    specifications: &[Specification],
    threads: usize,
    isolation: &IsolationArgs,
) -> Result<Exit, Failure> {
    let is_interrupted = || Ok(interrupt::listen()?.load(Ordering::Relaxed));
    if is_interrupted()? {
        return Ok(Exit::Interrupted);
    }
    let threads = if threads > 1 { threads - 1 } else { 2 };
    let referee = independent_referee(contest.rules, threads, isolation)?;
    let again = Contest {
        entrants: robots::load(specifications, &referee)?,
        mazes: contest.mazes.clone(),
        seeds: contest.seeds.clone(),
        rules: contest.rules,
    };
    let lines = standings(contest, &played.results);
    let first = ContestReport::new(contest, played, &lines);
    let mut verification = Verification::new(&first);
    let schedule = verification.schedule(&again);
    let mut pairings = schedule.pairings();
    pairings.reverse();
    let mut second = run::play_only(&again, &pairings, &referee, threads)?;
    second.results.reverse();
    second.failed.reverse();
    let bytes = first.to_json().into_bytes();
    let unplayed = verification.compare(&again, &schedule, second, &bytes);
    let differences = verification.differences();
    if differences.count() > 0 {
        let told = differences.kept().iter().take(LISTED_MAX);
        let mut message = "the same contest played twice was not the same:".to_owned();
        for difference in told {
            message.push_str(&format!("\n  {}", difference.told("first", "then")));
        }
        if differences.count() > LISTED_MAX {
            let rest = differences.count() - LISTED_MAX;
            message.push_str(&format!("\n  and {rest} more"));
        }
        return Err(Failure::internal(message).hint(
            "a damaged cache of compiled robots (try --no-cache), a faulty machine, or a \
             bug of wasmouse",
        ));
    }
    if let Some(failed) = unplayed.failed.first() {
        let message = format!("a match was not played a second time: {failed}");
        return Err(Failure::internal(message));
    }
    if is_interrupted()? {
        let missing = unplayed.missing;
        message!("interrupted: {missing} matches were not played a second time");
        return Ok(Exit::Interrupted);
    }
    Ok(Exit::Success)
}
