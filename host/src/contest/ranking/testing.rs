//! Matrices for tests.

use proptest::prelude::*;
use wasmouse_core::Digest;
use wasmouse_core::game::{FaultKind, Ruleset, Steps};
use wasmouse_core::record::FuelUse;

use crate::contest::matrix::{MatchScore, MatrixMaze, MatrixRobot, MazeSet, Outcome, ScoreMatrix};
use crate::contest::plan::Seeds;

/// A matrix as lists, easy to write and to change: by maze its set, then by seed and robot.
#[derive(Clone, Debug)]
pub(super) struct Sketch {
    pub(super) robots: usize,
    pub(super) seeds: u32,
    /// Weights of the sets.
    pub(super) weights: Vec<u32>,
    pub(super) mazes: Vec<SketchMaze>,
}

#[derive(Clone, Debug)]
pub(super) struct SketchMaze {
    pub(super) set: usize,
    pub(super) is_reachable: bool,
    /// By seed, then by robot.
    pub(super) cells: Vec<Option<MatchScore>>,
}

/// A finished match.
pub(super) fn finished(exploration: u32, speed: u32) -> Option<MatchScore> {
    Some(match_score(Outcome::Finished, exploration, speed))
}

/// A match that ended in a fault.
pub(super) fn failed() -> Option<MatchScore> {
    Some(match_score(Outcome::Fault(FaultKind::Panic), 5, 0))
}

fn match_score(outcome: Outcome, exploration: u32, speed: u32) -> MatchScore {
    MatchScore {
        outcome,
        steps: Steps { exploration, speed },
        fuel: FuelUse {
            start: 10,
            steps: u64::from(exploration + speed) * 100,
            step_max: 150,
        },
        memory_bytes: 65_536,
    }
}

/// The name of a robot.
pub(super) fn name(robot: usize) -> String {
    format!("robot-{robot:02}")
}

impl Sketch {
    /// Robots in mazes of one set, with one seed: a row for each maze.
    pub(super) fn of_rows(rows: &[Vec<Option<MatchScore>>]) -> Self {
        let mazes = rows.iter().map(|cells| SketchMaze {
            set: 0,
            is_reachable: true,
            cells: cells.clone(),
        });
        Self {
            robots: rows.first().map_or(0, Vec::len),
            seeds: 1,
            weights: vec![1],
            mazes: mazes.collect(),
        }
    }

    pub(super) fn matrix(&self) -> ScoreMatrix {
        let order: Vec<usize> = (0..self.robots).collect();
        self.matrix_with_order(&order)
    }

    /// The matrix with its robots in that order.
    pub(super) fn matrix_with_order(&self, order: &[usize]) -> ScoreMatrix {
        let seeds = Seeds {
            first: 0,
            count: self.seeds,
        };
        let rules = Ruleset::default();
        let digest = |it: String| Digest::of(it.as_bytes());
        let robots = order
            .iter()
            .map(|&it| MatrixRobot::new(name(it), digest(name(it)), 0));
        let mut matrix = ScoreMatrix::new(rules.clone(), seeds, robots.collect());
        let sets = self.weights.iter().map(|&weight| MazeSet {
            name: format!("weight {weight}"),
            is_hidden: false,
            weight,
        });
        matrix.sets = sets.collect();
        for (index, maze) in self.mazes.iter().enumerate() {
            let index = matrix.push_maze(MatrixMaze {
                name: format!("maze {index}").into(),
                digest: digest(format!("maze {index}")),
                dimension: 12,
                oracle: maze.is_reachable.then(|| rules.game.score(2, 3)),
                set: maze.set,
            });
            for seed in 0..self.seeds {
                for (position, &robot) in order.iter().enumerate() {
                    let cell = maze.cells[seed as usize * self.robots + robot];
                    if let Some(score) = cell {
                        matrix.set(position, index, seed, score);
                    }
                }
            }
        }
        matrix
    }
}

fn cell() -> impl Strategy<Value = Option<MatchScore>> {
    let fault = Outcome::Fault(FaultKind::Panic);
    let outcome = prop_oneof![
        6 => Just(Outcome::Finished),
        1 => Just(Outcome::BudgetUsedUp { goal_reached: true }),
        1 => Just(Outcome::BudgetUsedUp { goal_reached: false }),
        1 => Just(fault),
    ];
    // Few values, so that robots are often equal.
    let score = (outcome, 3..5_u32, 2..4_u32);
    score.prop_map(|(outcome, exploration, speed)| Some(match_score(outcome, exploration, speed)))
}

/// Robots that have played everything: up to 6 in up to 8 mazes with up to 3 seeds.
pub(super) fn sketches() -> impl Strategy<Value = Sketch> {
    let shape = (
        1..=6_usize,
        1..=3_u32,
        proptest::collection::vec(1..=4_u32, 1..=3),
    );
    shape.prop_flat_map(|(robots, seeds, weights)| {
        let sets = weights.len();
        let cells = proptest::collection::vec(cell(), robots * seeds as usize);
        let maze = (0..sets, proptest::bool::weighted(0.9), cells);
        let maze = maze.prop_map(|(set, is_reachable, cells)| SketchMaze {
            set,
            is_reachable,
            cells,
        });
        proptest::collection::vec(maze, 0..=8).prop_map(move |mazes| Sketch {
            robots,
            seeds,
            weights: weights.clone(),
            mazes,
        })
    })
}
