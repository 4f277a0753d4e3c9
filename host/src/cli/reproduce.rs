//! `wasmouse run --reproduce`: all matches once more, with as little in common with the first
//! time as possible.
//!
//! The second time has its own engine and workers, robots that are read and compiled again,
//! another number of threads, and mazes and robots in reverse order.

use std::collections::{HashMap, HashSet};
use std::io;

use wasmouse_core::GuestText;
use wasmouse_core::record::{MatchKey, MatchRecord};

use super::entrants;
use super::exit::Exit;
use super::failure::Failure;
use super::interrupt;
use super::output::message;
use super::play::{Pace, is_interrupted, play};
use super::robots::RobotSpec;
use super::setup::{IsolationArgs, TimeArgs, independent_executor};
use super::verdict::print_failed_admissions;
use crate::contest::{
    ContestMatch, MatchFailure, Plan, RecordList, Results, Sink, Tee, differences,
};
use crate::report::number::{counted, counted_were};
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
    pace: Pace,
    (isolation, time): (&IsolationArgs, &TimeArgs),
) -> Result<Exit, Failure> {
    interrupt::listen()?;
    let jobs = if pace.jobs > 1 { pace.jobs - 1 } else { 2 };
    let executor = independent_executor(plan.rules.clone(), jobs, isolation, time)?;
    let reversed: Vec<RobotSpec> = specs.iter().rev().cloned().collect();
    let again = Plan {
        entrants: entrants::load(&reversed, &executor)?,
        mazes: plan.mazes.iter().rev().cloned().collect(),
        seeds: plan.seeds,
        rules: plan.rules.clone(),
    };
    let mut list = RecordList::new(u64::MAX);
    let mut reasons = Reasons::default();
    let keys: HashSet<MatchKey> = results.matches.iter().map(|it| it.key).collect();
    let wanted = |key: &MatchKey| keys.contains(key);
    play(
        &again,
        &executor,
        Pace { jobs, ..pace },
        (&wanted, keys.len() as u64),
        &mut Tee(vec![&mut list, &mut reasons]),
    )?;
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
        message!(
            "interrupted: {} not played a second time",
            counted_were(missing, "match")
        );
        return Ok(Exit::Interrupted);
    }
    print_failed_admissions(&again);
    for (key, (reason, matches)) in &reasons.0 {
        message!(
            "error: `{}`: {} not played a second time: {}",
            names.robot(key).escaped(),
            counted_were(*matches, "match"),
            reason.escaped()
        );
    }
    if count > 0 {
        message!(
            "error: {} when the contest is played again\n\n\
             hint: a damaged cache of compiled robots (try --no-cache), a faulty machine, or a \
             bug in wasmouse",
            counted(count, "difference")
        );
        return Ok(Exit::CheckFailed);
    }
    if missing > 0 {
        let all = counted(results.matches.len(), "match");
        message!(
            "error: {} of {} could not be played a second time",
            missing,
            all
        );
        return Ok(Exit::Internal);
    }
    message!("reproduced {}", counted(results.matches.len(), "match"));
    Ok(Exit::Success)
}

/// Why matches were not played, by robot: one of their keys, the first reason, how many.
#[derive(Default)]
struct Reasons(Vec<(MatchKey, (GuestText, u64))>);

impl Sink for Reasons {
    fn played(&mut self, _: &ContestMatch) -> io::Result<()> {
        Ok(())
    }

    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        let robot = |key: &MatchKey| (key.robot, key.variant);
        let mut known = self.0.iter_mut();
        match known.find(|it| robot(&it.0) == robot(&failure.key)) {
            Some((_, (_, matches))) => *matches += 1,
            None => self.0.push((failure.key, (failure.reason.clone(), 1))),
        }
        Ok(())
    }

    fn withdrawn(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.failed(failure)
    }
}
