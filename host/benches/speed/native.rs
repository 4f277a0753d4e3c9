//! The flood robot without WebAssembly: the same source, compiled into the
//! benchmark and driven by the core's simulation.
//!
//! What a match costs beyond this is the price of the sandbox.

use robot_flood::Flood;
use wasmouse_core::game::{Action, GameRules, Sensors, Simulation};
use wasmouse_core::maze::{Maze, Turn};
use wasmouse_core::record::Transcript;
use wasmouse_sdk as sdk;
use wasmouse_sdk::Robot as _;

/// Plays one match and leaves the robot's actions in the transcript.
pub fn play(maze: &Maze, rules: &GameRules, variant: u32, transcript: &mut Transcript) {
    transcript.clear();
    let mut robot = Flood::start(&briefing(maze, rules, variant));
    let mut simulation = Simulation::new(maze, rules);
    while !simulation.has_ended() {
        let action = action(robot.next_move(readings(simulation.sense())));
        simulation.apply(action);
        transcript.push(action);
    }
}

/// The briefing of a robot, as far as contest mazes differ.
fn briefing(maze: &Maze, rules: &GameRules, variant: u32) -> sdk::Briefing {
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

fn action(action: sdk::Action) -> Action {
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
