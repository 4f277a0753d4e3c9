//! [`RankKey`]: what decides the rank of a robot.

use std::cmp::{Ordering, Reverse};

use super::totals::Totals;
use crate::contest::mean::Mean;
use crate::contest::scoring::{Method, Scoring, TieBreak};

/// What decides the rank of a robot: exact numbers over the same matches for all robots, so that
/// sums can be compared instead of averages.
#[derive(Debug)]
pub(super) struct RankKey<'a> {
    pub(super) totals: &'a Totals,
    /// `None` of a robot without matches.
    pub(super) median: Option<u64>,
    pub(super) half_points: u64,
}

impl RankKey<'_> {
    /// The better robot is the lesser.
    pub(super) fn compare(&self, other: &Self, scoring: &Scoring) -> Ordering {
        let by_method = match scoring.method {
            // The oracle's scores are the same for both robots.
            Method::MeanScore | Method::Regret => self.totals.score.cmp(&other.totals.score),
            Method::RankPoints => other.half_points.cmp(&self.half_points),
        };
        let tie_breaks = scoring.order().iter();
        tie_breaks.fold(by_method, |order, &tie_break| {
            order.then_with(|| self.break_tie(other, tie_break))
        })
    }

    fn break_tie(&self, other: &Self, tie_break: TieBreak) -> Ordering {
        let (ours, theirs) = (self.totals, other.totals);
        match tie_break {
            TieBreak::Finished => {
                Reverse(ours.weight_finished).cmp(&Reverse(theirs.weight_finished))
            }
            TieBreak::MedianScore => none_last(self.median, other.median),
            TieBreak::ExplorationSteps => none_last::<Mean>(
                ours.mean_exploration_steps(),
                theirs.mean_exploration_steps(),
            ),
            TieBreak::Fuel => none_last(ours.step_fuel(), theirs.step_fuel()),
            TieBreak::Memory => ours.memory_bytes_max.cmp(&theirs.memory_bytes_max),
        }
    }
}

/// Lesser numbers first, and those that do not exist last.
fn none_last<T: Ord>(a: Option<T>, b: Option<T>) -> Ordering {
    (a.is_none(), a).cmp(&(b.is_none(), b))
}
