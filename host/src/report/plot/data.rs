//! What plots take from a matrix: robots in the order of the ranking, and their finished matches.

use wasmouse_core::game::Score;
use wasmouse_core::guest_text::GuestStr;

use super::error::PlotError;
use super::look::LOOKS;
use crate::contest::{MatchScore, MatrixMaze, MazeFilter, Ranking, ScoreMatrix, Scoring};

/// Robots in a plot, at most: as many as there are markers.
pub const ROBOTS_MAX: usize = LOOKS;

/// The robots of a plot.
pub(super) struct Robots<'a> {
    pub(super) matrix: &'a ScoreMatrix,
    /// Indices into the robots of the matrix, best first.
    pub(super) shown: Vec<usize>,
    /// How many more have finished matches.
    pub(super) more: usize,
}

/// A finished match in a maze whose goal can be reached.
pub(super) struct Finished<'a> {
    pub(super) played: &'a MatchScore,
    pub(super) score: Score,
    pub(super) oracle: Score,
}

impl<'a> Robots<'a> {
    /// The best robots that have finished a match.
    pub(super) fn new(matrix: &'a ScoreMatrix) -> Result<Self, PlotError> {
        let ranking = Ranking::new(matrix, &Scoring::default(), MazeFilter::All, None);
        let mut robots = Self {
            matrix,
            shown: ranking.lines.iter().map(|line| line.robot).collect(),
            more: 0,
        };
        let all = std::mem::take(&mut robots.shown).into_iter();
        robots.shown = all
            .filter(|&it| robots.finished(it).next().is_some())
            .collect();
        robots.more = robots.shown.len().saturating_sub(ROBOTS_MAX);
        robots.shown.truncate(ROBOTS_MAX);
        if robots.shown.is_empty() {
            return Err(PlotError::Empty);
        }
        Ok(robots)
    }

    pub(super) fn names(&self) -> Vec<GuestStr<'a>> {
        let shown = self.shown.iter();
        shown
            .map(|&it| self.matrix.robots[it].name.as_guest())
            .collect()
    }

    /// The finished matches of a robot, maze by maze.
    pub(super) fn finished(&self, robot: usize) -> impl Iterator<Item = Finished<'a>> {
        let mazes = 0..self.matrix.mazes.len();
        let matrix = self.matrix;
        mazes.flat_map(move |maze| in_maze(matrix, robot, maze))
    }

    /// How many matches of the robot were played in mazes whose goal can be reached.
    pub(super) fn played(&self, robot: usize) -> usize {
        let Self { matrix, .. } = self;
        let mazes = matrix.mazes.iter().enumerate();
        let mazes = mazes.filter(|(_, maze)| maze.oracle.is_some());
        let seeds = |maze| {
            (0..matrix.seeds.count).filter(move |&seed| matrix.get(robot, maze, seed).is_some())
        };
        mazes.map(|(maze, _)| seeds(maze).count()).sum()
    }

    /// How many matches of all robots that are shown are finished.
    pub(super) fn finished_count(&self) -> usize {
        let shown = self.shown.iter();
        shown.map(|&robot| self.finished(robot).count()).sum()
    }
}

/// The finished matches of a robot in a maze.
pub(super) fn in_maze(
    matrix: &ScoreMatrix,
    robot: usize,
    maze: usize,
) -> impl Iterator<Item = Finished<'_>> {
    let MatrixMaze { oracle, .. } = &matrix.mazes[maze];
    (0..matrix.seeds.count).filter_map(move |seed| {
        let played = matrix.get(robot, maze, seed)?;
        Some(Finished {
            played,
            score: played.score(&matrix.rules)?,
            oracle: (*oracle)?,
        })
    })
}

impl Finished<'_> {
    /// Score minus oracle score, in steps.
    pub(super) fn regret(&self) -> f64 {
        let [score, oracle] = [self.score, self.oracle].map(Score::thousandths);
        score.saturating_sub(oracle) as f64 / 1000.0
    }

    /// In steps.
    pub(super) fn score_steps(&self) -> f64 {
        self.score.thousandths() as f64 / 1000.0
    }
}

/// A number without decimals, or with those that it has.
pub(super) fn plain(number: &f64) -> String {
    let text = format!("{number:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.replace('-', "\u{2212}")
}

/// The end of an axis for the numbers of each robot: the largest, but at most three times what half
/// of the robots need. A robot that is far worse than the others must not make them look alike.
pub(super) fn axis_end(robots: &[Vec<f64>]) -> f64 {
    let mut needs: Vec<f64> = robots
        .iter()
        .filter_map(|numbers| {
            let mut sorted = numbers.clone();
            sorted.sort_by(f64::total_cmp);
            // All but a few.
            let rank = (sorted.len() * 97).div_ceil(100).max(1);
            sorted.get(rank - 1).copied()
        })
        .collect();
    needs.sort_by(f64::total_cmp);
    let half = needs.get(needs.len().saturating_sub(1) / 2).copied();
    let largest = robots.iter().flatten().copied().fold(0.0, f64::max);
    // Of one robot, everything that it usually needs.
    let limit = half.unwrap_or(largest) * if needs.len() > 1 { 3.0 } else { 2.0 };
    (largest.min(limit) * 1.05).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_bad_robot_does_not_stretch_an_axis() {
        let end = |robots: &[&[f64]]| {
            let robots: Vec<Vec<f64>> = robots.iter().map(|it| it.to_vec()).collect();
            (axis_end(&robots) * 100.0).round() / 100.0
        };
        assert_eq!(end(&[&[10.0, 20.0]]), 21.0);
        assert_eq!(end(&[&[20.0], &[25.0], &[400.0]]), 78.75);
        assert_eq!(end(&[&[20.0], &[25.0]]), 26.25);
        assert_eq!(end(&[&[20.0], &[90.0]]), 63.0);
        assert_eq!([end(&[]), end(&[&[]]), end(&[&[0.0]])], [1.0; 3]);
    }

    #[test]
    fn numbers_have_the_decimals_that_they_need() {
        let texts = [0.0, 20.0, 2.5, -7.0, 0.05].map(|it| plain(&it));
        assert_eq!(texts, ["0", "20", "2.5", "\u{2212}7", "0.05"]);
    }
}
