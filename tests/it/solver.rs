//! The optima of the three official mazes, as their rules publish them.

use std::fs;

use wasmouse::maze::{LONGEST_MOVE, Metric, format, omniscient_floor, shortest_path};
use wasmouse::sim::Score;

use crate::shared::shared;

#[test]
fn official_mazes_have_their_published_optima() {
    let Some(shared) = shared() else {
        return;
    };
    for (name, steps, cells, score) in [
        ("test_maze_01", 17, 30, "17.600"),
        ("test_maze_02", 22, 43, "22.767"),
        ("test_maze_03", 25, 49, "25.867"),
    ] {
        let file = shared.join(format!("mazes/udacity/{name}.txt"));
        let text = fs::read_to_string(&file).expect("the official mazes are there");
        let maze = format::parse(&text).expect("a maze").maze;
        let path = shortest_path(&maze, Metric::STEPS).expect("solvable");
        assert_eq!((path.steps(), path.cells()), (steps, cells), "{name}");
        let floor = omniscient_floor(&maze, LONGEST_MOVE).expect("solvable");
        let floor = Score::new(floor.speed_steps, floor.exploration_steps, 30);
        assert_eq!(floor.to_string(), score, "{name}");
    }
}
