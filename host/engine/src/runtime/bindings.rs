//! What `wasmtime::component::bindgen!` makes of `wit/robot.wit`, and the conversions between
//! its types and those of the core.
//!
//! The macro reads the WIT file at compile time, so the host cannot drift from the interface.

use wasmouse_core::game::{Action, BudgetScope, Sensors};
use wasmouse_core::maze::{Cell, Heading, Turn};
use wasmouse_core::record::MatchSpec;

wasmtime::component::bindgen!({
    path: "../../wit",
    world: "robot",
});

pub use self::wasmouse::robot::{journal, types};

/// What a robot learns before its first step.
pub(crate) fn briefing(spec: &MatchSpec) -> types::Briefing {
    let (maze, rules) = (&spec.maze, &spec.rules.game);
    let goal = maze.goal();
    types::Briefing {
        dimension: maze.dimension().into(),
        start: cell(maze.start()),
        goal: types::Area {
            origin: cell(goal.origin()),
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
        seed: spec.key.seed,
        variant: spec.key.variant,
    }
}

fn cell(cell: Cell) -> types::Cell {
    types::Cell {
        x: cell.x.into(),
        y: cell.y.into(),
    }
}

/// The readings as the robot gets them.
pub(crate) fn sensors(sensors: Sensors) -> types::Sensors {
    types::Sensors {
        left: sensors.left.into(),
        front: sensors.front.into(),
        right: sensors.right.into(),
    }
}

/// What the robot does in a step.
pub(crate) const fn action(action: types::Action) -> Action {
    match action {
        types::Action::Move(step) => Action::Move {
            turn: match step.turn {
                types::Turn::Left => Turn::Left,
                types::Turn::Straight => Turn::Straight,
                types::Turn::Right => Turn::Right,
            },
            advance: step.advance,
        },
        types::Action::Reset => Action::Reset,
    }
}

/// A direction in the maze.
pub(super) const fn heading(heading: types::Heading) -> Heading {
    match heading {
        types::Heading::Up => Heading::Up,
        types::Heading::Right => Heading::Right,
        types::Heading::Down => Heading::Down,
        types::Heading::Left => Heading::Left,
    }
}
