//! [`Points`]: a match as one integer.

use wasmouse_core::game::{Ruleset, Steps};

use crate::contest::matrix::{MatchScore, Outcome};
use crate::contest::mean::Mean;
use crate::contest::scoring::Scoring;

/// Scores of one ruleset as integers: steps times the divisor of the exploration run's steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points {
    /// What one step of the speed run is.
    pub(super) divisor: u64,
    /// What an unfinished match counts as.
    pub(super) penalty: u64,
}

impl Points {
    pub(super) fn new(rules: &Ruleset, scoring: &Scoring) -> Self {
        let divisor = u64::from(rules.game.exploration_divisor);
        Self {
            divisor,
            penalty: u64::from(scoring.penalty_steps(&rules.game)) * divisor,
        }
    }

    /// The score of these steps. Fits: `(2^32 - 1)^2 + 2^32 - 1` is less than `2^64`.
    pub(super) fn of_steps(&self, speed: u32, exploration: u32) -> u64 {
        u64::from(speed) * self.divisor + u64::from(exploration)
    }

    /// The score of a match; `None` unless finished.
    pub(super) fn score(&self, played: &MatchScore) -> Option<u64> {
        let Steps { exploration, speed } = played.steps;
        let is_finished = played.outcome == Outcome::Finished;
        is_finished.then(|| self.of_steps(speed, exploration))
    }

    /// The average of `weight` matches with that sum, in steps; `None` of no match.
    pub(super) fn mean(&self, sum: i128, weight: u64) -> Option<Mean> {
        let denominator = i128::from(self.divisor) * i128::from(weight);
        (weight > 0).then(|| Mean::fraction(sum, denominator))
    }
}
