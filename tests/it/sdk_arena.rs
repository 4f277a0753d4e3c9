//! The SDK's testing arena and the host's simulation are two implementations of the
//! same rules. Here the arena replays the recorded vectors, and both play the same
//! random answers.

use std::cell::RefCell;
use std::fs;

use serde_json::{Value, json};
use wasmouse::maze::format::{self, Format};
use wasmouse::maze::generate::GenSpec;
use wasmouse::sim::{self, Ruleset, Simulation, Trace};
use wasmouse_sdk::testing::{self, PlayOptions, Played, Score};
use wasmouse_sdk::{Action, Briefing, Cell, Heading, Pose, Random, Robot, Sensors, Turn};

use crate::shared::shared;

thread_local! {
    /// What [`Script`] answers.
    static SCRIPT: RefCell<Vec<Action>> = const { RefCell::new(Vec::new()) };
}

/// Answers what it was told to, whatever it sees.
struct Script {
    actions: std::vec::IntoIter<Action>,
}

impl Robot for Script {
    fn start(_: &Briefing) -> Self {
        let actions = SCRIPT.take().into_iter();
        Self { actions }
    }

    fn next_move(&mut self, _: Sensors) -> Action {
        self.actions.next().expect("as many answers as steps")
    }
}

fn play_script(maze: &str, actions: Vec<Action>) -> Played {
    let options = PlayOptions {
        budget: actions.len() as u32,
        ..PlayOptions::default()
    };
    SCRIPT.set(actions);
    testing::play::<Script>(maze, &options)
}

#[test]
fn replays_the_recorded_vectors() {
    let Some(shared) = shared() else {
        return;
    };
    let path = shared.join("conformance/scripted.jsonl");
    let text = fs::read_to_string(&path).expect("the vectors can be read");
    let vectors: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).expect("a vector a line"))
        .collect();
    assert_eq!(vectors.len(), 96);
    vectors.iter().for_each(check_vector);
}

fn check_vector(vector: &Value) {
    let name = &vector["name"];
    let steps = vector["steps"].as_array().expect("a list of steps");
    let actions = steps.iter().map(|step| action(&step[7])).collect();
    let played = play_script(vector["maze"].as_str().expect("a maze"), actions);
    assert_eq!(played.stops.len(), steps.len(), "{name}");
    for (index, (stop, step)) in played.stops.iter().zip(steps).enumerate() {
        let Sensors { left, front, right } = stop.sensors;
        let (x, y) = (stop.cell.x, stop.cell.y);
        let heading = heading_name(stop.heading);
        let state = json!([stop.run, x, y, heading, left, front, right, step[7]]);
        assert_eq!(&state, step, "{name}, step {index}");
    }
    let raced = played.stops.iter().any(|it| it.run == 2);
    // A robot that has used up the budget in run 1 is put back to the start by the
    // tester, which then finds that no call is left for run 2.
    let start = Pose::at_start(Cell::new(0, 0));
    let end = if raced { played.end } else { start };
    let mut run_steps = Vec::new();
    if raced {
        run_steps.push(played.exploration_steps);
    }
    if played.finished {
        run_steps.push(played.speed_steps);
    }
    let expected = [
        ("run_steps", json!(run_steps)),
        ("score", json!(played.score.map(|it| it.to_string()))),
        ("final_at", json!([end.cell.x, end.cell.y])),
        ("final_heading", json!(heading_name(end.heading))),
        ("bumps", json!(played.bumps)),
        ("clamps", json!(played.clamps)),
        ("resets_before_goal", json!(played.resets_before_goal)),
        ("resets_in_run_2", json!(played.resets_in_run_2)),
    ];
    for (field, value) in expected {
        assert_eq!(value, vector[field], "{name}, {field}");
    }
}

fn action(value: &Value) -> Action {
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
    Action::drive(turn, advance.try_into().expect("a movement in -128..=127"))
}

fn heading_name(heading: Heading) -> &'static str {
    match heading {
        Heading::Up => "up",
        Heading::Right => "right",
        Heading::Down => "down",
        Heading::Left => "left",
    }
}

/// Walks at random, with a nonsense answer now and then.
struct Erratic {
    random: Random,
}

impl Robot for Erratic {
    fn start(briefing: &Briefing) -> Self {
        let random = Random::new(briefing.seed);
        Self { random }
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        let turns = [Turn::Left, Turn::Straight, Turn::Right];
        let turn = turns[self.random.below(3) as usize];
        match self.random.below(8) {
            0 => Action::Reset,
            1 => Action::drive(turn, self.random.next_u64() as i8),
            2 => Action::drive(turn, -3),
            _ if sensors.front > 0 => Action::drive(Turn::Straight, 1),
            _ if sensors.right > 0 => Action::drive(Turn::Right, 2),
            _ => Action::drive(turn, 3),
        }
    }
}

#[test]
fn agrees_with_the_simulation() {
    let spec: GenSpec = "gen:tree,loops=40:12:1..=40"
        .parse()
        .expect("a specification");
    let mut finished = 0;
    for (name, maze) in spec.expand() {
        for rules in Ruleset::all() {
            for seed in 0..5 {
                let options = options(&rules, seed);
                let text = format::print(&maze, Format::Udacity).expect("a contest maze");
                let played = testing::play::<Erratic>(&text, &options);
                finished += u32::from(played.finished);
                let mut trace = Trace::default();
                let simulation = Simulation::new(&maze, &rules, &mut trace);
                check_against(simulation, &played, &format!("{name}, seed {seed}"));
            }
        }
    }
    assert!(finished > 20, "only {finished} finished: a weak test");
}

/// Native options for a ruleset.
pub fn options(rules: &Ruleset, seed: u64) -> PlayOptions {
    PlayOptions {
        seed,
        budget: rules.budget,
        budget_scope: match rules.budget_scope {
            sim::BudgetScope::BothRuns => wasmouse_sdk::BudgetScope::BothRuns,
            sim::BudgetScope::EachRun => wasmouse_sdk::BudgetScope::EachRun,
        },
        longest_move: rules.longest_move.into(),
        exploration_divisor: rules.exploration_divisor,
        ..PlayOptions::default()
    }
}

/// Feeds the answers of a native match to the host's simulation and requires the
/// same readings, counts and end.
pub fn check_against(mut simulation: Simulation<'_>, played: &Played, name: &str) {
    for stop in &played.stops {
        assert_eq!(simulation.end(), None, "{name}");
        let (cell, sensors) = (simulation.cell(), simulation.sense());
        assert_eq!(stop.run, simulation.run().number(), "{name}");
        assert_eq!(
            (stop.cell.x, stop.cell.y),
            (cell.x.into(), cell.y.into()),
            "{name}"
        );
        assert_eq!(
            heading_name(stop.heading),
            simulation.heading().name(),
            "{name}"
        );
        let read = [sensors.left, sensors.front, sensors.right].map(u32::from);
        let Sensors { left, front, right } = stop.sensors;
        assert_eq!([left, front, right], read, "{name}");
        simulation.apply(host_action(stop.action));
    }
    let counts = simulation.counts();
    assert_eq!(
        [
            played.bumps,
            played.clamps,
            played.resets_before_goal,
            played.resets_in_run_2
        ],
        [
            counts.bumps,
            counts.clamps,
            counts.resets_before_goal,
            counts.resets_in_speed_run
        ],
        "{name}"
    );
    match simulation.end() {
        Some(sim::End::Finished(score)) => {
            let thousandths = Some(score.thousandths());
            assert_eq!(played.score.map(Score::thousandths), thousandths, "{name}");
        }
        Some(sim::End::BudgetUsedUp { goal_reached }) => {
            assert_eq!(
                (played.finished, played.goal_seen),
                (false, goal_reached),
                "{name}"
            );
        }
        None => panic!("{name}: the arena ended too early"),
    }
}

fn host_action(action: Action) -> sim::Action {
    use wasmouse::maze;
    match action {
        Action::Reset => sim::Action::Reset,
        Action::Move(it) => sim::Action::Move {
            turn: match it.turn {
                Turn::Left => maze::Turn::Left,
                Turn::Straight => maze::Turn::Straight,
                Turn::Right => maze::Turn::Right,
            },
            advance: it.advance,
        },
    }
}
