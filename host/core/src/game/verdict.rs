//! [`Verdict`]: how a match ended, and [`Fault`]: how a robot's own doing ended it.

use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::{Run, Score};
use crate::maze::Cell;

/// How a match ended. Closed: every match ends in exactly one of these.
///
/// A file that is not admitted plays no match, and a match that the host could not play
/// has no verdict.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Verdict {
    /// The speed run ended in the goal.
    Finished {
        /// What the match is worth.
        score: Score,
    },
    /// The step budget is used up.
    BudgetUsedUp {
        /// Whether a step of the exploration run ended in the goal.
        goal_reached: bool,
    },
    /// The robot failed.
    Fault {
        /// How, and where in the match.
        fault: Fault,
    },
}

impl Verdict {
    /// The score; `None` unless the match was finished.
    pub const fn score(&self) -> Option<Score> {
        match self {
            Self::Finished { score } => Some(*score),
            Self::BudgetUsedUp { .. } | Self::Fault { .. } => None,
        }
    }

    /// The fault; `None` unless there is one.
    pub const fn fault(&self) -> Option<&Fault> {
        match self {
            Self::Fault { fault } => Some(fault),
            Self::Finished { .. } | Self::BudgetUsedUp { .. } => None,
        }
    }

    /// The verdict in a few words for people.
    pub fn title(&self) -> Cow<'static, str> {
        match self {
            Self::Finished { .. } => "finished".into(),
            Self::BudgetUsedUp { goal_reached: true } => "budget used up, goal reached".into(),
            Self::BudgetUsedUp {
                goal_reached: false,
            } => "budget used up".into(),
            Self::Fault { fault } => format!("fault: {}", fault.kind.name()).into(),
        }
    }
}

/// What the robot was doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Phase {
    /// Core start functions and data segments.
    Instantiate,
    /// The call of `start`.
    Start,
    /// A call of `next-move`.
    NextMove,
    /// Not known: the process that ran the robot crashed.
    Unknown,
}

impl Phase {
    /// All phases. The position of a phase is its code in transcripts, so the order is
    /// never changed.
    pub const ALL: [Self; 4] = [
        Self::Instantiate,
        Self::Start,
        Self::NextMove,
        Self::Unknown,
    ];
}

/// Which of the fuel limits ran out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FuelLimit {
    /// The limit on instantiation, or on the call of `start`.
    Start,
    /// The limit on one step.
    Step,
    /// The limit on the whole match.
    Match,
}

/// The closed set of faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "&'static str", try_from = "String")]
pub enum FaultKind {
    /// The robot computed for too long.
    OutOfFuel(FuelLimit),
    /// The robot asked for more memory than the match allows.
    OutOfMemory,
    /// The robot asked for more table elements than the match allows.
    TableLimit,
    /// The robot recursed too deeply.
    StackOverflow,
    /// The robot reported an error from which it could not recover: a panic, an abort, an
    /// uncaught exception.
    Panic,
    /// The robot executed `unreachable` without saying why.
    Unreachable,
    /// The robot divided an integer by zero.
    DivisionByZero,
    /// An integer operation overflowed, or a float did not fit an integer.
    IntegerOverflow,
    /// The robot read or wrote outside its memory.
    OutOfBounds,
    /// An indirect call had no target or one of another type.
    BadIndirectCall,
    /// The robot broke the interface: a turn or action that does not exist, a pointer
    /// outside memory or misaligned, text that is not UTF-8, a call into the host at a time
    /// when none is allowed.
    InvalidAction,
    /// The robot crashed the process that it ran in, and did so again alone in a fresh one.
    /// Only a flaw of wasmtime lets a robot do that.
    Crash,
}

impl FaultKind {
    /// All kinds. The position of a kind is its code in transcripts, so new kinds go to the
    /// end.
    pub const ALL: [Self; 14] = [
        Self::OutOfFuel(FuelLimit::Start),
        Self::OutOfFuel(FuelLimit::Step),
        Self::OutOfFuel(FuelLimit::Match),
        Self::OutOfMemory,
        Self::TableLimit,
        Self::StackOverflow,
        Self::Panic,
        Self::Unreachable,
        Self::DivisionByZero,
        Self::IntegerOverflow,
        Self::OutOfBounds,
        Self::BadIndirectCall,
        Self::InvalidAction,
        Self::Crash,
    ];

    /// A short name as in JSON: lowercase letters and hyphens.
    pub const fn name(self) -> &'static str {
        match self {
            Self::OutOfFuel(FuelLimit::Start) => "out-of-start-fuel",
            Self::OutOfFuel(FuelLimit::Step) => "out-of-step-fuel",
            Self::OutOfFuel(FuelLimit::Match) => "out-of-match-fuel",
            Self::OutOfMemory => "out-of-memory",
            Self::TableLimit => "table-limit",
            Self::StackOverflow => "stack-overflow",
            Self::Panic => "panic",
            Self::Unreachable => "unreachable",
            Self::DivisionByZero => "division-by-zero",
            Self::IntegerOverflow => "integer-overflow",
            Self::OutOfBounds => "out-of-bounds",
            Self::BadIndirectCall => "bad-indirect-call",
            Self::InvalidAction => "invalid-action",
            Self::Crash => "crash",
        }
    }
}

impl From<FaultKind> for &'static str {
    fn from(kind: FaultKind) -> Self {
        kind.name()
    }
}

impl TryFrom<String> for FaultKind {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        let mut kinds = Self::ALL.into_iter();
        kinds
            .find(|kind| kind.name() == name)
            .ok_or_else(|| format!("unknown kind of fault `{}`", name.escape_debug()))
    }
}

/// A robot's failure: what, where in the match, and a reason to read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// What happened.
    pub kind: FaultKind,
    /// What the robot was doing.
    pub phase: Phase,
    /// The run in progress.
    pub run: Run,
    /// The number of the step in progress, counted from 1 over both runs; 0 before the
    /// first.
    pub step: u32,
    /// Where the robot was.
    pub cell: Cell,
    /// What exactly, for the contestant. It may quote text and numbers that the robot
    /// chose, so whoever shows it escapes it.
    pub detail: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (run, step, cell) = (self.run.name(), self.step, self.cell);
        match self.phase {
            Phase::Instantiate => write!(f, "{} during instantiation", self.detail),
            Phase::Unknown => f.write_str(&self.detail),
            Phase::Start => write!(f, "{} in `start`", self.detail),
            Phase::NextMove => write!(f, "{} in step {step} ({run}, at {cell})", self.detail),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_fault_has_a_name_of_its_own() {
        for kind in FaultKind::ALL {
            assert_eq!(FaultKind::try_from(kind.name().to_owned()), Ok(kind));
        }
        FaultKind::try_from("nonsense\u{1b}".to_owned()).expect_err("no such kind");
    }
}
