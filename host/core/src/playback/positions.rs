//! [`Playback`] and its [`Position`]s.

use super::milestone::{self, Milestone};
use crate::Digest;
use crate::game::{GameRules, Run, Sensors, Step, Steps, Trace, Verdict};
use crate::journal::Journal;
use crate::knowledge::{Audit, Knowledge, Walk};
use crate::maze::{Cell, Heading, Maze};

/// The state of a match at a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Position {
    /// The run in progress.
    pub run: Run,
    /// The robot's cell.
    pub cell: Cell,
    /// The robot's heading.
    pub heading: Heading,
    /// The readings in that cell and heading.
    pub sensors: Sensors,
    /// The steps so far.
    pub steps: Steps,
    /// Whether a step of the exploration run has ended in the goal.
    pub goal_reached: bool,
}

/// A match with everything that can be shown of it at any position.
///
/// Nothing is kept for each position but its audit, so a position costs time proportional to the
/// steps before it: about 0.1 ms after 1,000 steps.
///
/// ```
/// use wasmouse_core::game::{Action, GameRules};
/// use wasmouse_core::journal::Journal;
/// use wasmouse_core::maze::{Cell, Maze, Turn, Walls};
/// use wasmouse_core::playback::Playback;
/// use wasmouse_core::record::{Transcript, trace};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let rules = GameRules { budget: 2, ..GameRules::default() };
/// let mut transcript = Transcript::default();
/// transcript.push(Action::Move { turn: Turn::Straight, advance: 3 });
/// transcript.push(Action::Reset);
/// let (result, trace) = trace(&maze, &rules, &transcript).expect("a whole match");
/// let playback = Playback::new(maze, rules, trace, result.verdict, Journal::default());
/// assert_eq!(playback.last(), 2);
/// assert_eq!(playback.at(0).cell, Cell::new(0, 0));
/// assert_eq!(playback.at(1).cell, Cell::new(0, 3));
/// assert_eq!(playback.visits(1).iter().sum::<u32>(), 4);
/// ```
#[derive(Clone, Debug)]
pub struct Playback {
    maze: Maze,
    rules: GameRules,
    trace: Trace,
    verdict: Verdict,
    journal: Journal,
    audit: Audit,
    milestones: Vec<Milestone>,
}

impl Playback {
    /// The playback of a match. `trace` and `verdict` belong to a match in that maze with those
    /// rules, as [`record::trace`](crate::record::trace) returns them.
    pub fn new(
        maze: Maze,
        rules: GameRules,
        trace: Trace,
        verdict: Verdict,
        journal: Journal,
    ) -> Self {
        let audit = Audit::new(&maze, &rules, &trace, &verdict, &journal);
        let milestones = milestone::find(&maze, &trace, &audit);
        Self {
            maze,
            rules,
            trace,
            verdict,
            journal,
            audit,
            milestones,
        }
    }

    /// The maze.
    pub const fn maze(&self) -> &Maze {
        &self.maze
    }

    /// The rules.
    pub const fn rules(&self) -> &GameRules {
        &self.rules
    }

    /// Every step, with its readings and effect.
    pub const fn trace(&self) -> &Trace {
        &self.trace
    }

    /// How the match ended.
    pub const fn verdict(&self) -> &Verdict {
        &self.verdict
    }

    /// What the robot wrote; empty if nobody kept it. The text is untrusted.
    pub const fn journal(&self) -> &Journal {
        &self.journal
    }

    /// What could be known at every position.
    pub const fn audit(&self) -> &Audit {
        &self.audit
    }

    /// What happened at which position, in order.
    pub fn milestones(&self) -> &[Milestone] {
        &self.milestones
    }

    /// The last position: the number of steps of the match.
    pub fn last(&self) -> usize {
        self.trace.steps().len()
    }

    /// The identity of the trace: the SHA-256 of its
    /// [identity bytes](Trace::identity_bytes). Whoever shows the same steps has the same one.
    pub fn trace_digest(&self) -> Digest {
        Digest::of(&self.trace.identity_bytes())
    }

    /// The state at a position; beyond the last one, that at the last.
    pub fn at(&self, position: usize) -> Position {
        let done = self.done(position);
        let end = done.last().map(|step| step.end(&self.maze));
        let (run, cell, heading) =
            end.unwrap_or((Run::Exploration, self.maze.start(), Heading::Up));
        let speed = done.iter().filter(|step| step.run == Run::Speed).count();
        let narrow = |count| u32::try_from(count).expect("at most 2,000,000 steps");
        Position {
            run,
            cell,
            heading,
            sensors: Sensors::at(&self.maze, cell, heading),
            steps: Steps {
                exploration: narrow(done.len() - speed),
                speed: narrow(speed),
            },
            goal_reached: done.iter().any(|step| {
                let (run, cell, _) = step.end(&self.maze);
                run == Run::Exploration && self.maze.goal().contains(cell)
            }),
        }
    }

    /// The cells where the steps of the run in progress ended, from the start of the maze, without
    /// those in which the robot did not drive.
    pub fn stops(&self, position: usize) -> Vec<Cell> {
        let done = self.done(position);
        let run = self.at(position).run;
        // The reset is a step of the exploration run that ends where the speed run starts.
        let of_run = done.iter().filter(|step| step.run == run);
        let mut stops = vec![self.maze.start()];
        for step in of_run {
            let (_, cell, _) = step.end(&self.maze);
            if cell != step.cell {
                stops.push(cell);
            }
        }
        stops
    }

    /// How often the robot was in each cell so far, in both runs and including the start, by
    /// [index](crate::maze::Walls::index). Driving through a cell counts once.
    pub fn visits(&self, position: usize) -> Vec<u32> {
        let walls = self.maze.walls();
        let mut visits = vec![0; usize::from(self.maze.dimension()).pow(2)];
        visits[walls.index(self.maze.start())] += 1;
        for step in self.done(position) {
            let (run, end, _) = step.end(&self.maze);
            if run != step.run {
                visits[walls.index(end)] += 1;
                continue;
            }
            let mut cell = step.cell;
            while cell != end {
                cell = Cell::new(towards(cell.x, end.x), towards(cell.y, end.y));
                visits[walls.index(cell)] += 1;
            }
        }
        visits
    }

    /// What the robot could know at a position.
    pub fn knowledge(&self, position: usize) -> Knowledge {
        let mut walk = Walk::new(&self.maze, &self.trace, &self.verdict);
        for _ in 0..=position.min(self.last()) {
            walk.advance();
        }
        walk.into_knowledge()
    }

    fn done(&self, position: usize) -> &[Step] {
        &self.trace.steps()[..position.min(self.last())]
    }
}

const fn towards(from: u8, to: u8) -> u8 {
    if from < to {
        from + 1
    } else if from > to {
        from - 1
    } else {
        from
    }
}
