//! [`Percentiles`]: how the scores of a robot are distributed.

use super::points::Points;
use crate::contest::mean::Mean;

/// Percentiles of all matches of a robot, in steps; an unfinished match counts as the penalty.
///
/// By the nearest rank: the p-th percentile is the least score that at least p percent of the
/// matches do not exceed, so it is always one that the robot had. Every match counts as often as
/// its maze does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Percentiles {
    /// One match in ten is as good as this or better.
    pub p10: Mean,
    /// The first quartile.
    pub p25: Mean,
    /// The median.
    pub p50: Mean,
    /// The third quartile.
    pub p75: Mean,
    /// Nine matches in ten are as good as this or better.
    pub p90: Mean,
}

/// The percentiles that reports show, in percent.
const PERCENTS: [u64; 5] = [10, 25, 50, 75, 90];

/// The scores at [`PERCENTS`]; `None` of no match. Sorts the scores, each of which has a weight
/// of at least 1.
pub(super) fn percentile_scores(scores: &mut [(u64, u32)]) -> Option<[u64; 5]> {
    scores.sort_unstable();
    let total: u64 = scores.iter().map(|&(_, weight)| u64::from(weight)).sum();
    let (&(last, _), mut found, mut next) = (scores.last()?, [0; 5], 0);
    found.fill(last);
    let mut below = 0;
    for &(score, weight) in &*scores {
        below += u64::from(weight);
        while next < PERCENTS.len() && below * 100 >= total * PERCENTS[next] {
            found[next] = score;
            next += 1;
        }
    }
    Some(found)
}

impl Percentiles {
    /// The percentiles with these scores, at 10, 25, 50, 75 and 90 percent.
    pub(super) fn new(points: &Points, scores: [u64; 5]) -> Self {
        let mean = |score: u64| Mean::fraction(score.into(), points.divisor.into());
        let [p10, p25, p50, p75, p90] = scores.map(mean);
        Self {
            p10,
            p25,
            p50,
            p75,
            p90,
        }
    }
}
