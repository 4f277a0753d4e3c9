//! The rules of the game: matches recorded by the contest's own tester, and matches written by
//! hand, replay through the simulation.

use serde_json::{Value, json};
use wasmouse_core::game::{Action, BudgetScope, GameRules, Run, Simulation, Verdict};
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::{Heading, Turn};

use crate::shared::shared_text;

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn recorded_matches_replay_exactly() {
    recorded().iter().for_each(check_recorded);
}

/// The matches that the contest's tester recorded.
pub fn recorded() -> Vec<Value> {
    let text = shared_text("conformance/scripted.jsonl");
    let lines = text.lines().map(serde_json::from_str);
    let matches: Vec<Value> = lines.collect::<Result<_, _>>().expect("JSON lines");
    let scores = matches.iter().filter(|it| it["score"].is_string());
    assert_eq!((matches.len(), scores.count()), (96, 34));
    matches
}

fn check_recorded(recorded: &Value) {
    let name = &recorded["name"];
    let text = recorded["maze"].as_str().expect("a maze");
    let maze = format::parse_as(text, Format::Udacity)
        .unwrap_or_else(|error| panic!("{name}: {error}"))
        .maze;
    let rules = GameRules::default();
    let mut simulation = Simulation::new(&maze, &rules);

    let steps = recorded["steps"].as_array().expect("a list of steps");
    for (index, step) in steps.iter().enumerate() {
        assert_eq!(simulation.verdict(), None, "{name}, step {index}");
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

    let verdict = simulation.verdict();
    let verdict = verdict.unwrap_or_else(|| panic!("{name}: the simulation goes on"));
    let score = verdict.score();
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
        assert_eq!(found, recorded[field], "{name}, {field}");
    }
}

/// Where the tester leaves the robot. When the exploration run has used up the budget, the
/// tester still sets up the speed run, and then finds that no step is left for it.
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
        .map(|(_, run)| simulation.steps().of(run))
        .collect()
}

/// An action as the tester records it.
pub fn recorded_action(value: &Value) -> Action {
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

/// Plays a script in [`THOROUGHFARE`] and compares the state after it. A step after the end of
/// the match panics.
///
/// A script has words like `R3` (turn right, drive 3), `L0`, `S-1` or `reset`;
/// `S0*9` is nine times `S0`.
#[track_caller]
fn check(scope: BudgetScope, script: &str, expected: &str) {
    let parsed = format::parse(THOROUGHFARE.trim_start()).expect("the maze above");
    let rules = GameRules {
        budget_scope: scope,
        ..GameRules::default()
    };
    let mut simulation = Simulation::new(&parsed.maze, &rules);
    for action in actions(script) {
        simulation.apply(action);
    }
    assert_eq!(state(&simulation), expected, "after `{script}`");
}

/// Where the match is, its steps by run, and what else is not as at the start.
fn state(simulation: &Simulation<'_>) -> String {
    let (counts, steps) = (simulation.counts(), simulation.steps());
    let mut state = format!(
        "{} {} {}, steps {}+{}",
        simulation.run().name(),
        simulation.cell(),
        simulation.heading().name(),
        steps.exploration,
        steps.speed,
    );
    for (name, count) in [
        ("bumps", counts.bumps),
        ("clamps", counts.clamps),
        ("ignored before the goal", counts.resets_before_goal),
        ("ignored in the speed run", counts.resets_in_speed_run),
    ] {
        if count > 0 {
            state += &format!(", {name} {count}");
        }
    }
    match simulation.verdict() {
        None => {}
        Some(Verdict::Finished { score }) => state += &format!(", finished {score}"),
        Some(verdict) => state += &format!(", {}", verdict.title()),
    }
    state
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
        "exploration run (3, 3) right, steps 3+0, bumps 1",
    );
    // A wall at once: a bump too, and the turn counts.
    check("R1", "exploration run (0, 0) right, steps 1+0, bumps 1");
    // Turning on the spot is no bump.
    check("R0 R0 L0", "exploration run (0, 0) right, steps 3+0");
    // Backwards keeps the heading.
    check("S3 S-2", "exploration run (0, 1) up, steps 2+0");
    check("S1 S-3", "exploration run (0, 0) up, steps 2+0, bumps 1");
    // The largest and the smallest movement are clamped to three cells.
    check(
        "S127 S-128",
        "exploration run (0, 0) up, steps 2+0, clamps 2",
    );
    check(
        "S1 S4",
        "exploration run (0, 3) up, steps 2+0, bumps 1, clamps 1",
    );
    check("S3 S-4", "exploration run (0, 0) up, steps 2+0, clamps 1");
}

#[test]
fn goal_and_resets() {
    let check = |script, expected| check(BudgetScope::BothRuns, script, expected);
    // Driving through the goal does not count, so the reset is ignored.
    check(
        "S1 R3 reset",
        "exploration run (3, 1) right, steps 3+0, ignored before the goal 1",
    );
    // Ending in it does; the exploration run goes on until the reset, which is a step of it.
    check("S1 R2 S1", "exploration run (3, 1) right, steps 3+0");
    check("S1 R2 S1 reset", "speed run (0, 0) up, steps 4+0");
    // Nor does driving through end the speed run; ending there does: 2 + 3/30 and 4 + 3/30.
    check(
        "S1 R2 reset S1 R1",
        "speed run (1, 1) right, steps 3+2, finished 2.100",
    );
    check(
        "S1 R2 reset S1 R3 S0 S-1",
        "speed run (2, 1) right, steps 3+4, finished 4.100",
    );
    // A bump in the goal ends there.
    check("S1 R2 L3 reset", "speed run (0, 0) up, steps 4+0, bumps 1");
    // A second reset loses a step of the speed run.
    check(
        "S1 R2 reset reset S1 reset",
        "speed run (0, 1) up, steps 3+3, ignored in the speed run 2",
    );
}

#[test]
fn the_budget_is_for_both_runs() {
    let check = |script, expected| check(BudgetScope::BothRuns, script, expected);
    check("S0*999", "exploration run (0, 0) up, steps 999+0");
    // Step 1000 is executed, and there is no step 1001.
    check(
        "S0*999 S1",
        "exploration run (0, 1) up, steps 1000+0, budget used up",
    );
    check(
        "S1 R2 S0*997 reset",
        "speed run (0, 0) up, steps 1000+0, budget used up, goal reached",
    );
    check(
        "S1 R2 reset S0*995 S1 R2",
        "speed run (2, 1) right, steps 3+997, finished 997.100",
    );
    check(
        "S1 R2 reset S0*996 S1",
        "speed run (0, 1) up, steps 3+997, budget used up, goal reached",
    );
}

#[test]
fn each_run_may_have_its_own_budget() {
    let check = |script, expected| check(BudgetScope::EachRun, script, expected);
    check(
        "S0*1000",
        "exploration run (0, 0) up, steps 1000+0, budget used up",
    );
    check(
        "S1 R2 S0*997 reset S0*999",
        "speed run (0, 0) up, steps 1000+999",
    );
    check(
        "S1 R2 S0*997 reset S0*998 S1 R1",
        "speed run (1, 1) right, steps 1000+1000, finished 1033.333",
    );
    check(
        "S1 R2 reset S0*1000",
        "speed run (0, 0) up, steps 3+1000, budget used up, goal reached",
    );
}

#[test]
#[should_panic(expected = "the match has ended")]
fn no_step_follows_the_last() {
    check(BudgetScope::BothRuns, "S0*1001", "");
}

#[test]
#[should_panic(expected = "the match has ended")]
fn no_step_follows_the_finish() {
    check(BudgetScope::BothRuns, "S1 R2 reset S1 R1 S0", "");
}
