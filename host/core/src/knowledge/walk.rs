//! [`Walk`]: the knowledge of a match from one reading to the next.

use super::known_walls::Knowledge;
use crate::game::{Phase, Sensors, Step, Trace, Verdict};
use crate::maze::{Cell, Heading, Maze};

/// The knowledge of a match, one position after the other.
///
/// Position n is after n steps. The robot reads there before it takes the next step; after the last
/// step of a match there is a reading only if the robot failed in the step that followed.
#[derive(Clone, Debug)]
pub struct Walk<'a> {
    knowledge: Knowledge,
    steps: &'a [Step],
    /// The reading of the step in which the robot failed.
    last: Option<(Cell, Heading, Sensors)>,
    /// The next position.
    next: usize,
}

impl<'a> Walk<'a> {
    /// A match before its first reading.
    pub fn new(maze: &Maze, trace: &'a Trace, verdict: &Verdict) -> Self {
        let steps = trace.steps();
        let failed = verdict.fault().filter(|it| it.phase == Phase::NextMove);
        let last = failed.map(|_| {
            let end = steps.last().map(|step| step.end(maze));
            let (cell, heading) = end.map_or((maze.start(), Heading::Up), |(_, cell, heading)| {
                (cell, heading)
            });
            (cell, heading, Sensors::at(maze, cell, heading))
        });
        Self {
            knowledge: Knowledge::of_nothing(maze),
            steps,
            last,
            next: 0,
        }
    }

    /// What is known at the last position that was advanced to.
    pub const fn knowledge(&self) -> &Knowledge {
        &self.knowledge
    }

    /// What is known at the last position that was advanced to.
    pub fn into_knowledge(self) -> Knowledge {
        self.knowledge
    }

    /// The number of positions with a reading.
    pub fn readings(&self) -> usize {
        self.steps.len() + usize::from(self.last.is_some())
    }

    /// Learns what the next position shows; returns the number of walls that were unknown before.
    /// Does nothing after the last position.
    pub fn advance(&mut self) -> u32 {
        let position = self.next;
        self.next += 1;
        let step = |at: usize| self.steps.get(at);
        let reading = match step(position) {
            Some(step) => Some((step.cell, step.heading, step.sensors)),
            None if position == self.steps.len() => self.last,
            None => None,
        };
        let Some((cell, heading, sensors)) = reading else {
            return 0;
        };
        // The reading says how far the step before it came.
        let before = position.checked_sub(1).and_then(step);
        let driven = before.map_or(0, |step| self.knowledge.drive(step));
        driven + self.knowledge.see(cell, heading, sensors)
    }
}
