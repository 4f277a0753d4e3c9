//! [`Scale`]: an axis from 0 to a round number, and percentiles.

/// An axis from 0 to a number that is a multiple of its step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Scale {
    /// The distance between ticks, at least 1.
    pub(super) step: u64,
    /// The end of the axis, at least 1.
    pub(super) end: u64,
}

impl Scale {
    /// The axis on which the largest value has its place, with at most `ticks` steps.
    pub(super) fn new(largest: u64, ticks: u64) -> Self {
        let largest = largest.max(1);
        let mut step = 1_u64;
        // 1, 2, 5, 10, 20, 50, ...
        let factors = [2, 5, 10];
        let mut unit = 1_u64;
        'search: loop {
            for factor in factors {
                if largest.div_ceil(step) <= ticks {
                    break 'search;
                }
                step = unit.saturating_mul(factor);
            }
            unit = unit.saturating_mul(10);
        }
        Self {
            step,
            end: largest.div_ceil(step).saturating_mul(step),
        }
    }

    /// The numbers at the ticks.
    pub(super) fn ticks(self) -> impl Iterator<Item = u64> {
        (0..=self.end / self.step).map(move |tick| tick * self.step)
    }

    /// Where a number of thousandths is on an axis of that length; at its end if it is beyond.
    pub(super) fn place(self, thousandths: u64, length: f64) -> f64 {
        let share = thousandths as f64 / 1000.0 / self.end as f64;
        share.min(1.0) * length
    }
}

/// The number that an axis for these should reach: the largest, or the 95th percentile if the
/// largest is more than twice as large, because a few bad matches must not make all others look
/// alike. 0 of no number.
pub(super) fn extent(sorted: &[u64]) -> u64 {
    let (most, all) = (percentile(sorted, 95), percentile(sorted, 100));
    match most.zip(all) {
        Some((most, all)) if most > 0 && all / 2 > most => most,
        Some((_, all)) => all,
        None => 0,
    }
}

/// The p-th percentile of sorted numbers, by the nearest rank; `None` of no number.
pub(super) fn percentile(sorted: &[u64], percent: usize) -> Option<u64> {
    let rank = (sorted.len() * percent).div_ceil(100).max(1);
    sorted.get(rank - 1).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_end_at_round_numbers() {
        let axis = |largest| {
            let Scale { step, end } = Scale::new(largest, 5);
            (step, end)
        };
        for (largest, expected) in [
            (0, (1, 1)),
            (5, (1, 5)),
            (6, (2, 6)),
            (11, (5, 15)),
            (26, (10, 30)),
            (51, (20, 60)),
            (1034, (500, 1500)),
        ] {
            assert_eq!(axis(largest), expected, "{largest}");
        }
        assert!(Scale::new(u64::MAX, 5).ticks().count() <= 6);
        let ticks: Vec<u64> = Scale::new(26, 5).ticks().collect();
        assert_eq!(ticks, [0, 10, 20, 30]);
    }

    #[test]
    fn a_few_bad_matches_do_not_stretch_an_axis() {
        let mut numbers: Vec<u64> = (1..=100).collect();
        assert_eq!(extent(&numbers), 100);
        numbers[99] = 191;
        assert_eq!(extent(&numbers), 191);
        numbers[99] = 192;
        assert_eq!(extent(&numbers), 95);
        assert_eq!([extent(&[]), extent(&[0, 0]), extent(&[0, 9])], [0, 0, 9]);
        let axis = Scale::new(95, 4);
        assert_eq!(
            (axis.place(50_000, 10.0), axis.place(200_000, 10.0)),
            (5.0, 10.0)
        );
    }

    #[test]
    fn percentiles_are_values() {
        assert_eq!(percentile(&[], 50), None);
        assert_eq!(percentile(&[7], 10), Some(7));
        let ten: Vec<u64> = (1..=10).collect();
        assert_eq!(
            [0, 10, 25, 50, 75, 90, 100].map(|it| percentile(&ten, it)),
            [1, 1, 3, 5, 8, 9, 10].map(Some)
        );
    }
}
