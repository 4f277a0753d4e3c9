//! [`Benchmark`]: the scores that the reports call good enough.
//!
//! Both reports that have benchmarks build them alike: the optimal run 2, and a
//! run 1 that costs some number of steps for each cell of the maze.

use super::{ContestMaze, Mean};
use crate::sim::Score;

/// A score to beat: the step optimum plus a share of a step for each cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Benchmark {
    /// The score that each cell allows beyond the step optimum, as numerator
    /// and denominator, in steps.
    per_cell: (u8, u8),
    /// A few words, for the head of a column.
    pub name: &'static str,
    /// The formula, with `n` for the dimension and `optimum` for the steps of
    /// the shortest run 2.
    pub formula: &'static str,
    /// Whose it is, and where the report has it.
    pub source: &'static str,
}

impl Benchmark {
    /// The benchmarks of the reports, the hardest first.
    ///
    /// Rai's two come as he defines them, for exploring everything, and reduced
    /// to 60 % of the cells, the share at which his robot stops.
    pub const ALL: [Self; 5] = [
        Self {
            per_cell: (1, 50),
            name: "Rai, lower, 60\u{a0}%",
            formula: "optimum + 0.6 n² / 30",
            source: "Rai's lower benchmark at an exploration of 60 %, \
                     section 0.7, equation (4) and the paragraphs below it",
        },
        Self {
            per_cell: (1, 30),
            name: "Minnett, lower",
            formula: "optimum + n² / 30",
            source: "Minnett's lower benchmark, section 1.2.4; \
                     also Rai's lower benchmark at 100 %, equation (4)",
        },
        Self {
            per_cell: (1, 15),
            name: "Minnett, upper",
            formula: "optimum + 2 n² / 30",
            source: "Minnett's upper benchmark, section 1.2.4",
        },
        Self {
            per_cell: (1, 10),
            name: "Rai, upper, 60\u{a0}%",
            formula: "optimum + 5 × 0.6 n² / 30",
            source: "Rai's upper benchmark at an exploration of 60 %, \
                     section 0.7, equation (3) and the paragraphs below it",
        },
        Self {
            per_cell: (1, 6),
            name: "Rai, upper",
            formula: "optimum + 5 n² / 30",
            source: "Rai's upper benchmark at 100 %, section 0.7, equation (3)",
        },
    ];

    /// Minnett's lower benchmark, which is the index of the one that his report
    /// counts with.
    pub const MINNETT_LOWER: usize = 1;

    /// The index of Minnett's upper benchmark.
    pub const MINNETT_UPPER: usize = 2;

    /// The score to beat in a maze of this dimension and step optimum.
    ///
    /// ```
    /// use wasmouse::contest::Benchmark;
    ///
    /// // Maze 01 as the reports have it: Minnett 26.6, Rai 41 and, at 60 %, 31.4.
    /// let [_, _, minnett, rai_60, rai] = Benchmark::ALL.map(|it| it.score(17, 12).to_string());
    /// assert_eq!([minnett, rai_60, rai], ["26.600", "31.400", "41.000"]);
    /// ```
    pub const fn score(self, optimum: u32, dimension: u8) -> Mean {
        let (numerator, denominator) = (self.per_cell.0 as i128, self.per_cell.1 as i128);
        let cells = dimension as i128 * dimension as i128;
        Mean::fraction(
            optimum as i128 * denominator + cells * numerator,
            denominator,
        )
    }

    /// By how much a score is better than the benchmark: positive when it beats
    /// it. `None` in a maze that cannot be solved.
    pub fn margin(self, score: Score, maze: &ContestMaze) -> Option<Mean> {
        let optimum = maze.floor?.speed_steps();
        let benchmark = self.score(optimum, maze.maze.dimension());
        Some(benchmark.minus(Mean::from(score)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The benchmarks of the official mazes as the reports print them. Rai takes
    /// 23 as the optimum of both mazes 02 and 03.
    #[test]
    fn scores_are_those_of_the_reports() {
        for (benchmark, optimum, dimension, expected) in [
            (0, 17, 12, "19.880"),
            (0, 23, 14, "26.920"),
            (0, 23, 16, "28.120"),
            (1, 17, 12, "21.800"),
            (1, 22, 14, "28.533"),
            (1, 25, 16, "33.533"),
            (2, 22, 14, "35.067"),
            (2, 25, 16, "42.067"),
            (3, 17, 12, "31.400"),
            (3, 23, 14, "42.600"),
            (3, 23, 16, "48.600"),
        ] {
            let score = Benchmark::ALL[benchmark].score(optimum, dimension);
            assert_eq!(score.to_string(), expected, "{benchmark}, {dimension}");
        }
    }

    #[test]
    fn the_hardest_comes_first() {
        let scores = Benchmark::ALL.map(|benchmark| benchmark.score(17, 12));
        assert!(scores.is_sorted());
    }
}
