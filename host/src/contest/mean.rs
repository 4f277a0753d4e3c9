//! [`Mean`]: an exact average of scores, margins or differences.

use std::cmp::Ordering;
use std::fmt;

use wasmouse_core::game::Score;

/// The average of one or more scores or of what is made from scores, as an
/// exact fraction.
///
/// Orders exactly and displays with three decimals, rounded half to even.
///
/// ```
/// use wasmouse::contest::Mean;
/// use wasmouse_core::game::Score;
///
/// let scores = [Score::new(17, 18, 30), Score::new(22, 23, 30)];
/// let mean = scores.into_iter().map(Mean::from).collect::<Option<Mean>>();
/// let mean = mean.expect("two scores");
/// assert_eq!(mean.to_string(), "20.183");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    /// Average times the denominator; negative for a difference of averages.
    numerator: i128,
    /// At least 1.
    denominator: i128,
}

impl Mean {
    /// A single number, given as a fraction.
    ///
    /// # Panics
    ///
    /// When `denominator` is less than 1.
    pub const fn fraction(numerator: i128, denominator: i128) -> Self {
        assert!(denominator >= 1, "a denominator is at least 1");
        Self {
            numerator,
            denominator,
        }
    }

    /// How much larger this average is than another of as many scores.
    pub fn minus(self, other: Self) -> Self {
        Self {
            numerator: self.numerator * other.denominator - other.numerator * self.denominator,
            denominator: self.denominator * other.denominator,
        }
    }

    /// This many times the average: the sum of what it is the average of.
    #[must_use]
    pub const fn times(self, count: u32) -> Self {
        Self {
            numerator: self.numerator * count as i128,
            denominator: self.denominator,
        }
    }

    /// The average in thousandths of a step, rounded half to even.
    pub const fn thousandths(self) -> i64 {
        let numerator = self.numerator * 1000;
        let (quotient, rest) = (
            numerator.div_euclid(self.denominator),
            numerator.rem_euclid(self.denominator),
        );
        let twice = rest * 2;
        let round_up = twice > self.denominator || (twice == self.denominator && quotient % 2 != 0);
        (quotient + round_up as i128) as i64
    }
}

impl From<Score> for Mean {
    fn from(score: Score) -> Self {
        Self {
            numerator: numerator(score),
            denominator: i128::from(score.divisor()),
        }
    }
}

impl FromIterator<Mean> for Option<Mean> {
    /// The average of numbers, each counted once; `None` of none.
    ///
    /// Exact as long as the denominators have few different prime factors, as
    /// those of one ruleset have.
    fn from_iter<I: IntoIterator<Item = Mean>>(numbers: I) -> Self {
        let (mut sum, mut count) = (Mean::fraction(0, 1), 0);
        for number in numbers {
            let shared = gcd(sum.denominator, number.denominator);
            let (ours, theirs) = (sum.denominator / shared, number.denominator / shared);
            sum.numerator = sum.numerator * theirs + number.numerator * ours;
            sum.denominator *= theirs;
            count += 1;
        }
        sum.denominator *= count;
        (count > 0).then_some(sum)
    }
}

/// The greatest common divisor of two numbers that are at least 1.
const fn gcd(mut a: i128, mut b: i128) -> i128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

fn numerator(score: Score) -> i128 {
    i128::from(score.speed_steps()) * i128::from(score.divisor())
        + i128::from(score.exploration_steps())
}

impl PartialEq for Mean {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Mean {}

impl PartialOrd for Mean {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Mean {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.numerator * other.denominator).cmp(&(other.numerator * self.denominator))
    }
}

impl fmt::Display for Mean {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let thousandths = self.thousandths();
        let sign = if thousandths < 0 { "-" } else { "" };
        let size = thousandths.unsigned_abs();
        f.pad(&format!("{sign}{}.{:03}", size / 1000, size % 1000))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(scores: &[(u32, u32)]) -> Option<Mean> {
        scores
            .iter()
            .map(|&(speed, exploration)| Mean::from(Score::new(speed, exploration, 30)))
            .collect()
    }

    #[test]
    fn averages_are_exact() {
        assert_eq!(mean(&[]), None);
        assert_eq!(mean(&[(10, 30)]), mean(&[(11, 0), (9, 60)]));
        assert!(mean(&[(10, 1), (10, 0)]) > mean(&[(10, 0)]));
    }

    #[test]
    fn fractions_are_averaged_exactly() {
        let average = |numbers: &[(i128, i128)]| -> Option<Mean> {
            let numbers = numbers.iter();
            numbers.map(|&(a, b)| Mean::fraction(a, b)).collect()
        };
        assert_eq!(average(&[]), None);
        assert_eq!(average(&[(1, 2), (1, 3)]), average(&[(5, 12)]));
        assert_eq!(average(&[(-1, 30), (1, 50)]), average(&[(-1, 150)]));
        assert_eq!(average(&[(7, 30); 2000]), average(&[(7, 30)]));
    }

    #[test]
    fn prints_three_decimals_and_a_sign() {
        let (low, high) = (mean(&[(17, 18)]), mean(&[(20, 0), (20, 1)]));
        let (low, high) = (low.expect("a score"), high.expect("two scores"));
        assert_eq!(high.minus(low).to_string(), "2.417");
        assert_eq!(low.minus(high).to_string(), "-2.417");
        assert_eq!(low.minus(low).to_string(), "0.000");
    }
}
