//! Game: correct programs that play without purpose, or to the last step.

use serde_json::{Value, json};
use wasmouse_core::game::Action;
use wasmouse_core::maze::{self, Heading, Metric, Turn, format, shortest_path};

use super::binary::escaped;
use super::case::{Case, harmless};
use crate::module::Module;

/// The cases 79 to 82.
pub fn cases() -> Vec<Case> {
    idle().into_iter().chain(exact()).collect()
}

/// A robot that performs these actions, again and again.
fn performing(actions: &[Action]) -> Vec<u8> {
    let bytes: String = actions.iter().map(bytes).collect();
    let count = actions.len();
    Module {
        memory: r#"(memory (export "memory") 2)"#,
        rest: &format!(
            r#"(global $step (mut i32) (i32.const -1)) (data (i32.const 1024) "{bytes}")"#
        ),
        next: &format!(
            "(global.set $step (i32.rem_u
                (i32.add (global.get $step) (i32.const 1)) (i32.const {count})))
             (i32.add (i32.const 1024) (i32.mul (global.get $step) (i32.const 3)))"
        ),
        ..Module::default()
    }
    .component()
}

/// An action as `next-move` returns it.
fn bytes(action: &Action) -> String {
    escaped(&match *action {
        Action::Move { turn, advance } => [0, turn as u8, advance.cast_unsigned()],
        Action::Reset => [1, 0, 0],
    })
}

const fn go(turn: Turn, advance: i8) -> Action {
    Action::Move { turn, advance }
}

/// The counts of a robot that never arrives.
fn counts(bumps: u32, clamps: u32) -> Value {
    let mut expected = harmless();
    expected["counts"]["bumps"] = json!(bumps);
    expected["counts"]["clamps"] = json!(clamps);
    expected
}

fn idle() -> Vec<Case> {
    let case = |numbers, name: &str, expected, actions: Vec<Action>| {
        Case::new(numbers, name, expected, move || performing(&actions))
    };
    vec![
        case(
            &[79],
            "always-turning",
            counts(0, 0),
            vec![go(Turn::Left, 0)],
        ),
        case(
            &[79],
            "standing-still",
            counts(0, 0),
            vec![go(Turn::Straight, 0)],
        ),
        case(
            &[80],
            "to-and-fro",
            counts(0, 0),
            vec![go(Turn::Straight, 1), go(Turn::Straight, -1)],
        ),
        case(
            &[81],
            "into-the-wall-on-the-left",
            counts(500, 0),
            vec![go(Turn::Left, 1), go(Turn::Right, 0)],
        ),
        case(
            &[81],
            "into-the-wall-behind",
            counts(1000, 0),
            vec![go(Turn::Straight, -1)],
        ),
        // Up 11 cells to the wall in steps of 3, and down again.
        case(
            &[82],
            "movements-of-127-and-128",
            counts(2 * 125, 1000),
            [[go(Turn::Straight, 127); 4], [go(Turn::Straight, -128); 4]].concat(),
        ),
        case(
            &[82],
            "movement-of-4-is-3",
            counts(0, 1000),
            vec![go(Turn::Straight, 4), go(Turn::Straight, -4)],
        ),
        case(
            &[82],
            "resets-for-ever",
            {
                let mut expected = harmless();
                expected["counts"]["resets_before_goal"] = json!(1000);
                expected
            },
            vec![Action::Reset],
        ),
    ]
}

/// A robot that knows the bundled maze, and needs exactly that many steps.
fn knowing(steps: usize, resets_before_goal: usize, resets_in_speed_run: usize) -> Vec<u8> {
    let path = shortest();
    let waits = steps - 2 * path.len() - 1 - resets_before_goal - resets_in_speed_run;
    let mut actions = vec![Action::Reset; resets_before_goal];
    actions.extend(&path);
    // Waiting on the goal.
    actions.extend(vec![go(Turn::Straight, 0); waits]);
    actions.push(Action::Reset);
    actions.extend(vec![Action::Reset; resets_in_speed_run]);
    actions.extend(&path);
    assert_eq!(actions.len(), steps);
    performing(&actions)
}

/// The moves of the shortest path to the goal of the bundled maze.
fn shortest() -> Vec<Action> {
    let maze = format::parse(maze::bundled()[0].text)
        .expect("bundled mazes parse")
        .maze;
    let path = shortest_path(&maze, Metric::STEPS).expect("bundled mazes have a solution");
    let mut heading = Heading::Up;
    let moves = path.moves().map(|(next, cells)| {
        let advance = i8::try_from(cells).expect("at most the longest move");
        let turns = [Turn::Left, Turn::Straight, Turn::Right];
        let turn = turns.into_iter().find(|turn| heading.turned(*turn) == next);
        heading = next;
        go(turn.expect("shortest paths do not turn back"), advance)
    });
    moves.collect()
}

fn exact() -> Vec<Case> {
    const SPEED: usize = 17;
    let finished = |steps: usize, speed: usize| {
        let exploration = steps - speed;
        // Rounded to the nearest.
        let thousandths = speed * 1000 + (exploration * 1000 + 15) / 30;
        json!({
            "verdict": {"kind": "finished", "score": {"thousandths": thousandths}},
            "steps": {"exploration": exploration, "speed": speed},
        })
    };
    let mut with_lost_resets = finished(300, SPEED + 5);
    with_lost_resets["counts"]["resets_before_goal"] = json!(3);
    with_lost_resets["counts"]["resets_in_speed_run"] = json!(5);
    vec![
        Case::new(&[82], "exactly-999-calls", finished(999, SPEED), || {
            knowing(999, 0, 0)
        }),
        Case::new(&[82], "exactly-1000-calls", finished(1000, SPEED), || {
            knowing(1000, 0, 0)
        }),
        Case::new(
            &[82],
            "exactly-1001-calls",
            json!({
                "verdict": {"kind": "budget-used-up", "goal_reached": true},
                "steps": {"exploration": 1001 - SPEED, "speed": SPEED - 1},
            }),
            || knowing(1001, 0, 0),
        )
        .shown(),
        Case::new(&[82], "resets-that-are-ignored", with_lost_resets, || {
            knowing(300, 3, 5)
        }),
        Case::new(
            &[82],
            "as-fast-as-possible",
            finished(2 * SPEED + 1, SPEED),
            || knowing(2 * SPEED + 1, 0, 0),
        ),
    ]
}
