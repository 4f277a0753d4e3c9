//! [`Milestone`]: what happens in a match that a viewer wants to jump to.

use crate::game::{Event, Run, Trace};
use crate::knowledge::Audit;
use crate::maze::Maze;

/// Something that happened in a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Milestone {
    /// The position: after this many steps.
    pub position: usize,
    /// What happened.
    pub kind: MilestoneKind,
}

/// What a milestone marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MilestoneKind {
    /// The best known path is certain to be optimal from here.
    Certain,
    /// A step of the exploration run ended in the goal for the first time.
    GoalReached,
    /// The speed run starts.
    Reset,
    /// A reset was ignored.
    IgnoredReset,
    /// A wall stopped the robot.
    Bump,
    /// A move was longer than the rules allow.
    Clamp,
    /// The match ended.
    End,
}

impl MilestoneKind {
    /// All kinds, in their order. The page's core identifies a kind by its index.
    pub const ALL: [Self; 7] = [
        Self::Certain,
        Self::GoalReached,
        Self::Reset,
        Self::IgnoredReset,
        Self::Bump,
        Self::Clamp,
        Self::End,
    ];

    /// The kind in a few words for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Certain => "best path certain",
            Self::GoalReached => "goal reached",
            Self::Reset => "reset",
            Self::IgnoredReset => "reset ignored",
            Self::Bump => "bump",
            Self::Clamp => "move clamped",
            Self::End => "end",
        }
    }
}

/// The milestones of a match, in the order of their positions.
pub(super) fn find(maze: &Maze, trace: &Trace, audit: &Audit) -> Vec<Milestone> {
    let mut milestones = Vec::new();
    let mut goal_reached = false;
    let mut add = |position, kind| milestones.push(Milestone { position, kind });
    if audit.certain_at == Some(0) {
        add(0, MilestoneKind::Certain);
    }
    for (index, step) in trace.steps().iter().enumerate() {
        let position = index + 1;
        if audit.certain_at == Some(position) {
            add(position, MilestoneKind::Certain);
        }
        match step.event {
            Event::Moved {
                cell,
                bumped,
                clamped,
                ..
            } => {
                let in_goal = step.run == Run::Exploration && maze.goal().contains(cell);
                if in_goal && !goal_reached {
                    goal_reached = true;
                    add(position, MilestoneKind::GoalReached);
                }
                if bumped {
                    add(position, MilestoneKind::Bump);
                }
                if clamped {
                    add(position, MilestoneKind::Clamp);
                }
            }
            Event::Reset => add(position, MilestoneKind::Reset),
            Event::ResetBeforeGoal | Event::ResetInSpeedRun => {
                add(position, MilestoneKind::IgnoredReset);
            }
        }
    }
    add(trace.steps().len(), MilestoneKind::End);
    milestones
}
