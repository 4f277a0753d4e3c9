//! The SDK's testing arena and the host's simulation are two implementations of the same rules:
//! both replay the recorded matches, and both play the same random actions.

use std::cell::RefCell;

use serde_json::{Value, json};
use wasmouse_core::game::{self, GameRules, Ruleset, Simulation, Trace, Verdict};
use wasmouse_core::maze;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_sdk::testing::{self, PlayOptions, Played, Score};
use wasmouse_sdk::{Action, Briefing, Cell, Heading, Pose, Random, Robot, Sensors, Turn};

use crate::conformance::{self, recorded};
use crate::matches::generated_mazes;

thread_local! {
    /// The actions of the next [`Script`].
    static SCRIPT: RefCell<Vec<Action>> = const { RefCell::new(Vec::new()) };
}

/// Performs the given actions, whatever it senses.
struct Script {
    actions: std::vec::IntoIter<Action>,
}

impl Robot for Script {
    fn start(_: &Briefing) -> Self {
        let actions = SCRIPT.take().into_iter();
        Self { actions }
    }

    fn next_move(&mut self, _: Sensors) -> Action {
        self.actions.next().expect("as many actions as steps")
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
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn replays_the_recorded_matches() {
    recorded().iter().for_each(check_recorded);
}

fn check_recorded(recorded: &Value) {
    let name = &recorded["name"];
    let steps = recorded["steps"].as_array().expect("a list of steps");
    let actions = steps.iter().map(|step| action(&step[7])).collect();
    let played = play_script(recorded["maze"].as_str().expect("a maze"), actions);
    assert_eq!(played.stops.len(), steps.len(), "{name}");
    for (index, (stop, step)) in played.stops.iter().zip(steps).enumerate() {
        let Sensors { left, front, right } = stop.sensors;
        let (x, y) = (stop.cell.x, stop.cell.y);
        let heading = heading_name(stop.heading);
        let state = json!([stop.run, x, y, heading, left, front, right, step[7]]);
        assert_eq!(&state, step, "{name}, step {index}");
    }
    let raced = played.stops.iter().any(|it| it.run == 2);
    // When the exploration run has used up the budget, the tester still puts the robot back to
    // the start, and then finds that no step is left for the speed run.
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
        assert_eq!(value, recorded[field], "{name}, {field}");
    }
}

fn action(value: &Value) -> Action {
    match conformance::recorded_action(value) {
        game::Action::Reset => Action::Reset,
        game::Action::Move { turn, advance } => {
            let turn = match turn {
                maze::Turn::Left => Turn::Left,
                maze::Turn::Straight => Turn::Straight,
                maze::Turn::Right => Turn::Right,
            };
            Action::drive(turn, advance)
        }
    }
}

fn heading_name(heading: Heading) -> &'static str {
    match heading {
        Heading::Up => "up",
        Heading::Right => "right",
        Heading::Down => "down",
        Heading::Left => "left",
    }
}

/// Moves at random, sometimes against the rules.
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
    let mut finished = 0;
    for (name, maze) in generated_mazes("gen:tree,loops=40:12:1..=40") {
        let text = format::print(&maze, Format::Udacity).expect("a contest maze");
        for rules in Ruleset::all().map(|it| it.game) {
            for seed in 0..5 {
                let played = testing::play::<Erratic>(&text, &options(&rules, seed));
                finished += u32::from(played.finished);
                let simulation = Simulation::new(&maze, &rules);
                trace_of(simulation, &played, &format!("{name}, seed {seed}"));
            }
        }
    }
    assert!(finished > 20, "only {finished} finished: a weak test");
}

/// Native options for these rules.
pub fn options(rules: &GameRules, seed: u64) -> PlayOptions {
    PlayOptions {
        seed,
        budget: rules.budget,
        budget_scope: match rules.budget_scope {
            game::BudgetScope::BothRuns => wasmouse_sdk::BudgetScope::BothRuns,
            game::BudgetScope::EachRun => wasmouse_sdk::BudgetScope::EachRun,
        },
        longest_move: rules.longest_move.into(),
        exploration_divisor: rules.exploration_divisor,
        ..PlayOptions::default()
    }
}

/// Feeds the actions of a native match to the host's simulation, requires the same readings,
/// counts and end, and returns the trace.
pub fn trace_of(mut simulation: Simulation<'_>, played: &Played, name: &str) -> Trace {
    let mut trace = Trace::default();
    for stop in &played.stops {
        assert_eq!(simulation.verdict(), None, "{name}");
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
        trace.apply(&mut simulation, host_action(stop.action));
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
    match simulation.verdict() {
        Some(Verdict::Finished { score }) => {
            let thousandths = Some(score.thousandths());
            assert_eq!(played.score.map(Score::thousandths), thousandths, "{name}");
        }
        Some(Verdict::BudgetUsedUp { goal_reached }) => {
            assert_eq!(
                (played.finished, played.goal_seen),
                (false, goal_reached),
                "{name}"
            );
        }
        Some(Verdict::Fault { .. }) | None => panic!("{name}: the arena ended too early"),
    }
    trace
}

fn host_action(action: Action) -> game::Action {
    match action {
        Action::Reset => game::Action::Reset,
        Action::Move(it) => game::Action::Move {
            turn: match it.turn {
                Turn::Left => maze::Turn::Left,
                Turn::Straight => maze::Turn::Straight,
                Turn::Right => maze::Turn::Right,
            },
            advance: it.advance,
        },
    }
}
