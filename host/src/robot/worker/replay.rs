//! From a robot's answers to an outcome, by the rules: [`replay`].

use super::wire::{Answers, Full, Note, Stop};
use crate::robot::journal::ENTRY_BYTES;
use crate::robot::{
    self, Fault, FuelUse, Game, HostError, Outcome, Phase, Record, Recorder, Verdict,
};
use crate::sim::{End, Limits, Run, Simulation};

/// The text of a fault is a sentence; wasmtime's longest have a few hundred bytes.
const DETAIL_BYTES_MAX: usize = 16 << 10;

/// Why a worker's answers cannot be.
#[derive(Debug)]
pub(super) struct Nonsense(pub(super) &'static str);

/// Plays the answers in the supervisor's own simulation and leaves the trace in
/// `recorder`, with the journal and the fuel by step where they were asked for.
///
/// # Errors
///
/// When no match can have gone so: the worker is broken, or not itself any more. The
/// inner error is a failure of the host that the worker tells of.
pub(super) fn replay(
    answers: Answers,
    game: &Game<'_>,
    recorder: &mut Recorder,
) -> Result<Result<Record, HostError>, Nonsense> {
    let limits = &game.rules.limits;
    check_fuel(answers.fuel, limits)?;
    check_journal(answers.journal, limits)?;
    recorder.step_fuel.clear();
    recorder.journal.clear(limits.journal_bytes_max);
    let mut simulation = Simulation::new(game.maze, game.rules, &mut recorder.trace);
    for action in answers.actions {
        if simulation.end().is_some() {
            return Err(Nonsense("it answered after the end of a match"));
        }
        simulation.apply(action);
    }
    let verdict = match (answers.stop, simulation.end()) {
        (None, Some(End::Finished(score))) => Verdict::Finished(score),
        (None, Some(End::BudgetUsedUp { goal_reached })) => Verdict::BudgetUsedUp { goal_reached },
        (None, None) => return Err(Nonsense("it stopped in the middle of a match")),
        (Some(Stop::Stalled), _) => return Ok(Err(HostError::Stalled)),
        (Some(Stop::Failed(reason)), _) => return Ok(Err(HostError::Call(reason))),
        (Some(Stop::Fault { .. }), Some(_)) => {
            return Err(Nonsense("it told of a fault after the end of a match"));
        }
        (
            Some(Stop::Fault {
                kind,
                phase,
                detail,
            }),
            None,
        ) => {
            let steps = simulation.steps_total();
            let step = match phase {
                Phase::NextMove => steps + 1,
                Phase::Instantiate | Phase::Start | Phase::Unknown if steps == 0 => 0,
                _ => return Err(Nonsense("it told of a fault before its first answer")),
            };
            if detail.len() > DETAIL_BYTES_MAX {
                return Err(Nonsense("it told of a fault at great length"));
            }
            Verdict::Fault(Fault {
                kind,
                phase,
                run: simulation.run(),
                step,
                cell: simulation.cell(),
                detail,
            })
        }
    };
    let outcome = Outcome {
        verdict,
        steps: [
            simulation.steps(Run::Exploration),
            simulation.steps(Run::Speed),
        ],
        counts: simulation.counts(),
        fuel: answers.fuel,
    };
    if let Some(full) = answers.full {
        let told = (full, answers.journal);
        keep(told, (&outcome, game), recorder)?;
    }
    Ok(Ok(Record {
        outcome,
        trace: recorder.trace_digest(),
        journal: answers.journal,
    }))
}

fn check_fuel(fuel: FuelUse, limits: &Limits) -> Result<(), Nonsense> {
    let possible = fuel.start <= limits.start_fuel_max
        && fuel.step_max <= limits.step_fuel_max
        && fuel.step_max <= fuel.steps
        && fuel.steps <= limits.match_fuel_max;
    if possible {
        Ok(())
    } else {
        Err(Nonsense("it told of more fuel than there was"))
    }
}

/// What the journal has room for, and that every call that did not fit cost fuel.
fn check_journal((entries, dropped): (u64, u64), limits: &Limits) -> Result<(), Nonsense> {
    let fuel = limits.start_fuel_max.saturating_add(limits.match_fuel_max);
    if entries <= limits.journal_bytes_max / ENTRY_BYTES && dropped <= fuel {
        Ok(())
    } else {
        Err(Nonsense("it told of more entries than a journal has"))
    }
}

/// Puts journal and fuel into the recorder, when they are those of the match.
fn keep(
    (full, (entries, _)): (Full, (u64, u64)),
    (outcome, game): (&Outcome, &Game<'_>),
    recorder: &mut Recorder,
) -> Result<(), Nonsense> {
    check_step_fuel(&full.step_fuel, outcome.fuel)?;
    let walls = game.maze.walls();
    let steps: u32 = outcome.steps.iter().sum();
    for (step, note) in &full.journal {
        let note = note.borrowed();
        let inside = match note {
            robot::Note::Log { .. } => true,
            robot::Note::Paint { cell, .. }
            | robot::Note::Label { cell, .. }
            | robot::Note::Wall { cell, .. } => walls.contains(cell),
        };
        if !inside {
            return Err(Nonsense("it told of a cell outside the maze"));
        }
        // One more when the robot said something and then failed.
        if *step > steps + 1 {
            return Err(Nonsense("it told of an entry after the last step"));
        }
        recorder.journal.push(*step, note);
    }
    if recorder.journal.counts() != (entries, 0) {
        return Err(Nonsense("it told of another number of entries"));
    }
    recorder.step_fuel = full.step_fuel;
    Ok(())
}

fn check_step_fuel(by_step: &[u64], fuel: FuelUse) -> Result<(), Nonsense> {
    let sum = by_step
        .iter()
        .try_fold(0_u64, |sum, used| sum.checked_add(*used));
    let max = by_step.iter().max().copied().unwrap_or(0);
    if (sum, max) == (Some(fuel.steps), fuel.step_max) {
        Ok(())
    } else {
        Err(Nonsense("its fuel by step is not the fuel of the match"))
    }
}

impl Note {
    fn borrowed(&self) -> robot::Note<'_> {
        match self {
            Self::Log(level, text) => robot::Note::Log {
                level: *level,
                text,
            },
            Self::Paint(cell, color) => robot::Note::Paint {
                cell: *cell,
                color: *color,
            },
            Self::Label(cell, text) => robot::Note::Label { cell: *cell, text },
            Self::Wall(cell, side, belief) => robot::Note::Wall {
                cell: *cell,
                side: *side,
                belief: *belief,
            },
        }
    }
}

impl From<robot::Note<'_>> for Note {
    fn from(note: robot::Note<'_>) -> Self {
        match note {
            robot::Note::Log { level, text } => Self::Log(level, text.to_owned()),
            robot::Note::Paint { cell, color } => Self::Paint(cell, color),
            robot::Note::Label { cell, text } => Self::Label(cell, text.to_owned()),
            robot::Note::Wall { cell, side, belief } => Self::Wall(cell, side, belief),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fuzz::{maze, short_rules};
    use super::*;
    use crate::robot::FaultKind;

    /// A robot that failed in its first step, told in full.
    fn failed() -> Answers {
        Answers {
            actions: Vec::new(),
            stop: Some(Stop::Fault {
                kind: FaultKind::Unreachable,
                phase: Phase::NextMove,
                detail: "executed `unreachable`".into(),
            }),
            fuel: FuelUse {
                start: 1,
                steps: 7,
                step_max: 7,
            },
            journal: (0, 3),
            full: Some(Full {
                step_fuel: vec![7],
                journal: Vec::new(),
            }),
        }
    }

    #[track_caller]
    fn check(change: impl FnOnce(&mut Answers), expected: Option<&str>) {
        let (maze, rules) = (maze(), short_rules());
        let game = Game {
            maze: &maze,
            rules: &rules,
            seed: 0,
            setting: 0,
        };
        let mut answers = failed();
        change(&mut answers);
        let replayed = replay(answers, &game, &mut Recorder::default());
        assert_eq!(replayed.err().map(|nonsense| nonsense.0), expected);
    }

    fn full(answers: &mut Answers) -> &mut Full {
        answers.full.as_mut().expect("it is told in full")
    }

    #[test]
    fn what_a_robot_did_is_believed() {
        check(|_| (), None);
    }

    /// Each of these was believed until a fuzzer sent it, or would have been.
    #[test]
    fn what_cannot_be_is_not_believed() {
        let fuel = Some("its fuel by step is not the fuel of the match");
        check(|it| full(it).step_fuel = vec![6], fuel);
        check(|it| full(it).step_fuel = vec![3, 4], fuel);
        check(|it| full(it).step_fuel = vec![u64::MAX, 8], fuel);
        let room = Some("it told of more entries than a journal has");
        check(|it| it.journal = (u64::MAX, 0), room);
        check(|it| it.journal = (0, u64::MAX), room);
        let count = Some("it told of another number of entries");
        check(|it| it.journal = (1, 0), count);
        let log = |step| (step, Note::Log(robot::Level::Info, "text".into()));
        check(|it| full(it).journal.push(log(1)), count);
        check(
            |it| {
                it.journal.0 = 1;
                full(it).journal.push(log(2));
            },
            Some("it told of an entry after the last step"),
        );
    }
}
