//! [`FaultSummary`]: the faults of a contest, by robot and kind.

use std::collections::BTreeMap;
use std::io;

use wasmouse_core::game::FaultKind;
use wasmouse_core::record::MatchRecord;

use super::sink::{ContestMatch, Sink};

/// One kind of fault of one robot.
#[derive(Clone, Debug)]
pub struct FaultGroup {
    /// Index of the player.
    pub player: usize,
    /// How many matches ended so.
    pub count: u64,
    /// The first of them, in the order of the plan.
    pub first: MatchRecord,
}

/// Groups faults, so that a robot that fails in every maze is one line.
#[derive(Debug, Default)]
pub struct FaultSummary {
    groups: BTreeMap<(usize, &'static str), FaultGroup>,
}

impl FaultSummary {
    /// The groups, by player and then by the name of the kind.
    pub fn groups(&self) -> impl Iterator<Item = &FaultGroup> {
        self.groups.values()
    }
}

impl Sink for FaultSummary {
    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        if let Some(fault) = played.record.verdict.fault() {
            let key = (played.player, FaultKind::name(fault.kind));
            self.groups
                .entry(key)
                .and_modify(|group| group.count += 1)
                .or_insert_with(|| FaultGroup {
                    player: played.player,
                    count: 1,
                    first: played.record.clone(),
                });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use wasmouse_core::record::Transcript;

    use super::super::tally::tests::{fault, finished};
    use super::*;

    #[test]
    fn faults_are_grouped_by_robot_and_kind() {
        let mut summary = FaultSummary::default();
        for (player, record) in [
            (1, fault(FaultKind::Panic)),
            (0, finished(18, 17)),
            (0, fault(FaultKind::StackOverflow)),
            (1, fault(FaultKind::Panic)),
            (0, fault(FaultKind::Panic)),
        ] {
            let transcript = Transcript::default();
            let played = ContestMatch {
                player,
                record,
                transcript,
            };
            summary.played(&played).expect("it only counts");
        }
        let groups: Vec<_> = summary.groups().map(|it| (it.player, it.count)).collect();
        assert_eq!(groups, [(0, 1), (0, 1), (1, 2)]);
    }
}
