//! A robot written with `wit_bindgen::generate!` alone: the WIT works without the SDK.
//!
//! The functions that the generator exports are called here as the host calls them, with
//! plain numbers, so the test also holds the binary interface that `wit/README.md` promises.

use std::cell::Cell;

use bindings::exports::wasmouse::robot::controller::{
    _export_next_move_cabi, _export_start_cabi, Guest,
};
use bindings::wasmouse::robot::types::{
    Action, Area, Briefing, BudgetScope, Cell as MazeCell, Move, Sensors, Turn,
};

/// What a project without the SDK has in its sources.
mod bindings {
    wit_bindgen::generate!({
        path: "../wit",
        world: "robot",
        additional_derives: [PartialEq],
    });
}

thread_local! {
    static BRIEFING: Cell<Option<Briefing>> = const { Cell::new(None) };
}

/// Drives as far ahead as it may and turns where it cannot; resets where all is open.
struct Robot;

impl Guest for Robot {
    fn start(briefing: Briefing) {
        BRIEFING.set(Some(briefing));
    }

    fn next_move(sensors: Sensors) -> Action {
        let longest_move = BRIEFING.get().map_or(0, |briefing| briefing.longest_move);
        if sensors.left > 0 && sensors.right > 0 {
            return Action::Reset;
        }
        let turn = match sensors {
            Sensors { front: 1.., .. } => Turn::Straight,
            Sensors { left: 1.., .. } => Turn::Left,
            _ => Turn::Right,
        };
        let wish = if turn == Turn::Straight {
            sensors.front
        } else {
            1
        };
        let advance = i8::try_from(wish.min(longest_move)).unwrap_or(i8::MAX);
        Action::Move(Move { turn, advance })
    }
}

#[test]
fn start_takes_fourteen_numbers_in_the_order_of_the_wit() {
    // SAFETY: the function takes numbers only, and any enumeration's number is in range.
    unsafe {
        _export_start_cabi::<Robot>(16, 1, 2, 7, 8, 2, 2, 1000, 1, 3, 1, 30, 42, 5);
    }
    let expected = Briefing {
        dimension: 16,
        start: MazeCell { x: 1, y: 2 },
        goal: Area {
            origin: MazeCell { x: 7, y: 8 },
            width: 2,
            height: 2,
        },
        budget: 1000,
        budget_scope: BudgetScope::EachRun,
        longest_move: 3,
        units_per_cell: 1,
        exploration_divisor: 30,
        seed: 42,
        variant: 5,
    };
    assert_eq!(BRIEFING.get(), Some(expected));
}

/// Case, turn and distance: three bytes without padding.
#[track_caller]
fn check_action([left, front, right]: [i32; 3], expected: &[u8]) {
    // SAFETY: the function takes numbers only. It returns a pointer to static memory, which
    // has as many bytes as the case has.
    let bytes = unsafe {
        let answer = _export_next_move_cabi::<Robot>(left, front, right);
        std::slice::from_raw_parts(answer, expected.len())
    };
    assert_eq!(bytes, expected);
}

#[test]
fn an_action_takes_three_bytes() {
    // SAFETY: as above.
    unsafe {
        _export_start_cabi::<Robot>(16, 0, 0, 7, 7, 2, 2, 1000, 0, 3, 1, 30, 0, 0);
    }
    check_action([0, 2, 0], &[0, 1, 2]);
    check_action([1, 0, 0], &[0, 0, 1]);
    check_action([0, 0, 0], &[0, 2, 1]);
    check_action([1, 5, 1], &[1]);
}
