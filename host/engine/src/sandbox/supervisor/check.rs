//! [`check`]: from a worker's report to a record, by the rules.

use wasmouse_core::game::SandboxLimits;
use wasmouse_core::journal::{ENTRY_BYTES, JournalCounts, Note};
use wasmouse_core::record::{Ending, FuelUse, MatchRecord, MatchSpec, Transcript, replay};

use super::super::protocol::{Details, MatchReport, RunFailure};
use crate::error::InfrastructureError;
use crate::runner::Recording;

/// The text of a fault is a sentence; wasmtime's longest have a few hundred bytes.
const DETAIL_BYTES_MAX: usize = 16 << 10;

/// Why a worker's report cannot be true: the worker is broken, or a robot has taken it over.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("protocol violation: {0}")]
pub(in crate::sandbox) struct ProtocolViolation(String);

fn violation<T>(what: &str) -> Result<T, ProtocolViolation> {
    Err(ProtocolViolation(what.to_owned()))
}

/// Replays a reported transcript in the supervisor's own simulation and leaves it in
/// `recording`, with the journal and the fuel by step where they were asked for.
///
/// # Errors
///
/// When no match can have gone so. The inner error is a failure of the host that the worker
/// reports.
pub(in crate::sandbox) fn check(
    report: MatchReport,
    spec: &MatchSpec,
    recording: &mut Recording,
) -> Result<Result<MatchRecord, InfrastructureError>, ProtocolViolation> {
    let limits = &spec.rules.sandbox;
    recording.clear(limits);
    let transcript = match report.transcript {
        Ok(bytes) => {
            Transcript::from_bytes(&bytes).map_err(|error| ProtocolViolation(error.to_string()))?
        }
        Err(RunFailure::Slow { seconds }) => return Ok(Err(InfrastructureError::Slow { seconds })),
        Err(RunFailure::Failed(reason)) => return Ok(Err(InfrastructureError::Call(reason))),
    };
    check_fuel(report.usage.fuel, limits)?;
    if report.usage.memory_bytes > limits.memory_bytes_max {
        return violation("more memory was used than there was");
    }
    check_journal(report.usage.journal, limits)?;
    if let Ending::Fault { detail, .. } = transcript.ending()
        && detail.len() > DETAIL_BYTES_MAX
    {
        return violation("the detail of a fault is too long");
    }
    let result = replay(&spec.maze, &spec.rules.game, &transcript)
        .map_err(|error| ProtocolViolation(error.to_string()))?;
    recording.transcript = transcript;
    let record = MatchRecord::new(spec.key, result, report.usage, &recording.transcript);
    if let Some(details) = report.details {
        keep(details, &record, spec, recording)?;
    }
    Ok(Ok(record))
}

fn check_fuel(fuel: FuelUse, limits: &SandboxLimits) -> Result<(), ProtocolViolation> {
    let possible = fuel.start <= limits.start_fuel_max
        && fuel.step_max <= limits.step_fuel_max
        && fuel.step_max <= fuel.steps
        && fuel.steps <= limits.match_fuel_max;
    if possible {
        Ok(())
    } else {
        violation("more fuel was used than there was")
    }
}

/// What the journal has room for, and that every call that did not fit cost fuel.
fn check_journal(journal: JournalCounts, limits: &SandboxLimits) -> Result<(), ProtocolViolation> {
    let fuel = limits.start_fuel_max.saturating_add(limits.match_fuel_max);
    if journal.entries <= limits.journal_bytes_max / ENTRY_BYTES && journal.dropped <= fuel {
        Ok(())
    } else {
        violation("there are more entries than a journal has")
    }
}

/// Puts journal and fuel into the recording, when they are those of the match.
fn keep(
    details: Details,
    record: &MatchRecord,
    spec: &MatchSpec,
    recording: &mut Recording,
) -> Result<(), ProtocolViolation> {
    check_step_fuel(&details.step_fuel, record.fuel)?;
    let walls = spec.maze.walls();
    let steps = record.steps.total();
    for (step, note) in &details.journal {
        let note = note.borrowed();
        let inside = match note {
            Note::Log { .. } => true,
            Note::Paint { cell, .. } | Note::Label { cell, .. } | Note::Wall { cell, .. } => {
                walls.contains(cell)
            }
        };
        if !inside {
            return violation("an entry is about a cell outside the maze");
        }
        // One more when the robot wrote something and then failed.
        if *step > steps + 1 {
            return violation("an entry was made after the last step");
        }
        recording.journal.push(*step, note);
    }
    let expected = JournalCounts {
        entries: record.journal.entries,
        dropped: 0,
    };
    if recording.journal.counts() != expected {
        return violation("the number of entries differs");
    }
    recording.step_fuel = details.step_fuel;
    Ok(())
}

fn check_step_fuel(by_step: &[u64], fuel: FuelUse) -> Result<(), ProtocolViolation> {
    let sum = by_step
        .iter()
        .try_fold(0_u64, |sum, used| sum.checked_add(*used));
    let max = by_step.iter().max().copied().unwrap_or(0);
    if (sum, max) == (Some(fuel.steps), fuel.step_max) {
        Ok(())
    } else {
        violation("the fuel by step does not add up to the fuel of the match")
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use wasmouse_core::Digest;
    use wasmouse_core::game::{FaultKind, Phase, Ruleset};
    use wasmouse_core::journal::Level;
    use wasmouse_core::maze::{Maze, Walls};
    use wasmouse_core::record::{MatchKey, Usage};

    use super::super::super::protocol::OwnedNote;
    use super::*;

    fn spec() -> MatchSpec {
        let maze = Maze::contest(Walls::open(12)).expect("a maze");
        let rules = Ruleset::default();
        MatchSpec {
            key: MatchKey {
                engine: Digest::of(b"engine"),
                rules: rules.digest(),
                robot: Digest::of(b"robot"),
                variant: 0,
                maze: maze.digest(),
                seed: 0,
            },
            maze: Arc::new(maze),
            rules: Arc::new(rules),
        }
    }

    fn transcript(detail: String) -> Vec<u8> {
        let mut transcript = Transcript::default();
        transcript.end_with_fault(FaultKind::Unreachable, Phase::NextMove, detail);
        transcript.to_bytes()
    }

    /// A robot that failed in its first step, reported with details.
    fn failed() -> MatchReport {
        MatchReport {
            transcript: Ok(transcript("executed `unreachable`".into()).into()),
            usage: Usage {
                fuel: FuelUse {
                    start: 1,
                    steps: 7,
                    step_max: 7,
                },
                memory_bytes: 65_536,
                journal: JournalCounts {
                    entries: 0,
                    dropped: 3,
                },
            },
            details: Some(Details {
                step_fuel: vec![7],
                journal: Vec::new(),
            }),
        }
    }

    #[track_caller]
    fn check_change(change: impl FnOnce(&mut MatchReport), expected: Option<&str>) {
        let mut report = failed();
        change(&mut report);
        let checked = check(report, &spec(), &mut Recording::default());
        assert_eq!(checked.err().map(|it| it.0), expected.map(str::to_owned));
    }

    fn details(report: &mut MatchReport) -> &mut Details {
        report.details.as_mut().expect("it has details")
    }

    #[test]
    fn a_possible_report_is_believed() {
        check_change(|_| (), None);
    }

    /// Each of these was believed once, or would have been.
    #[test]
    fn an_impossible_report_is_not_believed() {
        let fuel = Some("the fuel by step does not add up to the fuel of the match");
        check_change(|it| details(it).step_fuel = vec![6], fuel);
        check_change(|it| details(it).step_fuel = vec![3, 4], fuel);
        check_change(|it| details(it).step_fuel = vec![u64::MAX, 8], fuel);
        let room = Some("there are more entries than a journal has");
        check_change(|it| it.usage.journal.entries = u64::MAX, room);
        check_change(|it| it.usage.journal.dropped = u64::MAX, room);
        let count = Some("the number of entries differs");
        check_change(|it| it.usage.journal.entries = 1, count);
        let log = |step| (step, OwnedNote::Log(Level::Info, "text".into()));
        check_change(|it| details(it).journal.push(log(1)), count);
        check_change(
            |it| {
                it.usage.journal.entries = 1;
                details(it).journal.push(log(2));
            },
            Some("an entry was made after the last step"),
        );
        let fuel = Some("more fuel was used than there was");
        check_change(|it| it.usage.fuel.start = u64::MAX, fuel);
        let memory = Some("more memory was used than there was");
        check_change(|it| it.usage.memory_bytes = u64::MAX, memory);
        let detail = transcript("x".repeat(DETAIL_BYTES_MAX + 1));
        check_change(
            |it| it.transcript = Ok(detail.into()),
            Some("the detail of a fault is too long"),
        );
        check_change(
            |it| it.transcript = Ok(vec![1, 0].into()),
            Some("the transcript ends after step 0, before the match does"),
        );
        check_change(
            |it| it.transcript = Ok(vec![1].into()),
            Some("the transcript is truncated"),
        );
    }
}
