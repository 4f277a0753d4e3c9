//! [`Audit`]: what a robot could have known at every step of a match.

use std::collections::VecDeque;

use super::known_walls::Knowledge;
use super::outlook::Outlook;
use super::walk::Walk;
use crate::game::{GameRules, Run, Steps, Trace, Verdict};
use crate::journal::{Belief, Journal, Note};
use crate::maze::{Cell, Heading, Maze, oracle_steps};

/// What could be known at one position of a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StepAudit {
    /// Walls that the reading there, and the step before it, showed for the first time.
    pub new_walls: u32,
    /// The bounds of the optimal speed run.
    pub outlook: Outlook,
}

/// The steps that a finished match took more than the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RegretSplit {
    /// Steps of the exploration run beyond those of the oracle.
    pub exploration_steps: u32,
    /// Steps of the speed run beyond the optimum.
    pub speed_steps: u32,
}

impl RegretSplit {
    /// The regret of a finished match; `None` if the goal is unreachable, or the steps are fewer
    /// than any match can have.
    pub fn new(maze: &Maze, rules: &GameRules, steps: Steps) -> Option<Self> {
        let oracle = oracle_steps(maze, rules.longest_move)?;
        Some(Self {
            exploration_steps: steps.exploration.checked_sub(oracle.exploration_steps)?,
            speed_steps: steps.speed.checked_sub(oracle.speed_steps)?,
        })
    }
}

/// A wall that the robot said something false about in its journal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contradiction {
    /// The step in which the robot said it: 0 in `start`, then counted from 1.
    pub step: u32,
    /// One of the two cells of the wall, or its only one.
    pub cell: Cell,
    /// The side of that cell.
    pub side: Heading,
    /// What the robot believes: open or closed. The maze has the opposite.
    pub belief: Belief,
    /// Whether the readings up to then show that it is false, so that the robot could have known.
    pub was_known: bool,
}

/// What a robot could have known at every step of a match, from its readings alone.
///
/// ```
/// use wasmouse_core::game::{Action, GameRules};
/// use wasmouse_core::journal::Journal;
/// use wasmouse_core::knowledge::Audit;
/// use wasmouse_core::maze::{Maze, Turn, Walls};
/// use wasmouse_core::record::{Transcript, trace};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let rules = GameRules::default();
/// let drive = |turn, advance| Action::Move { turn, advance };
/// let path = [
///     drive(Turn::Straight, 3),
///     drive(Turn::Straight, 2),
///     drive(Turn::Right, 3),
///     drive(Turn::Straight, 2),
/// ];
/// let mut transcript = Transcript::default();
/// for action in path.into_iter().chain([Action::Reset]).chain(path) {
///     transcript.push(action);
/// }
/// let (result, trace) = trace(&maze, &rules, &transcript).expect("a whole match");
/// let audit = Audit::new(&maze, &rules, &trace, &result.verdict, &Journal::default());
/// // From (0, 5) the robot sees the row of the goal, and no path is shorter than four steps.
/// assert_eq!(audit.certain_at, Some(2));
/// assert_eq!(audit.at_reset.map(|it| it.is_certain()), Some(true));
/// assert_eq!(audit.regret.map(|it| it.exploration_steps), Some(0));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Audit {
    /// For each position, from before the first step to after the last. After the end of a match
    /// a robot gets no reading, so the last entry repeats the one before it, unless the robot
    /// failed in the step that followed.
    pub steps: Vec<StepAudit>,
    /// The first position at which the best known path was certain to be optimal.
    pub certain_at: Option<usize>,
    /// The outlook with the last reading before the reset; `None` if there was no reset.
    pub at_reset: Option<Outlook>,
    /// Steps of the exploration run, without the reset, after which the readings showed nothing
    /// new.
    pub idle_steps: u32,
    /// Where a finished match lost steps to the oracle; `None` if it did not finish.
    pub regret: Option<RegretSplit>,
    /// False beliefs in the journal, in its order.
    pub contradictions: Vec<Contradiction>,
}

impl Audit {
    /// The audit of a match, from its trace.
    pub fn new(
        maze: &Maze,
        rules: &GameRules,
        trace: &Trace,
        verdict: &Verdict,
        journal: &Journal,
    ) -> Self {
        let mut walk = Walk::new(maze, trace, verdict);
        let mut claims = Claims::new(maze, journal);
        let mut steps: Vec<StepAudit> = Vec::with_capacity(trace.steps().len() + 1);
        claims.check(0, walk.knowledge());
        for position in 0..=trace.steps().len() {
            let new_walls = walk.advance();
            let outlook = match steps.last() {
                Some(last) if new_walls == 0 => last.outlook,
                _ => walk.knowledge().outlook(rules.longest_move),
            };
            steps.push(StepAudit { new_walls, outlook });
            // What is written in step n is written after the reading at position n - 1.
            claims.check(position + 1, walk.knowledge());
        }
        let reset = first_of(trace, Run::Speed);
        // The reading after the last step of a match, and that after the reset, is no step's.
        let explored = reset.unwrap_or(walk.readings());
        let idle = steps[..explored].iter().skip(1);
        Self {
            certain_at: steps.iter().position(|it| it.outlook.is_certain()),
            at_reset: reset.map(|reset| steps[reset - 1].outlook),
            idle_steps: narrow(idle.filter(|it| it.new_walls == 0).count()),
            regret: verdict
                .score()
                .and_then(|_| RegretSplit::new(maze, rules, steps_of(trace))),
            contradictions: claims.found,
            steps,
        }
    }
}

/// The position of the first reading in a run.
fn first_of(trace: &Trace, run: Run) -> Option<usize> {
    trace.steps().iter().position(|step| step.run == run)
}

fn steps_of(trace: &Trace) -> Steps {
    let all = trace.steps();
    let speed = all.iter().filter(|step| step.run == Run::Speed).count();
    Steps {
        exploration: narrow(all.len() - speed),
        speed: narrow(speed),
    }
}

fn narrow(count: usize) -> u32 {
    u32::try_from(count).expect("a match has at most 1,000,000 steps for each run")
}

/// The false beliefs of a journal, found as the match goes on.
struct Claims {
    /// Not checked yet, in order.
    ahead: VecDeque<Contradiction>,
    found: Vec<Contradiction>,
}

impl Claims {
    fn new(maze: &Maze, journal: &Journal) -> Self {
        let ahead = journal.entries().filter_map(|entry| {
            let Note::Wall { cell, side, belief } = entry.note else {
                return None;
            };
            // The journal ignores cells outside the maze.
            let inside = maze.walls().contains(cell);
            let is_false = inside
                && match belief {
                    Belief::Unknown => false,
                    Belief::Open => !maze.walls().is_open(cell, side),
                    Belief::Closed => maze.walls().is_open(cell, side),
                };
            is_false.then_some(Contradiction {
                step: entry.step,
                cell,
                side,
                belief,
                was_known: false,
            })
        });
        Self {
            ahead: ahead.collect(),
            found: Vec::new(),
        }
    }

    /// Moves what the robot wrote until `step` to those found.
    fn check(&mut self, step: usize, knowledge: &Knowledge) {
        while let Some(mut claim) = self.ahead.pop_front_if(|claim| claim.step as usize <= step) {
            claim.was_known = knowledge.wall(claim.cell, claim.side) != Belief::Unknown;
            self.found.push(claim);
        }
    }
}
