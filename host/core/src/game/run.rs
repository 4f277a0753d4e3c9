//! [`Run`]: the two runs of a match, and their [`Steps`].

use serde::{Deserialize, Serialize};

/// One of the two runs of a match. Serialises as `"exploration"` or `"speed"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Run {
    /// The exploration run: from the first step to the reset.
    Exploration,
    /// The speed run: from the reset to the first step that ends in the goal.
    Speed,
}

impl Run {
    /// 1 for the exploration run, 2 for the speed run, as in
    /// [`Trace::identity_bytes`](super::Trace::identity_bytes).
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

/// Steps taken in each run. Serialises as `{"exploration": 25, "speed": 17}`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Steps {
    /// Steps of the exploration run, including the reset.
    pub exploration: u32,
    /// Steps of the speed run.
    pub speed: u32,
}

impl Steps {
    /// Steps of both runs.
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
