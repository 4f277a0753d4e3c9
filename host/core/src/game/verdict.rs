//! [`Verdict`]: how a match ended. [`Fault`]: how a robot failed.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::{Run, Score};
use crate::guest_text;
use crate::guest_text::GuestText;
use crate::maze::Cell;

/// How a match ended. The set is closed: every match has exactly one verdict.
///
/// Neither a rejected file nor an infrastructure error is a verdict.
///
/// Serialises with a tag: `{"kind": "finished", "score": ...}`, `{"kind": "budget-used-up",
/// "goal_reached": true}` or `{"kind": "fault", "fault": ...}`.
///
/// ```
/// use wasmouse_core::game::Verdict;
/// let json = r#"{"kind":"budget-used-up","goal_reached":true}"#;
/// let verdict: Verdict = serde_json::from_str(json)?;
/// assert_eq!(verdict, Verdict::BudgetUsedUp { goal_reached: true });
/// assert_eq!(verdict.title(), "budget used up, goal reached");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Verdict {
    /// The speed run ended in the goal.
    Finished {
        /// The score.
        score: Score,
    },
    /// The step budget is used up.
    BudgetUsedUp {
        /// Whether a step of the exploration run ended in the goal.
        goal_reached: bool,
    },
    /// The robot failed.
    Fault {
        /// What happened, and where in the match.
        fault: Fault,
    },
}

impl Verdict {
    /// The score; `None` unless finished.
    pub const fn score(&self) -> Option<Score> {
        match self {
            Self::Finished { score } => Some(*score),
            Self::BudgetUsedUp { .. } | Self::Fault { .. } => None,
        }
    }

    /// The fault, if there is one.
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

/// The part of a match in which a robot failed. Serialises in kebab case, such as
/// `"next-move"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Phase {
    /// Instantiation: start functions and data segments.
    Instantiate,
    /// The call of `start`.
    Start,
    /// A call of `next-move`.
    NextMove,
    /// Unknown, because the process that ran the robot crashed.
    Unknown,
}

impl Phase {
    /// All phases. The index of a phase is its code in transcripts, so the order never changes.
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

/// The kinds of faults, a closed set. Serialises as its [name](FaultKind::name).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "&'static str", try_from = "String")]
pub enum FaultKind {
    /// The robot exceeded a fuel limit.
    OutOfFuel(FuelLimit),
    /// The robot exceeded the memory limit.
    OutOfMemory,
    /// The robot exceeded the limit on table elements.
    TableLimit,
    /// The robot exceeded the limit on its call stack.
    StackOverflow,
    /// The robot reported an error from which it could not recover: a panic, an abort, an
    /// uncaught exception.
    Panic,
    /// The robot executed `unreachable` without an error message.
    Unreachable,
    /// The robot divided an integer by zero.
    DivisionByZero,
    /// An integer operation overflowed, or a float did not fit an integer.
    IntegerOverflow,
    /// The robot accessed memory or a table out of bounds.
    OutOfBounds,
    /// An indirect call had no target, or a target of another type.
    BadIndirectCall,
    /// The robot violated the interface: an unknown turn or action, a pointer that is out of
    /// bounds or misaligned, text that is not UTF-8, or a call into the host when none is
    /// allowed.
    InvalidAction,
    /// The robot crashed its process, and did so again alone in a new process. Only a bug in
    /// wasmtime makes that possible.
    Crash,
}

impl FaultKind {
    /// All kinds. The index of a kind is its code in transcripts, so new kinds are appended.
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

    /// The name in JSON, in lowercase letters and hyphens, such as `out-of-step-fuel`.
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
            .ok_or_else(|| format!("unknown fault kind `{}`", name.escape_debug()))
    }
}

/// A robot's failure: what happened, where in the match, and a message.
///
/// Serialises as an object with these fields.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// What happened.
    pub kind: FaultKind,
    /// The part of the match.
    pub phase: Phase,
    /// The run in progress.
    pub run: Run,
    /// The number of the step in progress, counted from 1 over both runs; 0 before the first
    /// step.
    pub step: u32,
    /// The robot's cell.
    pub cell: Cell,
    /// A message for the contestant. It may quote text of the robot.
    pub detail: GuestText,
}

impl Fault {
    /// The message, with where in the match it happened.
    pub fn describe(&self) -> GuestText {
        let (run, step, cell) = (self.run.name(), self.step, self.cell);
        match self.phase {
            Phase::Instantiate => guest_text!("{} during instantiation", self.detail),
            Phase::Unknown => self.detail.clone(),
            Phase::Start => guest_text!("{} in `start`", self.detail),
            Phase::NextMove => {
                guest_text!("{} in step {} ({}, at {})", self.detail, step, run, cell)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_kind_has_its_own_name() {
        for kind in FaultKind::ALL {
            assert_eq!(FaultKind::try_from(kind.name().to_owned()), Ok(kind));
        }
        let error = FaultKind::try_from("a\u{1b}".to_owned()).expect_err("no such kind");
        assert_eq!(error, "unknown fault kind `a\\u{1b}`");
    }
}
