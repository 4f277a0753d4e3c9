//! [`Margins`]: how far a robot is from a benchmark, maze by maze.

use wasmouse_core::game::Ruleset;

use super::matrix::{Outcome, ScoreMatrix};
use super::mean::Mean;
use super::ranking::MazeFilter;

/// A score to beat, from Minnett's report ("Plot and Navigate a Virtual Maze", 2016, section
/// 1.2.4): the optimal speed run, after an exploration run with so many steps for each cell of the
/// maze.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Benchmark {
    /// One step for each cell, which takes a good exploration.
    Lower,
    /// Two steps for each cell, which every exploration should beat.
    Upper,
}

impl Benchmark {
    /// Both, the harder one first.
    pub const ALL: [Self; 2] = [Self::Lower, Self::Upper];

    /// `lower` or `upper`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
        }
    }

    /// Steps of the exploration run for each cell.
    pub const fn steps_per_cell(self) -> u32 {
        match self {
            Self::Lower => 1,
            Self::Upper => 2,
        }
    }
}

/// The margins of one robot to a [`Benchmark`]: benchmark minus score, one for each finished match
/// in a maze whose goal can be reached. Positive ones beat the benchmark.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Margins {
    /// Matches played, finished or not.
    pub matches: u64,
    /// In parts of a step.
    margins: Vec<i64>,
    /// Parts of a step.
    divisor: i64,
}

impl Margins {
    /// The margins of a robot, given by its index, in the mazes of a filter.
    pub fn new(
        matrix: &ScoreMatrix,
        robot: usize,
        filter: MazeFilter,
        benchmark: Benchmark,
    ) -> Self {
        let Ruleset { game, .. } = &matrix.rules;
        let divisor = i64::from(game.exploration_divisor);
        let (mut matches, mut margins) = (0, Vec::new());
        for maze in filter.mazes(matrix) {
            let Some(oracle) = matrix.mazes[maze].oracle else {
                continue;
            };
            let cells = i64::from(matrix.mazes[maze].dimension).pow(2);
            let allowed = cells * i64::from(benchmark.steps_per_cell());
            for seed in 0..matrix.seeds.count {
                let Some(played) = matrix.get(robot, maze, seed) else {
                    continue;
                };
                matches += 1;
                if played.outcome == Outcome::Finished {
                    let speed = i64::from(played.steps.speed) - i64::from(oracle.speed_steps());
                    let exploration = i64::from(played.steps.exploration);
                    // Recorded numbers may be anything.
                    let lost = speed.saturating_mul(divisor).saturating_add(exploration);
                    margins.push(allowed.saturating_sub(lost));
                }
            }
        }
        Self {
            matches,
            margins,
            divisor,
        }
    }

    /// Matches finished with a score.
    pub fn finished(&self) -> u64 {
        self.margins.len() as u64
    }

    /// Finished matches with a score below the benchmark.
    pub fn beaten(&self) -> u64 {
        self.margins.iter().filter(|margin| **margin > 0).count() as u64
    }

    /// The average margin, in steps; `None` when no match is finished.
    pub fn mean(&self) -> Option<Mean> {
        let sum = self.margins.iter().map(|&it| i128::from(it)).sum();
        let denominator = i128::from(self.divisor) * self.margins.len() as i128;
        (denominator > 0).then(|| Mean::fraction(sum, denominator))
    }

    /// The least and the largest margin in whole steps, rounded down; `None` when no match is
    /// finished.
    pub fn range(&self) -> Option<(i64, i64)> {
        let whole = |margin: Option<&i64>| margin.map(|it| it.div_euclid(self.divisor));
        whole(self.margins.iter().min()).zip(whole(self.margins.iter().max()))
    }

    /// How many margins are in each of `count` intervals of `width` steps, at least 1. The first
    /// begins at `first` steps, and each includes its lower end. Margins beyond them are not
    /// counted.
    pub fn histogram(&self, first: i64, width: u32, count: usize) -> Vec<u64> {
        let mut counts = vec![0; count];
        for margin in &self.margins {
            let margin = margin.div_euclid(self.divisor);
            let bin = margin.saturating_sub(first).div_euclid(width.into());
            let bin = usize::try_from(bin).ok();
            if let Some(count) = bin.and_then(|bin| counts.get_mut(bin)) {
                *count += 1;
            }
        }
        counts
    }
}

#[cfg(test)]
mod tests {
    use wasmouse_core::Digest;
    use wasmouse_core::game::FaultKind;

    use super::super::matrix::{MatchScore, MatrixMaze, MatrixRobot};
    use super::super::plan::Seeds;
    use super::super::tally::tests::{fault, finished};
    use super::*;

    /// Maze 01 with Minnett's first and final robot (section 1.3), and a robot that failed.
    #[test]
    fn margins_are_those_of_the_report() {
        let rules = Ruleset::default();
        let digest = Digest::of(b"");
        let seeds = Seeds { first: 0, count: 3 };
        let robot = MatrixRobot::new("minnett", digest, 0);
        let mut matrix = ScoreMatrix::new(rules.clone(), seeds, vec![robot]);
        matrix.push_maze(MatrixMaze {
            name: "test_maze_01".into(),
            digest,
            dimension: 12,
            oracle: Some(rules.game.score(17, 18)),
            set: 0,
        });
        // Scores of 26.700, 20.667 and none; the benchmarks are 21.8 and 26.6.
        let records = [
            finished(291, 17),
            finished(110, 17),
            fault(FaultKind::Panic),
        ];
        for (seed, record) in (0..).zip(&records) {
            matrix.set(0, 0, seed, MatchScore::new(record));
        }
        let [lower, upper] =
            Benchmark::ALL.map(|it| Margins::new(&matrix, 0, MazeFilter::Size(12), it));
        assert_eq!((lower.matches, lower.finished()), (3, 2));
        assert_eq!((lower.beaten(), upper.beaten()), (1, 1));
        let means = [&lower, &upper].map(|it| it.mean().map(|it| it.to_string()));
        // -4.9 and 1.133; -0.1 and 5.933.
        let expected = ["-1.883", "2.917"].map(|it| Some(it.to_owned()));
        assert_eq!(means, expected);
        assert_eq!(
            (lower.range(), upper.range()),
            (Some((-5, 1)), Some((-1, 5)))
        );
        assert_eq!(lower.histogram(-6, 2, 4), [1, 0, 0, 1]);
        assert_eq!(lower.histogram(0, 1, 2), [0, 1]);
        let other = Margins::new(&matrix, 0, MazeFilter::Size(14), Benchmark::Lower);
        assert_eq!(
            (other.matches, other.mean(), other.range()),
            (0, None, None)
        );
    }
}
