//! [`Bootstrap`]: how far the average of a sample may be from that of everything it was drawn
//! from.
//!
//! The interval is BCa, bias-corrected and accelerated: Efron and Tibshirani, "An Introduction to
//! the Bootstrap", 1993, chapter 14. It follows skewed samples, such as score differences with a
//! few penalties in them, better than the plain percentiles do.
//!
//! Every machine computes the same bytes: resamples come from a fixed seed, sums are those of
//! integers, and the functions that the standard library takes from the system come from `libm`.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};

/// Resamples of a sample that is not huge.
pub(super) const RESAMPLES: usize = 10_000;

/// Draws of all resamples together: samples of more than 20,000 get fewer resamples, which decide
/// as well, because their averages hardly differ.
const DRAWS_MAX: usize = 200_000_000;

/// The least number of resamples. 25 of them are then beyond each end of the interval.
const RESAMPLES_MIN: usize = 1000;

/// The key of the random numbers.
const KEY: [u8; 32] = *b"wasmouse paired bootstrap 1\0\0\0\0\0";

/// The normal distribution's quantile at 97.5 %.
const Z_95: f64 = 1.959_963_984_540_054;

/// The uncertainty of a weighted average.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bootstrap {
    /// The ends of the 95 % interval.
    pub(super) interval: [f64; 2],
    /// The standard error, by the jackknife.
    pub(super) standard_error: f64,
}

/// One of the values that are averaged.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub(super) value: i64,
    pub(super) weight: u32,
}

/// Values and weights added up.
#[derive(Clone, Copy, Default)]
struct Sum {
    value: i128,
    weight: u64,
}

impl Sum {
    fn add(&mut self, item: Item) {
        self.value += i128::from(item.value) * i128::from(item.weight);
        self.weight += u64::from(item.weight);
    }

    fn without(self, item: Item) -> Self {
        Self {
            value: self.value - i128::from(item.value) * i128::from(item.weight),
            weight: self.weight - u64::from(item.weight),
        }
    }

    /// Exact up to rounding once or twice, the same for a value and its negative.
    fn mean(self) -> f64 {
        self.value as f64 / self.weight as f64
    }
}

impl Bootstrap {
    /// The uncertainty of the average of these items, which are drawn independently; `None` of
    /// fewer than two.
    pub(super) fn new(items: &[Item]) -> Option<Self> {
        let draws = DRAWS_MAX / items.len().max(1);
        Self::with_resamples(items, draws.clamp(RESAMPLES_MIN, RESAMPLES), KEY)
    }

    fn with_resamples(items: &[Item], count: usize, key: [u8; 32]) -> Option<Self> {
        if items.len() < 2 {
            return None;
        }
        let mut sum = Sum::default();
        items.iter().for_each(|&item| sum.add(item));
        let estimate = sum.mean();
        let (standard_error, acceleration) = jackknife(items, sum);
        let resamples = resamples(items, count, key);
        // Twice the number below, so that those that are equal count half.
        let below = resamples.iter().map(|it| match it.total_cmp(&estimate) {
            std::cmp::Ordering::Less => 2,
            std::cmp::Ordering::Equal => 1,
            std::cmp::Ordering::Greater => 0,
        });
        let bias = normal_quantile(below.sum(), 2 * count);
        let end = |z: f64| {
            let shifted = bias + z;
            resamples[index(bias + shifted / (1.0 - acceleration * shifted), count)]
        };
        Some(Self {
            interval: [end(-Z_95), end(Z_95)],
            standard_error,
        })
    }
}

/// The averages of `count` samples that are drawn from the items with replacement, sorted.
fn resamples(items: &[Item], count: usize, key: [u8; 32]) -> Vec<f64> {
    let mut random = ChaCha8Rng::from_seed(key);
    let mut means = Vec::with_capacity(count);
    for _ in 0..count {
        let mut sum = Sum::default();
        for _ in 0..items.len() {
            // Not exactly uniform: some items are more likely, by less than one in 2^32 / items.
            let product = u64::from(random.next_u32()) * items.len() as u64;
            sum.add(items[(product >> 32) as usize]);
        }
        means.push(sum.mean());
    }
    means.sort_unstable_by(f64::total_cmp);
    means
}

/// The standard error and the acceleration: how the average changes without each of the items.
fn jackknife(items: &[Item], sum: Sum) -> (f64, f64) {
    let count = items.len() as f64;
    let mean = |item: &Item| sum.without(*item).mean();
    let center = items.iter().map(mean).sum::<f64>() / count;
    let (mut squares, mut cubes) = (0.0, 0.0);
    for item in items {
        let difference = center - mean(item);
        squares += difference * difference;
        cubes += difference * difference * difference;
    }
    let acceleration = match squares > 0.0 {
        true => cubes / (6.0 * squares * squares.sqrt()),
        false => 0.0,
    };
    ((squares * (count - 1.0) / count).sqrt(), acceleration)
}

/// The place of a quantile among `count` sorted numbers, given by its normal quantile. That of
/// `-z` is as far from the other end.
fn index(z: f64, count: usize) -> usize {
    let from_end = (normal_tail(z.abs()) * count as f64) as usize;
    let from_end = from_end.min(count - 1);
    if z < 0.0 {
        from_end
    } else {
        count - 1 - from_end
    }
}

/// The probability that a normal number is larger than `z`.
fn normal_tail(z: f64) -> f64 {
    0.5 * libm::erfc(z * std::f64::consts::FRAC_1_SQRT_2)
}

/// The number that a normal number is below with a probability of `part / whole`, which is taken
/// to be neither 0 nor 1.
fn normal_quantile(part: usize, whole: usize) -> f64 {
    if part * 2 > whole {
        return -normal_quantile(whole - part, whole);
    }
    let probability = (part as f64).max(0.5) / whole as f64;
    // Bisection: 40 bits of a number between 0 and 8, for which nothing is more likely than 1 in
    // 10^15.
    let (mut low, mut high) = (0.0, 8.0);
    for _ in 0..43 {
        let middle = (low + high) / 2.0;
        match normal_tail(middle) > probability {
            true => low = middle,
            false => high = middle,
        }
    }
    -low
}

#[cfg(test)]
mod tests {
    use super::*;

    fn items(values: impl IntoIterator<Item = i64>) -> Vec<Item> {
        let values = values.into_iter();
        values.map(|value| Item { value, weight: 1 }).collect()
    }

    #[test]
    fn the_normal_distribution_is_that_of_the_tables() {
        for (part, z) in [
            (500, 0.0),
            (159, -0.998_576),
            (975, 1.959_964),
            (1, -3.090_232),
        ] {
            let found = normal_quantile(part, 1000);
            assert!((found - z).abs() < 1e-6, "{part}: {found}");
        }
        assert!((normal_tail(1.0) - 0.158_655_254).abs() < 1e-9);
        assert_eq!((index(-Z_95, 10_000), index(Z_95, 10_000)), (250, 9749));
    }

    /// SciPy 1.17.1 (`stats.bootstrap`, BCa) finds 4.25 and 11.83 with 400,000 resamples, and up to
    /// 0.1 and 0.4 beside them with 10,000. Plain percentiles are 3.75 and 10.75.
    #[test]
    fn a_skewed_sample_has_the_interval_of_another_implementation() {
        let sample = items([1, 2, 2, 3, 3, 4, 5, 6, 8, 11, 15, 23]);
        let bootstrap = Bootstrap::new(&sample).expect("12 items");
        let error = bootstrap.standard_error;
        assert!((error - 1.884_781).abs() < 1e-6, "{error}");
        let [low, high] = bootstrap.interval;
        assert!((4.15..4.36).contains(&low), "{low}");
        assert!((11.5..12.1).contains(&high), "{high}");
    }

    #[test]
    fn equal_items_leave_no_doubt_and_one_item_says_nothing() {
        let bootstrap = Bootstrap::new(&items([7; 9])).expect("nine items");
        assert_eq!(
            (bootstrap.interval, bootstrap.standard_error),
            ([7.0; 2], 0.0)
        );
        assert_eq!(Bootstrap::new(&items([7])), None);
    }

    /// The interval contains the true average in about 95 % of samples, also of skewed numbers.
    #[test]
    fn the_interval_covers_the_true_average() {
        let mut random = ChaCha8Rng::from_seed([7; 32]);
        let mut uniform = || i64::from(random.next_u32() >> 16);
        type Draw<'a> = &'a mut dyn FnMut() -> i64;
        // Sums of uniform numbers from 0 to 65,535, and products, whose average is a quarter.
        let mut check = |name: &str, draw: &mut dyn FnMut(Draw<'_>) -> i64, average: f64| {
            let samples = 400;
            let mut covered = 0;
            for sample in 0..samples {
                let sample_items = items((0..40).map(|_| draw(&mut uniform)));
                let mut key = [0; 32];
                key[..4].copy_from_slice(&u32::to_le_bytes(sample));
                let found = Bootstrap::with_resamples(&sample_items, 1000, key);
                let [low, high] = found.expect("40 items").interval;
                covered += u32::from(low <= average && average <= high);
            }
            let percent = f64::from(covered) * 100.0 / f64::from(samples);
            assert!((92.0..98.0).contains(&percent), "{name}: {percent} %");
        };
        let mut bell = |draw: Draw<'_>| draw() + draw() + draw() - 3 * 32_768;
        check("symmetric", &mut bell, -1.5);
        let mut skewed = |draw: Draw<'_>| (draw() * draw()) >> 16;
        check("skewed", &mut skewed, 16_383.0);
    }
}
