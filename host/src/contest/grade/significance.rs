//! [`compare`]: whether a robot is significantly worse than another.

use super::super::matrix::ScoreMatrix;
use super::super::mean::Mean;
use super::super::ranking::{MazeFilter, PairedComparison, PairedVerdict};
use super::super::scoring::Scoring;
use super::measure::Scope;

/// The least number of mazes that can show that a robot is worse.
pub const DECIDING_MAZES_MIN: usize = 6;

/// What a comparison came to.
#[derive(Clone, Debug)]
pub struct Significance {
    /// Whether the robot is worse.
    pub is_worse: bool,
    /// Its average score minus that of the other.
    pub difference: Mean,
    /// The interval of the difference, in words.
    pub reason: String,
}

/// Compares two robots in the mazes of a scope, in which both have played all matches.
///
/// # Errors
///
/// Why they cannot be compared.
pub fn compare(scope: Scope<'_>, robots: (usize, usize)) -> Result<Significance, String> {
    let matrix = of_two(scope, robots);
    let found = PairedComparison::new(&matrix, &Scoring::default(), MazeFilter::All, (0, 1));
    let difference = found
        .difference
        .ok_or_else(|| "the goal cannot be reached in any of the mazes".to_owned())?;
    let reason = match found.interval_thousandths {
        Some([low, high]) => format!(
            "95 % interval of the difference {} to {}, {} mazes better, {} equal, {} worse",
            steps(low),
            steps(high),
            found.wins,
            found.ties,
            found.losses
        ),
        None => "there are too few mazes for an interval".to_owned(),
    };
    Ok(Significance {
        is_worse: found.verdict == PairedVerdict::Worse,
        difference,
        reason,
    })
}

fn steps(thousandths: i64) -> String {
    Mean::fraction(thousandths.into(), 1000).to_string()
}

/// The matches of two robots alone.
fn of_two(scope: Scope<'_>, (first, second): (usize, usize)) -> ScoreMatrix {
    let from = scope.matrix;
    let robots = vec![from.robots[first].clone(), from.robots[second].clone()];
    let mut matrix = ScoreMatrix::new(from.rules.clone(), from.seeds, robots);
    for &maze in scope.mazes {
        let mut entry = from.mazes[maze].clone();
        entry.set = 0;
        let index = matrix.push_maze(entry);
        for seed in 0..from.seeds.count {
            for (to, robot) in [first, second].into_iter().enumerate() {
                if let Some(score) = from.get(robot, maze, seed) {
                    matrix.set(to, index, seed, *score);
                }
            }
        }
    }
    matrix
}
