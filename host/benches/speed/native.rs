//! The flood robot without WebAssembly: the same source, compiled into the
//! benchmark and driven by the host's own simulation and trace.
//!
//! What a match costs beyond this is the price of the sandbox.

use robot_flood::Flood;
use wasmouse::maze::{Maze, Turn};
use wasmouse::sim::{Action, Ruleset, Sensors, Simulation, Trace};
use wasmouse_sdk as sdk;
use wasmouse_sdk::Robot as _;

/// Plays one match; the trace tells how it went.
pub fn play(maze: &Maze, rules: &Ruleset, variant: u32, trace: &mut Trace) {
    let mut robot = Flood::start(&briefing(maze, rules, variant));
    let mut simulation = Simulation::new(maze, rules, trace);
    while simulation.end().is_none() {
        let action = robot.next_move(readings(simulation.sense()));
        simulation.apply(answer(action));
    }
}

/// What the host tells a robot, as far as contest mazes differ.
fn briefing(maze: &Maze, rules: &Ruleset, variant: u32) -> sdk::Briefing {
    let briefing = sdk::Briefing {
        variant,
        ..sdk::Briefing::contest(maze.dimension().into())
    };
    assert_eq!(briefing.budget, rules.budget, "a contest under other rules");
    briefing
}

fn readings(sensors: Sensors) -> sdk::Sensors {
    sdk::Sensors {
        left: sensors.left.into(),
        front: sensors.front.into(),
        right: sensors.right.into(),
    }
}

fn answer(action: sdk::Action) -> Action {
    match action {
        sdk::Action::Move(sdk::Move { turn, advance }) => Action::Move {
            turn: match turn {
                sdk::Turn::Left => Turn::Left,
                sdk::Turn::Straight => Turn::Straight,
                sdk::Turn::Right => Turn::Right,
            },
            advance,
        },
        sdk::Action::Reset => Action::Reset,
    }
}
