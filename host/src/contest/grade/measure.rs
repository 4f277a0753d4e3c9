//! [`Scope`]: some mazes of a matrix, and what is measured in them. Everything is exact.

use std::cmp::Ordering;

use wasmouse_core::game::Score;

use super::super::matrix::{MatchScore, Outcome, ScoreMatrix};
use super::super::mean::Mean;
use super::super::scoring::worst_score_steps;
use super::rubric::Target;

/// Some mazes of a matrix with all seeds.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    pub matrix: &'a ScoreMatrix,
    /// Indices.
    pub mazes: &'a [usize],
}

impl<'a> Scope<'a> {
    /// How many matches each robot plays in it.
    pub fn matches(self) -> u64 {
        self.mazes.len() as u64 * u64::from(self.matrix.seeds.count)
    }

    /// Maze and seed of each match, by their positions.
    pub fn places(self) -> impl Iterator<Item = (usize, u32)> + 'a {
        let seeds = self.matrix.seeds.count;
        let mazes = self.mazes.iter();
        mazes.flat_map(move |&maze| (0..seeds).map(move |seed| (maze, seed)))
    }

    /// The matches of a robot that were played.
    pub fn played(self, robot: usize) -> impl Iterator<Item = (usize, &'a MatchScore)> + 'a {
        let matrix = self.matrix;
        self.places()
            .filter_map(move |(maze, seed)| Some((maze, matrix.get(robot, maze, seed)?)))
    }

    /// Whether a robot has played all of its matches.
    pub fn is_complete(self, robot: usize) -> bool {
        self.played(robot).count() as u64 == self.matches()
    }

    /// What a match counts as: its score, or the worst that the rules allow.
    pub fn cost(self, played: &MatchScore) -> Score {
        let rules = &self.matrix.rules;
        let worst = worst_score_steps(&rules.game);
        let worst = || Score::new(worst, 0, rules.game.exploration_divisor);
        played.score(rules).unwrap_or_else(worst)
    }

    /// The average of what the matches count as; `None` of none.
    pub fn mean_score(self, robot: usize) -> Option<Mean> {
        mean_of(self.played(robot).map(|(_, it)| self.cost(it)))
    }

    fn mean_regret(self, robot: usize) -> Option<Mean> {
        // A maze whose goal cannot be reached has no regret.
        let with_oracle = self.played(robot).filter_map(|(maze, played)| {
            let oracle = self.matrix.mazes[maze].oracle?;
            Some((self.cost(played), oracle))
        });
        let (costs, oracles): (Vec<Score>, Vec<Score>) = with_oracle.unzip();
        Some(mean_of(costs.into_iter())?.minus(mean_of(oracles.into_iter())?))
    }

    /// What is measured of a robot alone; `None` when there is nothing to measure.
    pub fn measure(self, target: Target, robot: usize) -> Option<Mean> {
        let count = |is_counted: &dyn Fn(&MatchScore) -> bool| {
            let counted = self.played(robot).filter(|(_, it)| is_counted(it));
            i128::try_from(counted.count()).unwrap_or(i128::MAX)
        };
        let most = |of: &dyn Fn(&MatchScore) -> u64| {
            let most = self.played(robot).map(|(_, it)| of(it)).max()?;
            Some(Mean::fraction(most.into(), 1))
        };
        match target {
            Target::FinishedPercent => {
                let finished = count(&|it| it.outcome == Outcome::Finished);
                let all = count(&|_| true);
                (all > 0).then(|| Mean::fraction(finished * 100, all))
            }
            Target::MeanScore => self.mean_score(robot),
            Target::MeanRegret => self.mean_regret(robot),
            Target::Faults => {
                let faults = count(&|it| matches!(it.outcome, Outcome::Fault(_)));
                Some(Mean::fraction(faults, 1))
            }
            Target::StepFuelMean => {
                let (mut fuel, mut steps) = (0, 0);
                for (_, played) in self.played(robot) {
                    fuel += i128::from(played.fuel.steps);
                    steps += i128::from(played.steps.total());
                }
                // A robot that never took a step used no fuel for one.
                Some(Mean::fraction(fuel, steps.max(1)))
            }
            Target::StepFuelMax => most(&|it| it.fuel.step_max),
            Target::MemoryBytesMax => most(&|it| it.memory_bytes),
        }
    }

    /// Percent of the matches in which a robot scored better than another; as well counts half.
    /// `None` without matches that both have played.
    pub fn beats_percent(self, robot: usize, other: usize) -> Option<Mean> {
        let (mut halves, mut matches) = (0, 0);
        for (maze, seed) in self.places() {
            let of = |robot| self.matrix.get(robot, maze, seed);
            let (Some(ours), Some(theirs)) = (of(robot), of(other)) else {
                continue;
            };
            matches += 1;
            halves += match self.cost(ours).cmp(&self.cost(theirs)) {
                Ordering::Less => 2,
                Ordering::Equal => 1,
                Ordering::Greater => 0,
            };
        }
        (matches > 0).then(|| Mean::fraction(halves * 50, matches))
    }
}

/// The average of scores of one ruleset; `None` of none.
pub fn mean_of(scores: impl Iterator<Item = Score>) -> Option<Mean> {
    let (mut sum, mut count, mut divisor) = (0, 0, 1);
    for score in scores {
        divisor = i128::from(score.divisor());
        sum += i128::from(score.speed_steps()) * divisor + i128::from(score.exploration_steps());
        count += 1;
    }
    (count > 0).then(|| Mean::fraction(sum, divisor * count))
}
