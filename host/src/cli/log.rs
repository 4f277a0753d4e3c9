//! `--log`: what robots wrote to their journals, for the people who debug them.

use std::collections::BTreeSet;

use wasmouse_core::journal::{JournalCounts, Level, Note};
use wasmouse_engine::{Executor, InfrastructureError};

use super::again::play_again;
use super::output::message;
use crate::contest::{Complaint, Plan, Player, Results};
use crate::report::escape::for_terminal;
use crate::report::faults::explained;

/// Plays every match that has a journal again and prints its log lines to stderr. Robots do
/// not influence each other, so a match that cannot be played again is only reported.
pub fn print(plan: &Plan, players: &[Player], executor: &dyn Executor, results: &Results) {
    let has_journal = |journal: JournalCounts| journal != JournalCounts::default();
    let mut withdrawn = BTreeSet::new();
    for record in results.matches.iter().filter(|it| has_journal(it.journal)) {
        let names = results.names();
        let robot = for_terminal(names.robot(&record.key));
        let maze = for_terminal(names.maze_name(&record.key));
        let seed = record.key.seed;
        if withdrawn.contains(&record.key.robot) {
            continue;
        }
        let replayed = match play_again(plan, players, executor, record) {
            Ok(Some(replayed)) => replayed,
            Ok(None) => continue,
            Err(InfrastructureError::Withdrawn(reason)) => {
                message!("warning: no more logs of `{}`: {}", robot, reason);
                withdrawn.insert(record.key.robot);
                continue;
            }
            Err(error) => {
                message!(
                    "warning: no log of `{}` in `{}`, seed {}: {}",
                    robot,
                    maze,
                    seed,
                    error
                );
                continue;
            }
        };
        message!("log of `{}` in `{}`, seed {}:", robot, maze, seed);
        let journal = &replayed.detailed.recording.journal;
        for entry in journal.entries() {
            if let Note::Log { level, text } = entry.note {
                let level = level_name(level);
                message!("{:>6} {:<7} {}", entry.step, level, text.escaped());
            }
        }
        if let Some(fault) = record.verdict.fault() {
            let complaint = Complaint::of(journal, fault);
            let explained = explained(fault, Some(&complaint));
            message!("{:>6} {:<7} {}", fault.step, "fault", explained.escaped());
        }
        let dropped = record.journal.dropped;
        if dropped > 0 {
            message!("       {} more entries exceeded the journal limit", dropped);
        }
    }
}

const fn level_name(level: Level) -> &'static str {
    match level {
        Level::Debug => "debug",
        Level::Info => "info",
        Level::Warning => "warning",
        Level::Error => "error",
    }
}
