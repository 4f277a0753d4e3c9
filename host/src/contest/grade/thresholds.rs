//! [`Thresholds`]: what is expected of every robot of a contest, without a rubric.

use std::fmt;
use std::str::FromStr;

use super::super::matrix::ScoreMatrix;
use super::super::mean::Mean;
use super::measure::Scope;
use super::rubric::Target;

/// Least or largest values, such as `finished=95%,regret=3`.
///
/// ```
/// use wasmouse::contest::grade::Thresholds;
/// let thresholds: Thresholds = "finished=95%,regret=3.5,faults=0".parse()?;
/// assert_eq!(thresholds.to_string(), "finished=95,regret=3.5,faults=0");
/// let error = "finish=95".parse::<Thresholds>().expect_err("no such key");
/// assert_eq!(error, "unknown key `finish`; the keys are finished, score, regret, faults, fuel");
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thresholds(Vec<(Target, i64)>);

/// The keys, with what they mean.
const KEYS: [(&str, Target); 5] = [
    ("finished", Target::FinishedPercent),
    ("score", Target::MeanScore),
    ("regret", Target::MeanRegret),
    ("faults", Target::Faults),
    ("fuel", Target::StepFuelMean),
];

/// A threshold that a robot missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Missed {
    /// What was measured.
    pub target: Target,
    /// The least or largest value, in thousandths.
    pub limit_thousandths: i64,
    /// What was found, in thousandths; `None` when nothing could be measured.
    pub found_thousandths: Option<i64>,
}

impl Thresholds {
    /// Whether there is one for that.
    pub fn limits(&self, target: Target) -> bool {
        self.0.iter().any(|it| it.0 == target)
    }

    /// What a robot missed. Its matches that were not played do not count.
    pub fn missed(&self, matrix: &ScoreMatrix, robot: usize) -> Vec<Missed> {
        let mazes: Vec<usize> = (0..matrix.mazes.len()).collect();
        let scope = Scope {
            matrix,
            mazes: &mazes,
        };
        let missed = self.0.iter().filter_map(|&(target, limit_thousandths)| {
            let found = scope.measure(target, robot);
            let limit = Mean::fraction(limit_thousandths.into(), 1000);
            let is_met = found.is_some_and(|it| {
                if target.is_more_better() {
                    it >= limit
                } else {
                    it <= limit
                }
            });
            (!is_met).then(|| Missed {
                target,
                limit_thousandths,
                found_thousandths: found.map(Mean::thousandths),
            })
        });
        missed.collect()
    }
}

impl FromStr for Thresholds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut thresholds: Vec<(Target, i64)> = Vec::new();
        for part in text.split(',') {
            let part = part.trim();
            let (key, value) = part
                .split_once('=')
                .ok_or_else(|| format!("expected KEY=VALUE, found `{part}`"))?;
            let known = KEYS.iter().find(|(name, _)| *name == key);
            let Some(&(_, target)) = known else {
                let names = KEYS.map(|(name, _)| name).join(", ");
                return Err(format!("unknown key `{key}`; the keys are {names}"));
            };
            if thresholds.iter().any(|it| it.0 == target) {
                return Err(format!("`{key}` is given twice"));
            }
            let number = match target {
                Target::FinishedPercent => value.strip_suffix('%').unwrap_or(value),
                _ => value,
            };
            let limit = thousandths(number).ok_or_else(|| {
                format!("`{key}` needs a number such as 3 or 3.5, found `{value}`")
            })?;
            if target == Target::FinishedPercent && limit > 100_000 {
                return Err(format!(
                    "`{key}` is a percentage of at most 100, found `{value}`"
                ));
            }
            thresholds.push((target, limit));
        }
        Ok(Self(thresholds))
    }
}

/// A number of at most three decimals, in thousandths. Range: 0 to 10^15.
fn thousandths(text: &str) -> Option<i64> {
    let (whole, decimals) = text.split_once('.').unwrap_or((text, "0"));
    let is_number = |it: &str| !it.is_empty() && it.bytes().all(|byte| byte.is_ascii_digit());
    if !is_number(whole) || !is_number(decimals) || whole.len() > 12 || decimals.len() > 3 {
        return None;
    }
    let whole: i64 = whole.parse().ok()?;
    let decimals: i64 = format!("{decimals:0<3}").parse().ok()?;
    Some(whole * 1000 + decimals)
}

impl fmt::Display for Thresholds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (target, limit)) in self.0.iter().enumerate() {
            let comma = if index == 0 { "" } else { "," };
            let name = KEYS.iter().find(|it| it.1 == *target);
            let name = name.map_or("?", |it| it.0);
            write!(f, "{comma}{name}={}", *limit / 1000)?;
            let decimals = format!("{:03}", *limit % 1000);
            let decimals = decimals.trim_end_matches('0');
            if !decimals.is_empty() {
                write!(f, ".{decimals}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_thresholds_are_refused() {
        for (text, expected) in [
            ("", "expected KEY=VALUE, found ``"),
            ("finished", "expected KEY=VALUE, found `finished`"),
            (
                "regret=",
                "`regret` needs a number such as 3 or 3.5, found ``",
            ),
            (
                "regret=3%",
                "`regret` needs a number such as 3 or 3.5, found `3%`",
            ),
            (
                "score=-1",
                "`score` needs a number such as 3 or 3.5, found `-1`",
            ),
            (
                "score=1.0001",
                "`score` needs a number such as 3 or 3.5, found `1.0001`",
            ),
            (
                "score=1e3",
                "`score` needs a number such as 3 or 3.5, found `1e3`",
            ),
            (
                "finished=101%",
                "`finished` is a percentage of at most 100, found `101%`",
            ),
            ("score=1,score=2", "`score` is given twice"),
        ] {
            assert_eq!(
                text.parse::<Thresholds>(),
                Err(expected.to_owned()),
                "{text}"
            );
        }
        assert!("fuel=999999999999.999".parse::<Thresholds>().is_ok());
    }
}
