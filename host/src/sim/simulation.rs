//! [`Simulation`]: one match's state, sensors and motion.
//!
//! Exactly the contest of the reports as its public tester plays it: games
//! recorded from that tester replay through [`Simulation::apply`] in the tests.

use super::trace::{Event, Step, Trace};
use super::{Action, BudgetScope, Ruleset, Score, Sensors};
use crate::maze::{Cell, Heading, Maze, Turn};

/// The two runs of a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Run {
    /// Run 1: the robot may go where it likes; ends by a reset.
    Exploration,
    /// Run 2: ends with the first step that ends in the goal.
    Speed,
}

impl Run {
    /// 1 or 2.
    pub const fn number(self) -> u8 {
        match self {
            Self::Exploration => 1,
            Self::Speed => 2,
        }
    }
}

/// How a match ended that no fault ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Run 2 ended in the goal.
    Finished(Score),
    /// The budget is used up.
    BudgetUsedUp {
        /// Whether a step of run 1 ended in the goal.
        goal_reached: bool,
    },
}

/// What a match counts besides its steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Steps that ended early at a wall.
    pub bumps: u32,
    /// Answers beyond the longest move.
    pub clamps: u32,
    /// Resets refused because run 1 had not reached the goal.
    pub resets_before_goal: u32,
    /// Resets refused because run 2 had begun.
    pub resets_in_speed_run: u32,
}

/// One match in progress.
///
/// ```
/// use wasmouse::maze::{Maze, Turn, Walls};
/// use wasmouse::sim::{Action, Ruleset, Simulation, Trace};
///
/// let maze = Maze::contest(Walls::open(12)).expect("a legal start and goal");
/// let rules = Ruleset::default();
/// let mut trace = Trace::default();
/// let mut simulation = Simulation::new(&maze, &rules, &mut trace);
/// assert_eq!(simulation.sense().front, 11);
/// simulation.apply(Action::Move { turn: Turn::Right, advance: 3 });
/// assert_eq!((simulation.cell().x, simulation.cell().y), (3, 0));
/// assert_eq!(simulation.end(), None);
/// ```
#[derive(Debug)]
pub struct Simulation<'a> {
    maze: &'a Maze,
    rules: &'a Ruleset,
    trace: &'a mut Trace,
    run: Run,
    cell: Cell,
    heading: Heading,
    /// Steps taken, by run.
    steps: [u32; 2],
    goal_reached: bool,
    finished: bool,
    counts: Counts,
}

impl<'a> Simulation<'a> {
    /// A match before its first step. Clears the trace.
    pub fn new(maze: &'a Maze, rules: &'a Ruleset, trace: &'a mut Trace) -> Self {
        trace.clear();
        Self {
            maze,
            rules,
            trace,
            run: Run::Exploration,
            cell: maze.start(),
            heading: Heading::Up,
            steps: [0; 2],
            goal_reached: false,
            finished: false,
            counts: Counts::default(),
        }
    }

    /// The run in progress.
    pub const fn run(&self) -> Run {
        self.run
    }

    /// Where the robot is.
    pub const fn cell(&self) -> Cell {
        self.cell
    }

    /// Where the robot looks.
    pub const fn heading(&self) -> Heading {
        self.heading
    }

    /// What has been counted so far.
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// Steps taken in that run; an accepted reset counts in run 1.
    pub const fn steps(&self, run: Run) -> u32 {
        self.steps[run as usize]
    }

    /// Steps taken in both runs.
    pub const fn steps_total(&self) -> u32 {
        self.steps[0] + self.steps[1]
    }

    /// Whether a step of run 1 has ended in the goal.
    pub const fn goal_reached(&self) -> bool {
        self.goal_reached
    }

    /// The readings at the robot's cell and heading.
    pub fn sense(&self) -> Sensors {
        let reach = |turn| self.maze.reach(self.cell, self.heading.turned(turn));
        Sensors {
            left: reach(Turn::Left),
            front: reach(Turn::Straight),
            right: reach(Turn::Right),
        }
    }

    /// How the match ended, or `None` while it goes on.
    pub fn end(&self) -> Option<End> {
        if self.finished {
            let [exploration, speed] = self.steps;
            let divisor = self.rules.exploration_divisor;
            return Some(End::Finished(Score::new(speed, exploration, divisor)));
        }
        let used = match self.rules.budget_scope {
            BudgetScope::BothRuns => self.steps_total(),
            BudgetScope::EachRun => self.steps(self.run),
        };
        (used >= self.rules.budget).then_some(End::BudgetUsedUp {
            goal_reached: self.goal_reached,
        })
    }

    /// Carries out one step and adds it to the trace.
    ///
    /// # Panics
    ///
    /// When the match has ended ([`Simulation::end`]).
    pub fn apply(&mut self, action: Action) -> Event {
        assert!(self.end().is_none(), "the match has ended");
        let (run, cell, heading) = (self.run, self.cell, self.heading);
        let sensors = self.sense();
        self.steps[run as usize] += 1;
        let event = match action {
            Action::Move { turn, advance } => self.drive(turn, advance),
            Action::Reset => self.reset(),
        };
        self.trace.push(Step {
            run,
            cell,
            heading,
            sensors,
            action,
            event,
        });
        event
    }

    fn drive(&mut self, turn: Turn, advance: i8) -> Event {
        self.heading = self.heading.turned(turn);
        let asked = advance.unsigned_abs();
        let allowed = asked.min(self.rules.longest_move);
        let direction = if advance < 0 {
            self.heading.opposite()
        } else {
            self.heading
        };
        let covered = allowed.min(self.maze.reach(self.cell, direction));
        self.cell = along(self.cell, direction, covered);
        let (bumped, clamped) = (covered < allowed, allowed < asked);
        self.counts.bumps += u32::from(bumped);
        self.counts.clamps += u32::from(clamped);
        if self.maze.goal().contains(self.cell) {
            match self.run {
                Run::Exploration => self.goal_reached = true,
                Run::Speed => self.finished = true,
            }
        }
        Event::Moved {
            cell: self.cell,
            heading: self.heading,
            cells: covered,
            bumped,
            clamped,
        }
    }

    fn reset(&mut self) -> Event {
        match self.run {
            Run::Speed => {
                self.counts.resets_in_speed_run += 1;
                Event::ResetInSpeedRun
            }
            Run::Exploration if !self.goal_reached => {
                self.counts.resets_before_goal += 1;
                Event::ResetBeforeGoal
            }
            Run::Exploration => {
                self.run = Run::Speed;
                self.cell = self.maze.start();
                self.heading = Heading::Up;
                Event::ResetDone
            }
        }
    }
}

/// The cell that many cells away; the caller knows that all of them are open.
const fn along(from: Cell, heading: Heading, cells: u8) -> Cell {
    match heading {
        Heading::Up => Cell::new(from.x, from.y + cells),
        Heading::Right => Cell::new(from.x + cells, from.y),
        Heading::Down => Cell::new(from.x, from.y - cells),
        Heading::Left => Cell::new(from.x - cells, from.y),
    }
}
