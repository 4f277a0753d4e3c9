//! [`Run`]: the two runs of a match, and their [`Steps`].

use serde::{Deserialize, Serialize};

/// The two runs of a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Run {
    /// The exploration run: the robot may go where it likes, until it resets.
    Exploration,
    /// The speed run: ends with the first step that ends in the goal.
    Speed,
}

impl Run {
    /// 1 or 2.
    pub const fn number(self) -> u8 {
        match self {
            Self::Exploration => 1,
            Self::Speed => 2,
        }
    }

    /// `exploration run` or `speed run`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exploration => "exploration run",
            Self::Speed => "speed run",
        }
    }
}

/// Steps taken in each run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Steps {
    /// Steps of the exploration run, with the reset.
    pub exploration: u32,
    /// Steps of the speed run.
    pub speed: u32,
}

impl Steps {
    /// Steps of both runs. Saturates: a record that was read may claim any number.
    pub const fn total(self) -> u32 {
        self.exploration.saturating_add(self.speed)
    }

    /// Steps of one run.
    pub const fn of(self, run: Run) -> u32 {
        match run {
            Run::Exploration => self.exploration,
            Run::Speed => self.speed,
        }
    }
}
