//! [`replay`]: from a transcript to its outcome by the rules.

use super::{Ending, Transcript};
use crate::game::{Action, Counts, GameRules, Phase, Simulation, Steps, Trace, Verdict};
use crate::maze::Maze;

/// The outcome of a match by the rules of the game: the parts of a
/// [`MatchRecord`](super::MatchRecord) that follow from its transcript.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GameResult {
    /// How the match ended.
    pub verdict: Verdict,
    /// Steps of both runs.
    pub steps: Steps,
    /// Bumps, clamps and ignored resets.
    pub counts: Counts,
}

impl GameResult {
    /// The outcome of a match that has ended.
    ///
    /// # Errors
    ///
    /// If the simulation and the ending contradict each other.
    pub fn new(simulation: &Simulation<'_>, ending: &Ending) -> Result<Self, ReplayError> {
        let verdict = match (ending, simulation.verdict()) {
            (Ending::Rules, Some(verdict)) => verdict,
            (Ending::Rules, None) => {
                let step = simulation.steps().total();
                return Err(ReplayError::Unfinished { step });
            }
            (Ending::Fault { .. }, Some(_)) => return Err(ReplayError::FaultAfterEnd),
            (
                Ending::Fault {
                    kind,
                    phase,
                    detail,
                },
                None,
            ) => {
                if *phase != Phase::NextMove && simulation.steps().total() > 0 {
                    return Err(ReplayError::FaultBeforeSteps);
                }
                Verdict::Fault {
                    fault: simulation.fault(*kind, *phase, detail.clone()),
                }
            }
        };
        Ok(Self {
            verdict,
            steps: simulation.steps(),
            counts: simulation.counts(),
        })
    }
}

/// Why a transcript cannot belong to a match in that maze with those rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReplayError {
    /// There are actions after the end of the match.
    #[error("the transcript has actions after the end of the match, which is step {step}")]
    ActionAfterEnd {
        /// The number of the last step, counted from 1.
        step: u32,
    },
    /// There are too few actions to end the match.
    #[error("the transcript ends after step {step}, before the match does")]
    Unfinished {
        /// The number of the last step, counted from 1; 0 if there is none.
        step: u32,
    },
    /// There is a fault, but the match has ended by the rules.
    #[error("the transcript has a fault after the end of the match")]
    FaultAfterEnd,
    /// There is a fault from before the first step, but also actions.
    #[error("the transcript has actions before a fault of the start")]
    FaultBeforeSteps,
}

/// Computes the outcome of a match from its transcript.
///
/// # Errors
///
/// If the transcript cannot belong to a match in that maze with those rules.
///
/// ```
/// use wasmouse_core::game::{Action, GameRules};
/// use wasmouse_core::maze::{Maze, Walls};
/// use wasmouse_core::record::{ReplayError, Transcript, replay};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let rules = GameRules { budget: 2, ..GameRules::default() };
/// let mut transcript = Transcript::default();
/// transcript.push(Action::Reset);
/// assert_eq!(replay(&maze, &rules, &transcript), Err(ReplayError::Unfinished { step: 1 }));
/// transcript.push(Action::Reset);
/// let result = replay(&maze, &rules, &transcript).expect("a whole match");
/// assert_eq!(result.counts.resets_before_goal, 2);
/// ```
pub fn replay(
    maze: &Maze,
    rules: &GameRules,
    transcript: &Transcript,
) -> Result<GameResult, ReplayError> {
    play(maze, rules, transcript, |simulation, action| {
        simulation.apply(action);
    })
}

/// Like [`replay`], and also returns every reading and event.
///
/// # Errors
///
/// If the transcript cannot belong to a match in that maze with those rules.
///
/// ```
/// use wasmouse_core::game::{Action, GameRules, Verdict};
/// use wasmouse_core::maze::{Maze, Turn, Walls};
/// use wasmouse_core::record::{Transcript, trace};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let rules = GameRules { budget: 2, ..GameRules::default() };
/// let mut transcript = Transcript::default();
/// transcript.push(Action::Move { turn: Turn::Straight, advance: 3 });
/// transcript.push(Action::Reset);
/// let (result, trace) = trace(&maze, &rules, &transcript).expect("a whole match");
/// assert_eq!(result.verdict, Verdict::BudgetUsedUp { goal_reached: false });
/// assert_eq!(trace.steps()[1].sensors.front, 8);
/// ```
pub fn trace(
    maze: &Maze,
    rules: &GameRules,
    transcript: &Transcript,
) -> Result<(GameResult, Trace), ReplayError> {
    let mut trace = Trace::default();
    let result = play(maze, rules, transcript, |simulation, action| {
        trace.apply(simulation, action);
    })?;
    Ok((result, trace))
}

fn play(
    maze: &Maze,
    rules: &GameRules,
    transcript: &Transcript,
    mut apply: impl FnMut(&mut Simulation<'_>, Action),
) -> Result<GameResult, ReplayError> {
    let mut simulation = Simulation::new(maze, rules);
    for action in transcript.actions() {
        if simulation.has_ended() {
            let step = simulation.steps().total();
            return Err(ReplayError::ActionAfterEnd { step });
        }
        apply(&mut simulation, action);
    }
    GameResult::new(&simulation, transcript.ending())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::FaultKind;
    use crate::maze::{Turn, Walls};

    #[track_caller]
    fn check(actions: usize, fault: Option<Phase>, expected: Result<u32, ReplayError>) {
        let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
        let rules = GameRules {
            budget: 3,
            ..GameRules::default()
        };
        let mut transcript = Transcript::default();
        for _ in 0..actions {
            transcript.push(Action::Move {
                turn: Turn::Straight,
                advance: 1,
            });
        }
        if let Some(phase) = fault {
            transcript.end_with_fault(FaultKind::Panic, phase, "panicked".to_owned());
        }
        let result = replay(&maze, &rules, &transcript);
        let steps = result.clone().map(|it| it.steps.total());
        assert_eq!(steps, expected, "{actions} actions, {fault:?}");
        if let (Some(phase), Ok(result)) = (fault, result) {
            let fault = result.verdict.fault().expect("a fault");
            let in_progress = u32::from(phase == Phase::NextMove);
            assert_eq!(fault.step, result.steps.total() + in_progress);
        }
    }

    #[test]
    fn impossible_transcripts_are_rejected() {
        check(3, None, Ok(3));
        check(2, None, Err(ReplayError::Unfinished { step: 2 }));
        check(4, None, Err(ReplayError::ActionAfterEnd { step: 3 }));
        check(2, Some(Phase::NextMove), Ok(2));
        check(0, Some(Phase::Start), Ok(0));
        check(0, Some(Phase::Unknown), Ok(0));
        check(1, Some(Phase::Start), Err(ReplayError::FaultBeforeSteps));
        check(1, Some(Phase::Unknown), Err(ReplayError::FaultBeforeSteps));
        check(3, Some(Phase::NextMove), Err(ReplayError::FaultAfterEnd));
    }
}
