//! `wasmouse run --reproduce`: all matches once more, with as little in common with the first
//! time as possible.
//!
//! The second time has its own engine and workers, robots that are read and compiled again,
//! another number of threads, and mazes and robots in reverse order.

use std::collections::HashMap;

use wasmouse_core::record::{MatchKey, MatchRecord};

use super::exit::Exit;
use super::failure::Failure;
use super::output::message;
use super::play::{is_interrupted, play_all};
use super::robots::{self, RobotSpec};
use super::setup::{IsolationArgs, independent_executor};
use crate::contest::{Plan, RecordList, Results, differences};
use crate::report::verification::{Difference, MatchName};

/// Differences that are listed.
const LISTED_MAX: usize = 20;

/// Plays a contest a second time and compares.
///
/// # Errors
///
/// When the host fails.
pub fn check(
    plan: &Plan,
    results: &Results,
    specs: &[RobotSpec],
    jobs: usize,
    isolation: &IsolationArgs,
) -> Result<Exit, Failure> {
    let jobs = if jobs > 1 { jobs - 1 } else { 2 };
    let executor = independent_executor(plan.rules.clone(), jobs, isolation)?;
    let reversed: Vec<RobotSpec> = specs.iter().rev().cloned().collect();
    let again = Plan {
        entrants: robots::load(&reversed, &executor)?,
        mazes: plan.mazes.iter().rev().cloned().collect(),
        seeds: plan.seeds,
        rules: plan.rules.clone(),
    };
    let mut list = RecordList::new(u64::MAX);
    play_all(&again, &executor, jobs, &mut list)?;
    let found = list.into_records().unwrap_or_default();
    let found: HashMap<MatchKey, MatchRecord> = found
        .into_iter()
        .map(|record| (record.key, record))
        .collect();

    let names = results.names();
    let (mut count, mut missing) = (0, 0);
    for record in &results.matches {
        let Some(found) = found.get(&record.key) else {
            missing += 1;
            continue;
        };
        for field in differences(record, found) {
            count += 1;
            if count <= LISTED_MAX {
                let of = Some(MatchName::new(&names, &record.key));
                message!("not reproducible: {}", Difference { of, field });
            }
        }
    }
    if is_interrupted()? {
        message!("interrupted: {missing} matches were not played a second time");
        return Ok(Exit::Interrupted);
    }
    if missing > 0 {
        let message = format!("{missing} matches could not be played a second time");
        return Err(Failure::internal(message));
    }
    if count > 0 {
        message!(
            "error: {count} values differ when the contest is played again\n\n\
             hint: a damaged cache of compiled robots (try --no-cache), a faulty machine, or a \
             bug in wasmouse"
        );
        return Ok(Exit::CheckFailed);
    }
    message!("reproduced {} matches", results.matches.len());
    Ok(Exit::Success)
}
