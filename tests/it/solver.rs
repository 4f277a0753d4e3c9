//! The optima of the three official mazes, as their rules publish them.

use wasmouse_core::game::GameRules;
use wasmouse_core::maze::{Metric, format, shortest_path};

use crate::shared::shared_text;

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn official_mazes_have_their_published_optima() {
    for (name, steps, cells, score) in [
        ("test_maze_01", 17, 30, "17.600"),
        ("test_maze_02", 22, 43, "22.767"),
        ("test_maze_03", 25, 49, "25.867"),
    ] {
        let text = shared_text(&format!("mazes/udacity/{name}.txt"));
        let maze = format::parse(&text).expect("a maze").maze;
        let path = shortest_path(&maze, Metric::STEPS).expect("solvable");
        assert_eq!((path.steps(), path.cells()), (steps, cells), "{name}");
        let oracle = GameRules::default().oracle_score(&maze).expect("solvable");
        assert_eq!(oracle.to_string(), score, "{name}");
    }
}
