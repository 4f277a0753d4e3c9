//! [`Score`]: what a finished match is worth, as exact integers.

use std::cmp::Ordering;
use std::fmt;

use serde::{Deserialize, Serialize};

/// Steps of the speed run plus steps of the exploration run over a divisor; lower is
/// better.
///
/// Kept as integers, so that comparing and printing are exact. Displays with
/// three decimals, rounded half to even. Serialises with all of its parts and the rounded
/// value in thousandths, which has to fit the parts when it is read.
///
/// ```
/// use wasmouse_core::game::Score;
/// let score = Score::new(17, 110, 30);
/// assert_eq!(score.to_string(), "20.667");
/// assert!(score < Score::new(17, 111, 30));
/// ```
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(into = "Form", try_from = "Form")]
pub struct Score {
    speed_steps: u32,
    exploration_steps: u32,
    divisor: u32,
}

impl Score {
    /// The score of these steps.
    ///
    /// # Panics
    ///
    /// When `divisor` is 0.
    pub const fn new(speed_steps: u32, exploration_steps: u32, divisor: u32) -> Self {
        assert!(divisor > 0, "the exploration divisor is at least 1");
        Self {
            speed_steps,
            exploration_steps,
            divisor,
        }
    }

    /// Steps of the speed run.
    pub const fn speed_steps(self) -> u32 {
        self.speed_steps
    }

    /// Steps of the exploration run, the reset included.
    pub const fn exploration_steps(self) -> u32 {
        self.exploration_steps
    }

    /// What the steps of the exploration run are divided by; at least 1.
    pub const fn divisor(self) -> u32 {
        self.divisor
    }

    /// The score in thousandths of a step, rounded half to even.
    pub const fn thousandths(self) -> u64 {
        let divisor = self.divisor as u64;
        // u128: up to 2^32 * 2^32 * 1000.
        let numerator = self.numerator() * 1000;
        let quotient = (numerator / divisor as u128) as u64;
        let rest = (numerator % divisor as u128) as u64;
        let round_up = rest * 2 > divisor || (rest * 2 == divisor && quotient % 2 == 1);
        quotient + round_up as u64
    }

    /// The score times the divisor.
    const fn numerator(self) -> u128 {
        self.speed_steps as u128 * self.divisor as u128 + self.exploration_steps as u128
    }
}

impl PartialEq for Score {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Score {}

impl PartialOrd for Score {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Score {
    fn cmp(&self, other: &Self) -> Ordering {
        let left = self.numerator() * u128::from(other.divisor);
        let right = other.numerator() * u128::from(self.divisor);
        left.cmp(&right)
    }
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let thousandths = self.thousandths();
        f.pad(&format!("{}.{:03}", thousandths / 1000, thousandths % 1000))
    }
}

/// The serialised form of a score.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Form {
    thousandths: u64,
    speed_steps: u32,
    exploration_steps: u32,
    exploration_divisor: u32,
}

impl From<Score> for Form {
    fn from(score: Score) -> Self {
        Self {
            thousandths: score.thousandths(),
            speed_steps: score.speed_steps,
            exploration_steps: score.exploration_steps,
            exploration_divisor: score.divisor,
        }
    }
}

impl TryFrom<Form> for Score {
    type Error = &'static str;

    fn try_from(form: Form) -> Result<Self, &'static str> {
        if form.exploration_divisor == 0 {
            return Err("an exploration divisor is at least 1");
        }
        let score = Self::new(
            form.speed_steps,
            form.exploration_steps,
            form.exploration_divisor,
        );
        if score.thousandths() == form.thousandths {
            Ok(score)
        } else {
            Err("the thousandths of a score are not those of its steps")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prints_three_decimals() {
        for (speed, exploration, divisor, text) in [
            (17, 18, 30, "17.600"),
            (22, 23, 30, "22.767"),
            (25, 26, 30, "25.867"),
            (572, 361, 30, "584.033"),
            (0, 1, 16, "0.062"),
            (0, 3, 16, "0.188"),
            (u32::MAX, u32::MAX, 1, "8589934590.000"),
        ] {
            assert_eq!(Score::new(speed, exploration, divisor).to_string(), text);
        }
    }

    #[test]
    fn compares_exactly() {
        assert_eq!(Score::new(1, 0, 30), Score::new(0, 7, 7));
        assert!(Score::new(10, 1, 3) > Score::new(10, 33, 100));
    }
}
