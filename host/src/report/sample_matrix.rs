//! A matrix with a robot that is better than the second and as good as the third, for tests.

use wasmouse_core::Digest;
use wasmouse_core::game::{FaultKind, Ruleset, Steps};
use wasmouse_core::record::FuelUse;

use crate::contest::{MatchScore, MatrixMaze, MatrixRobot, Outcome, ScoreMatrix, Seeds};

/// Robots `a`, `b` and `c` in mazes of these sizes. `b` fails in the second.
pub(super) fn matrix(sizes: &[u8]) -> ScoreMatrix {
    let rules = Ruleset::default();
    let robots = ["a", "b", "c"].map(|name| {
        let digest = Digest::of(name.as_bytes());
        MatrixRobot::new(name, digest, 0)
    });
    let seeds = Seeds { first: 0, count: 1 };
    let mut matrix = ScoreMatrix::new(rules.clone(), seeds, robots.into());
    for (position, &dimension) in sizes.iter().enumerate() {
        let name = format!("maze {position}");
        let maze = matrix.push_maze(MatrixMaze {
            digest: Digest::of(name.as_bytes()),
            name: name.into(),
            dimension,
            oracle: Some(rules.game.score(10, 11)),
            set: 0,
        });
        for (robot, speed) in [12, 13 + position as u32, 12].into_iter().enumerate() {
            let outcome = match (robot, position) {
                (1, 1) => Outcome::Fault(FaultKind::Panic),
                _ => Outcome::Finished,
            };
            let score = MatchScore {
                outcome,
                steps: Steps {
                    exploration: 60,
                    speed,
                },
                fuel: FuelUse {
                    start: 1,
                    steps: 7200,
                    step_max: 200,
                },
                memory_bytes: 65_536,
            };
            matrix.set(robot, maze, 0, score);
        }
    }
    matrix
}
