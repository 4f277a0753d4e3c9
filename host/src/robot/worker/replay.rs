//! From a robot's answers to an outcome, by the rules: [`replay`].

use super::wire::{Answers, Full, Note, Stop};
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
        keep(full, game, recorder)?;
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

/// Puts journal and fuel into the recorder.
fn keep(full: Full, game: &Game<'_>, recorder: &mut Recorder) -> Result<(), Nonsense> {
    let walls = game.maze.walls();
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
        recorder.journal.push(*step, note);
    }
    recorder.step_fuel = full.step_fuel;
    Ok(())
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
