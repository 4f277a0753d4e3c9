//! [`Rubric`]: what is played and what is expected. It has been read and checked; `read` does that.

use wasmouse_core::Digest;
use wasmouse_core::game::Ruleset;

use super::super::plan::Seeds;

/// What robots are graded by.
#[derive(Clone, Debug, PartialEq)]
pub struct Rubric {
    /// What reports call it.
    pub name: String,
    /// The digest of its file, so that two grades can be seen to be of one rubric.
    pub digest: Digest,
    /// The rules of all matches.
    pub rules: Ruleset,
    /// The seeds of every maze.
    pub seeds: Seeds,
    /// Named sets of mazes. At least one; a maze may be in several.
    pub sets: Vec<RubricSet>,
    /// What is expected. At least one.
    pub criteria: Vec<Criterion>,
    /// When a grade is a pass.
    pub mark: Mark,
}

/// A named set of mazes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RubricSet {
    /// The name, by which criteria refer to it.
    pub name: String,
    /// Specifications of mazes: names of bundled ones, files, folders, `gen:`. At least one.
    pub mazes: Vec<String>,
    /// Whether they may break contest rules.
    pub is_lenient: bool,
}

/// One thing that is expected, and what it is worth.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Criterion {
    /// What reports call it. Unique.
    pub name: String,
    /// Points for meeting it. Range: 0 to 10,000.
    pub points: u32,
    /// Names of sets and mazes; empty for all mazes.
    pub mazes: Vec<String>,
    /// What is expected there.
    pub expectation: Expectation,
}

/// When a grade is a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// At least this many thousandths of a percent of all points. Range: 0 to 100,000.
    Percent(i64),
    /// At least this many points.
    Points(u32),
}

/// What is expected of a robot in some mazes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expectation {
    /// A measure of the robot alone.
    Measure(Target, Threshold),
    /// That it scores better than a reference robot in at least so many percent of the matches;
    /// as well counts half.
    Beats {
        /// How the rubric names the reference robot.
        robot: String,
        /// Percent.
        percent: Threshold,
    },
    /// That its average score exceeds a recorded one by at most so many steps.
    Baseline {
        /// The file of results, as the rubric names it.
        file: String,
        /// Whose results, if the file has those of several robots: a name, or a digest.
        robot: Option<String>,
        /// Steps.
        steps: Threshold,
    },
    /// That it is not significantly worse than a reference robot.
    NoWorseThan {
        /// How the rubric names the reference robot.
        robot: String,
    },
}

/// What is measured of a robot alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Percent of the matches that were finished.
    FinishedPercent,
    /// The average score; an unfinished match counts as the worst score that the rules allow.
    MeanScore,
    /// The average of score minus oracle score, with the same penalty.
    MeanRegret,
    /// Matches that ended in a fault.
    Faults,
    /// Average fuel of a step.
    StepFuelMean,
    /// Fuel of the most expensive step.
    StepFuelMax,
    /// The most linear memory in any match, in bytes.
    MemoryBytesMax,
}

impl Target {
    /// All targets.
    pub const ALL: [Self; 7] = [
        Self::FinishedPercent,
        Self::MeanScore,
        Self::MeanRegret,
        Self::Faults,
        Self::StepFuelMean,
        Self::StepFuelMax,
        Self::MemoryBytesMax,
    ];

    /// Its key in rubrics and its name in results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::FinishedPercent => "finished_percent",
            Self::MeanScore => "mean_score",
            Self::MeanRegret => "mean_regret",
            Self::Faults => "faults",
            Self::StepFuelMean => "step_fuel_mean",
            Self::StepFuelMax => "step_fuel_max",
            Self::MemoryBytesMax => "memory_bytes_max",
        }
    }

    /// Whether larger values are better.
    pub const fn is_more_better(self) -> bool {
        matches!(self, Self::FinishedPercent)
    }
}

impl Expectation {
    /// Its key in rubrics and its name in results.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Measure(target, _) => target.name(),
            Self::Beats { .. } => "beats",
            Self::Baseline { .. } => "baseline",
            Self::NoWorseThan { .. } => "no_worse_than",
        }
    }

    /// The threshold; `None` where there is none to choose.
    pub const fn threshold(&self) -> Option<Threshold> {
        match self {
            Self::Measure(_, threshold)
            | Self::Beats {
                percent: threshold, ..
            }
            | Self::Baseline {
                steps: threshold, ..
            } => Some(*threshold),
            Self::NoWorseThan { .. } => None,
        }
    }

    /// Whether larger values are better.
    pub const fn is_more_better(&self) -> bool {
        match self {
            Self::Measure(target, _) => target.is_more_better(),
            Self::Beats { .. } => true,
            Self::Baseline { .. } | Self::NoWorseThan { .. } => false,
        }
    }

    /// The reference robot, as the rubric names it.
    pub fn reference(&self) -> Option<&str> {
        match self {
            Self::Beats { robot, .. } | Self::NoWorseThan { robot, .. } => Some(robot),
            Self::Measure(..) | Self::Baseline { .. } => None,
        }
    }
}

/// The value that earns all points, and the one that earns none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Threshold {
    /// A value that is at least as good earns all points. In thousandths.
    pub full: i64,
    /// A value that is no better earns no points, and those in between earn a part. In
    /// thousandths; worse than `full`. `None`: nothing in between earns anything.
    pub none: Option<i64>,
}

impl Rubric {
    /// The points of all criteria.
    pub fn points_max(&self) -> u32 {
        self.criteria.iter().map(|it| it.points).sum()
    }
}

impl Mark {
    /// Whether that many thousandths of a point out of so many points pass.
    ///
    /// ```
    /// use wasmouse::contest::grade::Mark;
    /// assert!(Mark::Percent(60_000).is_reached(6_000, 10));
    /// assert!(!Mark::Percent(60_000).is_reached(5_999, 10));
    /// assert!(Mark::Points(6).is_reached(6_000, 10));
    /// ```
    pub const fn is_reached(self, thousandths: u64, points_max: u32) -> bool {
        match self {
            Self::Percent(percent) => {
                thousandths as i128 * 100_000 >= percent as i128 * points_max as i128 * 1000
            }
            Self::Points(points) => thousandths >= points as u64 * 1000,
        }
    }
}
