//! [`Simulation`]: one match's state, sensors and motion.
//!
//! Exactly the contest of the reports as its public tester plays it: games
//! recorded from that tester replay through [`Simulation::apply`] in the tests.

use serde::{Deserialize, Serialize};

use super::{
    Action, BudgetScope, Fault, FaultKind, GameRules, Phase, Run, Sensors, Steps, Verdict,
};
use crate::maze::{Cell, Heading, Maze, Turn};

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
        /// The action was beyond the longest move.
        clamped: bool,
    },
    /// The exploration run ended and the speed run began at the start, heading up.
    Reset,
    /// A reset before the goal was reached: ignored, and the step is lost.
    ResetBeforeGoal,
    /// A reset in the speed run: ignored, and the step is lost.
    ResetInSpeedRun,
}

/// What a match counts besides its steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// Steps that ended early at a wall.
    pub bumps: u32,
    /// Moves beyond the longest move.
    pub clamps: u32,
    /// Resets ignored because the exploration run had not reached the goal.
    pub resets_before_goal: u32,
    /// Resets ignored because the speed run had begun.
    pub resets_in_speed_run: u32,
}

/// One match in progress.
///
/// ```
/// use wasmouse_core::maze::{Maze, Turn, Walls};
/// use wasmouse_core::game::{Action, GameRules, Simulation};
///
/// let maze = Maze::contest(Walls::open(12)).expect("a legal start and goal");
/// let rules = GameRules::default();
/// let mut simulation = Simulation::new(&maze, &rules);
/// assert_eq!(simulation.sense().front, 11);
/// simulation.apply(Action::Move { turn: Turn::Right, advance: 3 });
/// assert_eq!((simulation.cell().x, simulation.cell().y), (3, 0));
/// assert!(!simulation.has_ended());
/// ```
#[derive(Clone, Debug)]
pub struct Simulation<'a> {
    maze: &'a Maze,
    rules: &'a GameRules,
    run: Run,
    cell: Cell,
    heading: Heading,
    steps: Steps,
    goal_reached: bool,
    finished: bool,
    counts: Counts,
}

impl<'a> Simulation<'a> {
    /// A match before its first step.
    pub fn new(maze: &'a Maze, rules: &'a GameRules) -> Self {
        Self {
            maze,
            rules,
            run: Run::Exploration,
            cell: maze.start(),
            heading: Heading::Up,
            steps: Steps::default(),
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

    /// Steps taken so far; a reset that is not ignored counts in the exploration run.
    pub const fn steps(&self) -> Steps {
        self.steps
    }

    /// Whether a step of the exploration run has ended in the goal.
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

    /// Whether the rules have ended the match.
    pub const fn has_ended(&self) -> bool {
        let used = match self.rules.budget_scope {
            BudgetScope::BothRuns => self.steps.total(),
            BudgetScope::EachRun => self.steps.of(self.run),
        };
        self.finished || used >= self.rules.budget
    }

    /// The verdict of a match that the rules have ended, or `None` while it goes on.
    pub fn verdict(&self) -> Option<Verdict> {
        if self.finished {
            let score = self.rules.score(self.steps.speed, self.steps.exploration);
            return Some(Verdict::Finished { score });
        }
        self.has_ended().then_some(Verdict::BudgetUsedUp {
            goal_reached: self.goal_reached,
        })
    }

    /// The fault of a robot that failed where the match is now.
    pub fn fault(&self, kind: FaultKind, phase: Phase, detail: String) -> Fault {
        Fault {
            kind,
            phase,
            run: self.run,
            step: match phase {
                Phase::NextMove => self.steps.total() + 1,
                Phase::Instantiate | Phase::Start | Phase::Unknown => 0,
            },
            cell: self.cell,
            detail,
        }
    }

    /// Carries out one step.
    ///
    /// # Panics
    ///
    /// When the match has ended ([`Simulation::has_ended`]).
    pub fn apply(&mut self, action: Action) -> Event {
        assert!(!self.has_ended(), "the match has ended");
        match self.run {
            Run::Exploration => self.steps.exploration += 1,
            Run::Speed => self.steps.speed += 1,
        }
        match action {
            Action::Move { turn, advance } => self.drive(turn, advance),
            Action::Reset => self.reset(),
        }
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
                Event::Reset
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
