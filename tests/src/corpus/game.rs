//! Game: robots that are sound programs and play to no purpose, or to the last step.

use serde_json::{Value, json};
use wasmouse::maze::{self, Heading, Metric, Turn, format, shortest_path};

use super::case::{Case, harmless};
use crate::module::Module;

/// The cases 79 to 82.
pub fn cases() -> Vec<Case> {
    idle().into_iter().chain(exact()).collect()
}

/// A robot that answers these bytes by turns: turn and advance, or a reset.
fn in_turns(answers: &[Answer]) -> Vec<u8> {
    let bytes: String = answers.iter().map(|answer| answer.bytes()).collect();
    let count = answers.len();
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

/// What a robot answers, with the numbers of the WIT.
#[derive(Clone, Copy)]
enum Answer {
    Move { turn: u8, advance: i8 },
    Reset,
}

const LEFT: u8 = 0;
const STRAIGHT: u8 = 1;
const RIGHT: u8 = 2;

const fn go(turn: u8, advance: i8) -> Answer {
    Answer::Move { turn, advance }
}

impl Answer {
    fn bytes(self) -> String {
        match self {
            Self::Move { turn, advance } => {
                format!("\\00\\{turn:02x}\\{:02x}", advance.cast_unsigned())
            }
            Self::Reset => "\\01\\00\\00".to_owned(),
        }
    }
}

/// What a robot that never arrives is counted.
fn counts(bumps: u32, clamps: u32) -> Value {
    let mut expected = harmless();
    expected["bumps"] = json!(bumps);
    expected["clamps"] = json!(clamps);
    expected
}

fn idle() -> Vec<Case> {
    let case = |numbers, name: &str, expected, answers: Vec<Answer>| {
        Case::new(numbers, name, expected, move || in_turns(&answers))
    };
    vec![
        case(&[79], "always-turning", counts(0, 0), vec![go(LEFT, 0)]),
        case(&[79], "standing-still", counts(0, 0), vec![go(STRAIGHT, 0)]),
        case(
            &[80],
            "to-and-fro",
            counts(0, 0),
            vec![go(STRAIGHT, 1), go(STRAIGHT, -1)],
        ),
        case(
            &[81],
            "into-the-wall-on-the-left",
            counts(500, 0),
            vec![go(LEFT, 1), go(RIGHT, 0)],
        ),
        case(
            &[81],
            "into-the-wall-behind",
            counts(1000, 0),
            vec![go(STRAIGHT, -1)],
        ),
        // Up 11 cells to the wall in steps of 3, and down again.
        case(
            &[82],
            "movements-of-127-and-128",
            counts(2 * 125, 1000),
            vec![
                go(STRAIGHT, 127),
                go(STRAIGHT, 127),
                go(STRAIGHT, 127),
                go(STRAIGHT, 127),
                go(STRAIGHT, -128),
                go(STRAIGHT, -128),
                go(STRAIGHT, -128),
                go(STRAIGHT, -128),
            ],
        ),
        case(
            &[82],
            "movement-of-4-is-3",
            counts(0, 1000),
            vec![go(STRAIGHT, 4), go(STRAIGHT, -4)],
        ),
        case(
            &[82],
            "resets-for-ever",
            {
                let mut expected = harmless();
                expected["resets_before_goal"] = json!(1000);
                expected
            },
            vec![Answer::Reset],
        ),
    ]
}

/// A robot that knows the bundled maze, and needs exactly that many steps.
fn knowing(steps: usize, resets_before_goal: usize, resets_in_speed_run: usize) -> Vec<u8> {
    let path = shortest();
    let waits = steps - 2 * path.len() - 1 - resets_before_goal - resets_in_speed_run;
    let mut answers = vec![Answer::Reset; resets_before_goal];
    answers.extend(&path);
    // Waiting on the goal.
    answers.extend(vec![go(STRAIGHT, 0); waits]);
    answers.push(Answer::Reset);
    answers.extend(vec![Answer::Reset; resets_in_speed_run]);
    answers.extend(&path);
    assert_eq!(answers.len(), steps);
    in_turns(&answers)
}

/// The moves of the shortest path to the goal of the bundled maze.
fn shortest() -> Vec<Answer> {
    let maze = format::parse(maze::bundled()[0].text)
        .expect("bundled mazes parse")
        .maze;
    let path = shortest_path(&maze, Metric::STEPS).expect("bundled mazes have a solution");
    let mut heading = Heading::Up;
    path.moves()
        .map(|(next, cells)| {
            let advance = i8::try_from(cells).expect("at most the longest move");
            let turns = [
                (LEFT, Turn::Left),
                (STRAIGHT, Turn::Straight),
                (RIGHT, Turn::Right),
            ];
            let turn = turns
                .into_iter()
                .find(|(_, turn)| heading.turned(*turn) == next);
            let (turn, _) = turn.expect("shortest paths do not turn back");
            heading = next;
            go(turn, advance)
        })
        .collect()
}

fn exact() -> Vec<Case> {
    const SPEED: usize = 17;
    let finished = |steps: usize, speed: usize| {
        let exploration = steps - speed;
        // Thousandths, rounded to the nearest.
        let thirtieths = (exploration * 1000 + 15) / 30;
        #[expect(clippy::cast_precision_loss, reason = "below 2 to the 53 by far")]
        let score = (speed * 1000 + thirtieths) as f64 / 1000.0;
        json!({
            "verdict": "finished", "score": score,
            "exploration_steps": exploration, "speed_steps": speed,
        })
    };
    let mut with_lost_resets = finished(300, SPEED + 5);
    with_lost_resets["resets_before_goal"] = json!(3);
    with_lost_resets["resets_in_speed_run"] = json!(5);
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
                "verdict": "budget-used-up-goal-reached",
                "exploration_steps": 1001 - SPEED, "speed_steps": SPEED - 1,
            }),
            || knowing(1001, 0, 0),
        )
        .shown(),
        Case::new(&[82], "resets-that-are-refused", with_lost_resets, || {
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
