//! [`Simulation`]: the state, the sensors and the motion of a match.
//!
//! It implements the contest of the reports exactly as its public tester does: in the tests,
//! matches that were recorded from that tester replay through [`Simulation::apply`].

use serde::{Deserialize, Serialize};

use super::{
    Action, BudgetScope, Fault, FaultKind, GameRules, Phase, Run, Sensors, Steps, Verdict,
};
use crate::guest_text::GuestText;
use crate::maze::{Cell, Heading, Maze, Turn};

/// The effect of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Event {
    /// The robot turned and moved.
    Moved {
        /// The cell at the end of the step.
        cell: Cell,
        /// The heading after the turn.
        heading: Heading,
        /// Cells driven; fewer than requested if the robot bumped or the move was clamped.
        cells: u8,
        /// Whether a wall stopped the robot.
        bumped: bool,
        /// Whether the action exceeded the longest move.
        clamped: bool,
    },
    /// The exploration run ended; the speed run starts at the start of the maze, heading up.
    Reset,
    /// An ignored reset: the exploration run has not reached the goal. The step counts.
    ResetBeforeGoal,
    /// An ignored reset: the speed run has started. The step counts.
    ResetInSpeedRun,
}

/// Counts of a match besides its steps. Serialises as an object with these fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// Moves that a wall stopped.
    pub bumps: u32,
    /// Moves that were clamped to the longest move.
    pub clamps: u32,
    /// Ignored resets before the exploration run reached the goal.
    pub resets_before_goal: u32,
    /// Ignored resets in the speed run.
    pub resets_in_speed_run: u32,
}

/// A match in progress.
///
/// ```
/// use wasmouse_core::maze::{Maze, Turn, Walls};
/// use wasmouse_core::game::{Action, GameRules, Simulation};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
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

    /// The robot's cell.
    pub const fn cell(&self) -> Cell {
        self.cell
    }

    /// The robot's heading.
    pub const fn heading(&self) -> Heading {
        self.heading
    }

    /// The counts so far.
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// The steps so far. The reset that ends the exploration run is a step of it.
    pub const fn steps(&self) -> Steps {
        self.steps
    }

    /// Whether a step of the exploration run has ended in the goal.
    pub const fn goal_reached(&self) -> bool {
        self.goal_reached
    }

    /// The readings at the robot's cell and heading.
    pub fn sense(&self) -> Sensors {
        Sensors::at(self.maze, self.cell, self.heading)
    }

    /// Whether the match has ended: finished, or its budget used up.
    pub const fn has_ended(&self) -> bool {
        let used = match self.rules.budget_scope {
            BudgetScope::BothRuns => self.steps.total(),
            BudgetScope::EachRun => self.steps.of(self.run),
        };
        self.finished || used >= self.rules.budget
    }

    /// The verdict of a match that has ended by the rules; `None` if it has not.
    pub fn verdict(&self) -> Option<Verdict> {
        if self.finished {
            let score = self.rules.score(self.steps.speed, self.steps.exploration);
            return Some(Verdict::Finished { score });
        }
        self.has_ended().then_some(Verdict::BudgetUsedUp {
            goal_reached: self.goal_reached,
        })
    }

    /// A fault of the robot at this point of the match.
    pub fn fault(&self, kind: FaultKind, phase: Phase, detail: GuestText) -> Fault {
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

    /// Plays one step.
    ///
    /// # Panics
    ///
    /// If the match has ended ([`Simulation::has_ended`]).
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
        let requested = advance.unsigned_abs();
        let allowed = requested.min(self.rules.longest_move);
        let direction = if advance < 0 {
            self.heading.opposite()
        } else {
            self.heading
        };
        let driven = allowed.min(self.maze.reach(self.cell, direction));
        self.cell = along(self.cell, direction, driven);
        let (bumped, clamped) = (driven < allowed, allowed < requested);
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
            cells: driven,
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

/// The cell at that distance, which the caller knows to be in the maze.
const fn along(from: Cell, heading: Heading, cells: u8) -> Cell {
    match heading {
        Heading::Up => Cell::new(from.x, from.y + cells),
        Heading::Right => Cell::new(from.x + cells, from.y),
        Heading::Down => Cell::new(from.x, from.y - cells),
        Heading::Left => Cell::new(from.x - cells, from.y),
    }
}
