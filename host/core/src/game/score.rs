//! [`Score`]: the score of a finished match, as exact integers.

use std::cmp::Ordering;
use std::fmt;

use serde::{Deserialize, Serialize};

/// Steps of the speed run plus steps of the exploration run divided by a divisor; lower is
/// better.
///
/// The parts are integers, so that comparisons are exact. Two scores are equal if their values
/// are, whatever their parts. Displays with three decimals, rounded half to even.
///
/// Serialises as `{"thousandths": 20667, "speed_steps": 17, "exploration_steps": 110,
/// "exploration_divisor": 30}`; deserialising fails if the thousandths do not match the parts.
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
    /// If `divisor` is 0.
    pub const fn new(speed_steps: u32, exploration_steps: u32, divisor: u32) -> Self {
        assert!(divisor > 0, "the exploration divisor is 0");
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

    /// Steps of the exploration run, including the reset.
    pub const fn exploration_steps(self) -> u32 {
        self.exploration_steps
    }

    /// The divisor of the exploration run's steps; at least 1.
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
            return Err("the exploration divisor of a score is 0");
        }
        let score = Self::new(
            form.speed_steps,
            form.exploration_steps,
            form.exploration_divisor,
        );
        let is_consistent = score.thousandths() == form.thousandths;
        is_consistent
            .then_some(score)
            .ok_or("the thousandths of a score do not match its steps")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_score_displays_three_decimals() {
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
    fn scores_compare_exactly() {
        assert_eq!(Score::new(1, 0, 30), Score::new(0, 7, 7));
        assert!(Score::new(10, 1, 3) > Score::new(10, 33, 100));
    }

    #[test]
    fn a_score_deserialises_only_if_it_is_consistent() {
        let json = r#"{"thousandths":20667,"speed_steps":17,"exploration_steps":110,"exploration_divisor":30}"#;
        let score = serde_json::from_str::<Score>(json).expect("a score");
        assert_eq!(score, Score::new(17, 110, 30));
        assert_eq!(serde_json::to_string(&score).expect("it serialises"), json);
        for (from, to, message) in [
            ("20667", "20666", "do not match its steps"),
            (":30", ":0", "divisor of a score is 0"),
            ("{", "{\"seed\":1,", "unknown field"),
        ] {
            let changed = json.replace(from, to);
            let error = serde_json::from_str::<Score>(&changed).expect_err(to);
            assert!(error.to_string().contains(message), "{error}");
        }
    }
}
