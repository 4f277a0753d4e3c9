//! [`Trace`]: everything that happened in a match, step by step.

use super::{Action, Run, Sensors};
use crate::maze::{Cell, Heading};

/// What a step did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Event {
    /// The robot turned and drove.
    Moved {
        /// Where it ended.
        cell: Cell,
        /// Its heading after the turn.
        heading: Heading,
        /// Cells covered; fewer than asked when it bumped.
        cells: u8,
        /// A wall stopped it.
        bumped: bool,
        /// The answer was beyond the longest move.
        clamped: bool,
    },
    /// Run 1 ended and run 2 began at the start, heading up.
    ResetDone,
    /// A reset before the goal was reached: the step is lost.
    ResetBeforeGoal,
    /// A reset in run 2: the step is lost.
    ResetInSpeedRun,
}

/// One step: the state before it, what the robot saw and said, what happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Step {
    /// The run the step belongs to.
    pub run: Run,
    /// The robot's cell before the step.
    pub cell: Cell,
    /// The robot's heading before the step.
    pub heading: Heading,
    /// The readings that the robot got.
    pub sensors: Sensors,
    /// What it answered.
    pub action: Action,
    /// What came of it.
    pub event: Event,
}

/// All steps of a match, in order. Complete: with the maze and the ruleset it
/// tells the whole match.
///
/// Reused from match to match, so that a contest does not allocate per match.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    steps: Vec<Step>,
}

impl Trace {
    /// The steps, in order.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Forgets all steps and keeps the memory.
    pub fn clear(&mut self) {
        self.steps.clear();
    }

    pub(super) fn push(&mut self, step: Step) {
        self.steps.push(step);
    }

    /// The bytes that identify the trace: 12 for each step, in order (run, x,
    /// y, heading, the three readings, the action's kind, turn and advance, the
    /// event's kind and the cells covered).
    pub fn identity_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.steps.len() * 12);
        for step in &self.steps {
            let (kind, turn, advance) = match step.action {
                Action::Move { turn, advance } => (0, turn as u8, advance.cast_unsigned()),
                Action::Reset => (1, 0, 0),
            };
            let (event, cells) = match step.event {
                Event::Moved {
                    cells,
                    bumped,
                    clamped,
                    ..
                } => (u8::from(bumped) | (u8::from(clamped) << 1), cells),
                Event::ResetDone => (4, 0),
                Event::ResetBeforeGoal => (5, 0),
                Event::ResetInSpeedRun => (6, 0),
            };
            bytes.extend_from_slice(&[
                step.run.number(),
                step.cell.x,
                step.cell.y,
                step.heading as u8,
                step.sensors.left,
                step.sensors.front,
                step.sensors.right,
                kind,
                turn,
                advance,
                event,
                cells,
            ]);
        }
        bytes
    }
}
