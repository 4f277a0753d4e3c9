//! [`Trace`]: all steps of a match with their readings and events.

use super::{Action, Event, Run, Sensors, Simulation};
use crate::maze::{Cell, Heading, Maze};

/// One step: the state before it, the readings, the robot's action, and its effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Step {
    /// The run the step belongs to.
    pub run: Run,
    /// The robot's cell before the step.
    pub cell: Cell,
    /// The robot's heading before the step.
    pub heading: Heading,
    /// The readings before the step.
    pub sensors: Sensors,
    /// The robot's action.
    pub action: Action,
    /// The effect of the action.
    pub event: Event,
}

impl Step {
    /// The run, cell and heading after the step.
    pub fn end(&self, maze: &Maze) -> (Run, Cell, Heading) {
        match self.event {
            Event::Moved { cell, heading, .. } => (self.run, cell, heading),
            Event::Reset => (Run::Speed, maze.start(), Heading::Up),
            Event::ResetBeforeGoal | Event::ResetInSpeedRun => (self.run, self.cell, self.heading),
        }
    }
}

/// All steps of a match, in order, with every reading and event.
///
/// It is not meant to be stored: [`record::trace`](crate::record::trace) computes it from the
/// maze, the rules and the [`Transcript`](crate::record::Transcript).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    steps: Vec<Step>,
}

impl Trace {
    /// The steps, in order.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Plays one step of a simulation and adds it to the trace.
    ///
    /// # Panics
    ///
    /// If the match has ended.
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

    /// The bytes that identify the trace: 12 for each step.
    ///
    /// In order: the number of the run; x, y and heading before the step; the readings left,
    /// front and right; the kind of the action (0 move, 1 reset), its turn and advance; the kind
    /// of the event (moves: 1 if bumped plus 2 if clamped; 4 reset, 5 reset before goal, 6 reset
    /// in speed run), and the cells driven. Parts that do not apply are 0.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::GameRules;
    use crate::maze::{Turn, Walls};

    /// Recorded matches are identified by these bytes.
    #[test]
    fn identity_bytes_never_change() {
        let maze = Maze::contest(Walls::open(4)).expect("start and goal fit");
        let rules = GameRules::default();
        let mut simulation = Simulation::new(&maze, &rules);
        let mut trace = Trace::default();
        let drive = |turn, advance| Action::Move { turn, advance };
        for action in [
            drive(Turn::Left, -1),
            Action::Reset,
            drive(Turn::Right, 9),
            drive(Turn::Right, 3),
            drive(Turn::Straight, -1),
            drive(Turn::Right, 1),
            Action::Reset,
            Action::Reset,
        ] {
            trace.apply(&mut simulation, action);
        }
        let expected = [
            [1, 0, 0, 0, 0, 3, 3, 0, 0, 255, 0, 1],
            [1, 1, 0, 3, 0, 1, 3, 1, 0, 0, 5, 0],
            [1, 1, 0, 3, 0, 1, 3, 0, 2, 9, 2, 3],
            [1, 1, 3, 0, 1, 0, 2, 0, 2, 3, 1, 2],
            [1, 3, 3, 1, 0, 0, 3, 0, 1, 255, 0, 1],
            [1, 2, 3, 1, 0, 1, 3, 0, 2, 1, 0, 1],
            [1, 2, 2, 2, 1, 2, 2, 1, 0, 0, 4, 0],
            [2, 0, 0, 0, 0, 3, 3, 1, 0, 0, 6, 0],
        ];
        assert_eq!(trace.identity_bytes(), expected.concat());
    }
}
