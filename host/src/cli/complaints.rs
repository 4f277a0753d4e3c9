//! What robots wrote when they failed, for the messages about their faults.

use std::collections::BTreeSet;

use wasmouse_core::journal::JournalCounts;
use wasmouse_engine::{Executor, InfrastructureError};

use super::again::play_again;
use crate::contest::{Complaint, Complaints, FaultSummary, Plan, Player};

/// Kinds of faults that are looked into, at most: a match is played again for each.
const MATCHES_MAX: usize = 20;

/// Plays the first match again that ended in each kind of fault of each robot, and keeps what the
/// robot wrote in the call that failed. Complaints are optional: one that cannot be had is missing.
pub fn collect(
    plan: &Plan,
    players: &[Player],
    executor: &dyn Executor,
    faults: &FaultSummary,
) -> Complaints {
    let mut complaints = Complaints::default();
    let mut withdrawn = BTreeSet::new();
    let groups = faults.groups();
    let groups = groups.filter(|it| it.first.journal != JournalCounts::default());
    for group in groups.take(MATCHES_MAX) {
        if withdrawn.contains(&group.player) {
            continue;
        }
        match play_again(plan, players, executor, &group.first) {
            Ok(Some(again)) if again.detailed.record == group.first => {
                if let Some(fault) = group.first.verdict.fault() {
                    let complaint = Complaint::of(&again.detailed.recording.journal, fault);
                    complaints.add(group.player, fault.kind, complaint);
                }
            }
            Err(InfrastructureError::Withdrawn(_)) => {
                withdrawn.insert(group.player);
            }
            Ok(_) | Err(_) => {}
        }
    }
    complaints
}
