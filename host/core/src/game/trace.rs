//! [`Trace`]: everything that happened in a match, step by step.

use super::{Action, Event, Run, Sensors, Simulation};
use crate::maze::{Cell, Heading};

/// One step: the state before it, the readings, the robot's action, and its effect.
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
    /// What the robot did.
    pub action: Action,
    /// What came of that.
    pub event: Event,
}

/// All steps of a match, in order: every reading and event.
///
/// A trace is never stored: maze, rules and
/// [`Transcript`](crate::record::Transcript) give it again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    steps: Vec<Step>,
}

impl Trace {
    /// The steps, in order.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Carries out one step in a simulation and adds it to the trace.
    ///
    /// # Panics
    ///
    /// When the match has ended.
    pub fn apply(&mut self, simulation: &mut Simulation<'_>, action: Action) -> Event {
        let (run, cell, heading) = (simulation.run(), simulation.cell(), simulation.heading());
        let sensors = simulation.sense();
        let event = simulation.apply(action);
        self.steps.push(Step {
            run,
            cell,
            heading,
            sensors,
            action,
            event,
        });
        event
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
                Event::Reset => (4, 0),
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
