//! What `wasmtime::component::bindgen!` makes of `wit/robot.wit`, and the
//! conversions between its types and those of `maze` and `sim`.
//!
//! The macro reads the WIT file at compile time, so the host cannot drift from
//! the contract.

use crate::maze::{Cell, Heading, Turn};
use crate::sim::{self, BudgetScope, Ruleset};

wasmtime::component::bindgen!({
    path: "../wit",
    world: "robot",
});

pub use self::wasmouse::robot::{journal, types};

/// What a robot is told before its first step.
pub(super) fn briefing(
    maze: &crate::maze::Maze,
    rules: &Ruleset,
    seed: u64,
    setting: u32,
) -> types::Briefing {
    let goal = maze.goal();
    types::Briefing {
        dimension: maze.dimension().into(),
        start: maze.start().into(),
        goal: types::Area {
            origin: goal.origin().into(),
            width: goal.width().into(),
            height: goal.height().into(),
        },
        budget: rules.budget,
        budget_scope: match rules.budget_scope {
            BudgetScope::BothRuns => types::BudgetScope::BothRuns,
            BudgetScope::EachRun => types::BudgetScope::EachRun,
        },
        longest_move: rules.longest_move.into(),
        units_per_cell: 1,
        exploration_divisor: rules.exploration_divisor,
        seed,
        variant: setting,
    }
}

impl From<Cell> for types::Cell {
    fn from(cell: Cell) -> Self {
        Self {
            x: cell.x.into(),
            y: cell.y.into(),
        }
    }
}

impl From<sim::Sensors> for types::Sensors {
    fn from(sensors: sim::Sensors) -> Self {
        Self {
            left: sensors.left.into(),
            front: sensors.front.into(),
            right: sensors.right.into(),
        }
    }
}

impl From<types::Action> for sim::Action {
    fn from(action: types::Action) -> Self {
        match action {
            types::Action::Move(step) => Self::Move {
                turn: match step.turn {
                    types::Turn::Left => Turn::Left,
                    types::Turn::Straight => Turn::Straight,
                    types::Turn::Right => Turn::Right,
                },
                advance: step.advance,
            },
            types::Action::Reset => Self::Reset,
        }
    }
}

impl From<types::Heading> for Heading {
    fn from(heading: types::Heading) -> Self {
        match heading {
            types::Heading::Up => Self::Up,
            types::Heading::Right => Self::Right,
            types::Heading::Down => Self::Down,
            types::Heading::Left => Self::Left,
        }
    }
}
