//! The rules of the game: recorded games of the contest's own tester, and games
//! written by hand, replay through the simulation.

use std::fs;

use serde_json::{Value, json};
use wasmouse::maze::format::{self, Format};
use wasmouse::maze::{Heading, Turn};
use wasmouse::sim::{Action, BudgetScope, End, Ruleset, Run, Simulation, Trace};

use crate::shared::shared;

#[test]
fn recorded_games_replay_exactly() {
    let Some(shared) = shared() else {
        return;
    };
    let text = fs::read_to_string(shared.join("conformance/scripted.jsonl"))
        .expect("the vectors can be read");
    let vectors: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).expect("a vector a line"))
        .collect();
    let scores = vectors.iter().filter(|vector| vector["score"].is_string());
    assert_eq!((vectors.len(), scores.count()), (96, 34));
    vectors.iter().for_each(check_vector);
}

fn check_vector(vector: &Value) {
    let name = &vector["name"];
    let text = vector["maze"].as_str().expect("a maze");
    let maze = format::parse_as(text, Format::Udacity)
        .unwrap_or_else(|error| panic!("{name}: {error}"))
        .maze;
    let rules = Ruleset::default();
    let mut trace = Trace::default();
    let mut simulation = Simulation::new(&maze, &rules, &mut trace);

    let steps = vector["steps"].as_array().expect("a list of steps");
    for (index, step) in steps.iter().enumerate() {
        assert_eq!(simulation.end(), None, "{name}, step {index}");
        let before = json!([
            simulation.run().number(),
            simulation.cell().x,
            simulation.cell().y,
            simulation.heading().name(),
            simulation.sense().left,
            simulation.sense().front,
            simulation.sense().right,
            step[7],
        ]);
        assert_eq!(&before, step, "{name}, step {index}");
        simulation.apply(recorded_action(&step[7]));
    }

    let end = simulation.end();
    let score = match end {
        Some(End::Finished(score)) => Some(score),
        Some(End::BudgetUsedUp { .. }) => None,
        None => panic!("{name}: the recorded game is over and the simulation goes on"),
    };
    let (at, heading) = final_state(&simulation);
    let counts = simulation.counts();
    for (field, found) in [
        (
            "run_steps",
            json!(completed_runs(&simulation, score.is_some())),
        ),
        ("score", json!(score.map(|score| score.to_string()))),
        ("finished", json!(score.is_some())),
        ("final_at", json!(at)),
        ("final_heading", json!(heading.name())),
        ("bumps", json!(counts.bumps)),
        ("clamps", json!(counts.clamps)),
        ("resets_before_goal", json!(counts.resets_before_goal)),
        ("resets_in_run_2", json!(counts.resets_in_speed_run)),
    ] {
        assert_eq!(found, vector[field], "{name}, {field}");
    }
}

/// Where the tester leaves the robot. When the budget is used up in run 1 it
/// still sets up run 2, and finds then that no call is left for it.
fn final_state(simulation: &Simulation<'_>) -> ([u8; 2], Heading) {
    match simulation.run() {
        Run::Exploration => ([0, 0], Heading::Up),
        Run::Speed => {
            let cell = simulation.cell();
            ([cell.x, cell.y], simulation.heading())
        }
    }
}

fn completed_runs(simulation: &Simulation<'_>, finished: bool) -> Vec<u32> {
    let explored = simulation.run() == Run::Speed;
    [(explored, Run::Exploration), (finished, Run::Speed)]
        .into_iter()
        .filter(|(completed, _)| *completed)
        .map(|(_, run)| simulation.steps(run))
        .collect()
}

fn recorded_action(value: &Value) -> Action {
    if value == "reset" {
        return Action::Reset;
    }
    let turn = match value[0].as_i64() {
        Some(-90) => Turn::Left,
        Some(0) => Turn::Straight,
        Some(90) => Turn::Right,
        other => panic!("the rotation {other:?}"),
    };
    let advance = value[1].as_i64().expect("a movement");
    let advance = advance.try_into().expect("a movement in -128..=127");
    Action::Move { turn, advance }
}

/// A maze in which the goal can be driven through from side to side.
const THOROUGHFARE: &str = "
o---o---o---o---o
|               |
o   o---o---o   o
|   | G   G |   |
o   o   o   o   o
|     G   G     |
o   o---o---o   o
| S |           |
o---o---o---o---o
";

/// Plays a script in [`THOROUGHFARE`] and compares the state after it.
///
/// A script has words like `R3` (turn right, drive 3), `L0`, `S-1` or `reset`;
/// `S0*9` is nine times `S0`.
#[track_caller]
fn check(scope: BudgetScope, script: &str, expected: &str) {
    let maze = format::parse(THOROUGHFARE.trim_start())
        .expect("the maze above is one")
        .maze;
    let rules = Ruleset::all()
        .into_iter()
        .find(|rules| rules.budget_scope == scope)
        .expect("a ruleset for each scope");
    let mut trace = Trace::default();
    let mut simulation = Simulation::new(&maze, &rules, &mut trace);
    for (number, action) in (1..).zip(actions(script)) {
        assert_eq!(simulation.end(), None, "before call {number}");
        simulation.apply(action);
    }
    assert_eq!(state(&simulation), expected, "after `{script}`");
}

fn state(simulation: &Simulation<'_>) -> String {
    let end = match simulation.end() {
        None => "goes on".to_owned(),
        Some(End::Finished(score)) => format!("finished {score}"),
        Some(End::BudgetUsedUp { goal_reached }) => format!("used up, goal {goal_reached}"),
    };
    let counts = simulation.counts();
    format!(
        "run {} {} {}, steps {}+{}, bumps {}, clamps {}, refused {}+{}, {end}",
        simulation.run().number(),
        simulation.cell(),
        simulation.heading().name(),
        simulation.steps(Run::Exploration),
        simulation.steps(Run::Speed),
        counts.bumps,
        counts.clamps,
        counts.resets_before_goal,
        counts.resets_in_speed_run,
    )
}

fn actions(script: &str) -> impl Iterator<Item = Action> {
    script.split_whitespace().flat_map(|word| {
        let (word, times) = word.split_once('*').unwrap_or((word, "1"));
        let times = times.parse().expect("how many times");
        std::iter::repeat_n(action(word), times)
    })
}

fn action(word: &str) -> Action {
    if word == "reset" {
        return Action::Reset;
    }
    let (turn, advance) = word.split_at(1);
    let turn = match turn {
        "L" => Turn::Left,
        "S" => Turn::Straight,
        "R" => Turn::Right,
        _ => panic!("`{word}` is no action"),
    };
    let advance = advance.parse().expect("a movement in -128..=127");
    Action::Move { turn, advance }
}

#[test]
fn moves() {
    let check = |script, expected| check(BudgetScope::BothRuns, script, expected);
    // A wall stops the robot; the cells covered so far stay covered.
    check(
        "S3 R2 S3",
        "run 1 (3, 3) right, steps 3+0, bumps 1, clamps 0, refused 0+0, goes on",
    );
    // A wall at once: a bump too, and the turn counts.
    check(
        "R1",
        "run 1 (0, 0) right, steps 1+0, bumps 1, clamps 0, refused 0+0, goes on",
    );
    // Turning on the spot is no bump.
    check(
        "R0 R0 L0",
        "run 1 (0, 0) right, steps 3+0, bumps 0, clamps 0, refused 0+0, goes on",
    );
    // Backwards keeps the heading.
    check(
        "S3 S-2",
        "run 1 (0, 1) up, steps 2+0, bumps 0, clamps 0, refused 0+0, goes on",
    );
    check(
        "S1 S-3",
        "run 1 (0, 0) up, steps 2+0, bumps 1, clamps 0, refused 0+0, goes on",
    );
    // The largest and the smallest movement are clamped to three cells.
    check(
        "S127 S-128",
        "run 1 (0, 0) up, steps 2+0, bumps 0, clamps 2, refused 0+0, goes on",
    );
    check(
        "S1 S4",
        "run 1 (0, 3) up, steps 2+0, bumps 1, clamps 1, refused 0+0, goes on",
    );
    check(
        "S3 S-4",
        "run 1 (0, 0) up, steps 2+0, bumps 0, clamps 1, refused 0+0, goes on",
    );
}

#[test]
fn goal_and_resets() {
    let check = |script, expected| check(BudgetScope::BothRuns, script, expected);
    // Driving through the goal does not count, so the reset is refused.
    check(
        "S1 R3 reset",
        "run 1 (3, 1) right, steps 3+0, bumps 0, clamps 0, refused 1+0, goes on",
    );
    // Ending in it does; run 1 goes on until the reset, which is a step of it.
    check(
        "S1 R2 S1",
        "run 1 (3, 1) right, steps 3+0, bumps 0, clamps 0, refused 0+0, goes on",
    );
    check(
        "S1 R2 S1 reset",
        "run 2 (0, 0) up, steps 4+0, bumps 0, clamps 0, refused 0+0, goes on",
    );
    // Nor does driving through end run 2; ending there does: 2 + 3/30 and 4 + 3/30.
    check(
        "S1 R2 reset S1 R1",
        "run 2 (1, 1) right, steps 3+2, bumps 0, clamps 0, refused 0+0, finished 2.100",
    );
    check(
        "S1 R2 reset S1 R3 S0 S-1",
        "run 2 (2, 1) right, steps 3+4, bumps 0, clamps 0, refused 0+0, finished 4.100",
    );
    // A bump in the goal ends there.
    check(
        "S1 R2 L3 reset",
        "run 2 (0, 0) up, steps 4+0, bumps 1, clamps 0, refused 0+0, goes on",
    );
    // A second reset loses a step of run 2.
    check(
        "S1 R2 reset reset S1 reset",
        "run 2 (0, 1) up, steps 3+3, bumps 0, clamps 0, refused 0+2, goes on",
    );
}

#[test]
fn the_budget_is_for_both_runs() {
    let check = |script, expected| check(BudgetScope::BothRuns, script, expected);
    check(
        "S0*999",
        "run 1 (0, 0) up, steps 999+0, bumps 0, clamps 0, refused 0+0, goes on",
    );
    // Call 1000 is executed, and there is no call 1001.
    check(
        "S0*999 S1",
        "run 1 (0, 1) up, steps 1000+0, bumps 0, clamps 0, refused 0+0, used up, goal false",
    );
    check(
        "S1 R2 S0*997 reset",
        "run 2 (0, 0) up, steps 1000+0, bumps 0, clamps 0, refused 0+0, used up, goal true",
    );
    check(
        "S1 R2 reset S0*995 S1 R2",
        "run 2 (2, 1) right, steps 3+997, bumps 0, clamps 0, refused 0+0, finished 997.100",
    );
    check(
        "S1 R2 reset S0*996 S1",
        "run 2 (0, 1) up, steps 3+997, bumps 0, clamps 0, refused 0+0, used up, goal true",
    );
}

#[test]
fn the_variant_gives_each_run_a_budget() {
    let check = |script, expected| check(BudgetScope::EachRun, script, expected);
    check(
        "S0*1000",
        "run 1 (0, 0) up, steps 1000+0, bumps 0, clamps 0, refused 0+0, used up, goal false",
    );
    check(
        "S1 R2 S0*997 reset S0*999",
        "run 2 (0, 0) up, steps 1000+999, bumps 0, clamps 0, refused 0+0, goes on",
    );
    check(
        "S1 R2 S0*997 reset S0*998 S1 R1",
        "run 2 (1, 1) right, steps 1000+1000, bumps 0, clamps 0, refused 0+0, finished 1033.333",
    );
    check(
        "S1 R2 reset S0*1000",
        "run 2 (0, 0) up, steps 3+1000, bumps 0, clamps 0, refused 0+0, used up, goal true",
    );
}

#[test]
#[should_panic(expected = "the match has ended")]
fn no_call_follows_the_last() {
    check_past_the_end("S0*1001");
}

#[test]
#[should_panic(expected = "the match has ended")]
fn no_call_follows_the_finish() {
    check_past_the_end("S1 R2 reset S1 R1 S0");
}

/// Plays a script without looking whether the match is over.
fn check_past_the_end(script: &str) {
    let parsed = format::parse(THOROUGHFARE.trim_start()).expect("the maze above is one");
    let rules = Ruleset::default();
    let mut trace = Trace::default();
    let mut simulation = Simulation::new(&parsed.maze, &rules, &mut trace);
    for action in actions(script) {
        simulation.apply(action);
    }
}
