//! [`Fault`]: how a robot's own doing ends a match, as data.
//!
//! The only place that looks into errors of a call by wasmtime. What is not the robot's
//! doing becomes a [`HostError`](super::HostError) and never a verdict.

use serde::{Deserialize, Serialize};
use std::fmt;

use wasmtime::Trap;

use super::guest::Panicked;
use super::limiter::LimitExceeded;
use super::{HostError, Phase};
use crate::maze::Cell;
use crate::sim::Run;

/// Which of the fuel limits ran out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
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
pub enum FaultKind {
    /// The robot computed for too long.
    OutOfFuel(FuelLimit),
    /// The robot asked for more memory than the match allows.
    MemoryLimit,
    /// The robot asked for more table elements than the match allows.
    TableLimit,
    /// The robot recursed too deeply.
    StackOverflow,
    /// The robot reported an error from which it cannot recover (`journal.panic`).
    Panic,
    /// The robot executed `unreachable`: an abort, a failed assertion, a panic in a
    /// language that does not report it.
    Unreachable,
    /// The robot divided an integer by zero.
    DivisionByZero,
    /// An integer operation overflowed, or a float did not fit an integer.
    IntegerOverflow,
    /// The robot read or wrote outside its memory.
    OutOfBounds,
    /// An indirect call had no target or one of another type.
    BadIndirectCall,
    /// The robot broke the interface: a turn or action that does not exist, a
    /// pointer outside memory or misaligned, text that is not UTF-8, a call
    /// into the host at a time when none is allowed.
    Interface,
    /// The robot ended the process that it ran in, and did so again alone in a fresh
    /// one. Only a flaw of wasmtime lets a robot do that.
    Crash,
}

impl FaultKind {
    /// A short name as in JSON: lowercase letters and hyphens.
    pub const fn name(self) -> &'static str {
        match self {
            Self::OutOfFuel(FuelLimit::Start) => "out-of-start-fuel",
            Self::OutOfFuel(FuelLimit::Step) => "out-of-step-fuel",
            Self::OutOfFuel(FuelLimit::Match) => "out-of-match-fuel",
            Self::MemoryLimit => "memory-limit",
            Self::TableLimit => "table-limit",
            Self::StackOverflow => "stack-overflow",
            Self::Panic => "panic",
            Self::Unreachable => "unreachable",
            Self::DivisionByZero => "division-by-zero",
            Self::IntegerOverflow => "integer-overflow",
            Self::OutOfBounds => "out-of-bounds",
            Self::BadIndirectCall => "bad-indirect-call",
            Self::Interface => "interface",
            Self::Crash => "crash",
        }
    }
}

/// A robot's failure: what, where in the match, and a reason to read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What happened.
    pub kind: FaultKind,
    /// What the robot was doing.
    pub phase: Phase,
    /// The run in progress.
    pub run: Run,
    /// The number of the step in progress, counted from 1 over both runs; 0
    /// before the first.
    pub step: u32,
    /// Where the robot was.
    pub cell: Cell,
    /// What exactly, for the contestant. It may quote the robot: the numbers that it
    /// chose and the message with which it panicked. Escape it before printing.
    pub detail: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (run, step, cell) = (self.run.number(), self.step, self.cell);
        match self.phase {
            Phase::Instantiate => write!(f, "{} while it was loaded", self.detail),
            Phase::Unknown => f.write_str(&self.detail),
            Phase::Start => write!(f, "{} in `start`", self.detail),
            Phase::NextMove => write!(f, "{} in step {step} (run {run}, at {cell})", self.detail),
        }
    }
}

/// How wasmtime tells of a call that hands over too much. It calls the allowance fuel,
/// which it is not: robots have other fuel.
const TOO_MUCH_COPIED: &str = "fuel allocated for hostcalls has been exhausted";

/// Sorts an error of a guest call: a fault of the robot, or of the host.
///
/// `fuel` is the limit that the call ran under, with its size; `copied_max` how many
/// bytes one call may hand to the host.
pub(super) fn classify(
    error: &wasmtime::Error,
    fuel: (FuelLimit, u64),
    copied_max: u64,
) -> Result<(FaultKind, String), HostError> {
    if let Some(limit) = error.downcast_ref::<LimitExceeded>() {
        let kind = match limit {
            LimitExceeded::Memory { .. } => FaultKind::MemoryLimit,
            LimitExceeded::Table { .. } => FaultKind::TableLimit,
        };
        return Ok((kind, limit.to_string()));
    }
    if let Some(panicked) = error.downcast_ref::<Panicked>() {
        return Ok((FaultKind::Panic, panicked.to_string()));
    }
    if error.is::<wasmtime::PoolConcurrencyLimitError>() {
        return Err(HostError::call(error));
    }
    let Some(trap) = error.downcast_ref::<Trap>() else {
        // Everything else that a call returns is about lifting what the robot
        // handed over: discriminants, pointers, strings, sizes.
        let told = format!("{error:#}");
        let detail = if told.contains(TOO_MUCH_COPIED) {
            format!("handed the host more than {copied_max} bytes in one call")
        } else {
            format!("broke the interface: {told}")
        };
        return Ok((FaultKind::Interface, detail));
    };
    let (kind, detail) = match trap {
        Trap::OutOfFuel => return Ok(out_of_fuel(fuel)),
        // The safety net of the host: says nothing about the robot.
        Trap::Interrupt => return Err(HostError::Stalled),
        Trap::StackOverflow => (FaultKind::StackOverflow, "overflowed its stack"),
        Trap::UnreachableCodeReached => (
            FaultKind::Unreachable,
            "executed `unreachable` (a panic or an abort)",
        ),
        Trap::IntegerDivisionByZero => (FaultKind::DivisionByZero, "divided by zero"),
        Trap::IntegerOverflow => (FaultKind::IntegerOverflow, "overflowed an integer"),
        Trap::BadConversionToInteger => (
            FaultKind::IntegerOverflow,
            "converted a float that fits no integer",
        ),
        Trap::MemoryOutOfBounds => (FaultKind::OutOfBounds, "accessed memory out of bounds"),
        Trap::TableOutOfBounds => (FaultKind::OutOfBounds, "accessed a table out of bounds"),
        Trap::IndirectCallToNull => (FaultKind::BadIndirectCall, "called a null function"),
        Trap::BadSignature => (
            FaultKind::BadIndirectCall,
            "called a function of another type",
        ),
        _ => return Ok((FaultKind::Interface, format!("broke the interface: {trap}"))),
    };
    Ok((kind, detail.to_owned()))
}

fn out_of_fuel((limit, max): (FuelLimit, u64)) -> (FaultKind, String) {
    let of = match limit {
        FuelLimit::Start => "for the start",
        FuelLimit::Step => "of a step",
        FuelLimit::Match => "of the match",
    };
    let detail = format!("used up the {max} units of fuel {of}");
    (FaultKind::OutOfFuel(limit), detail)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(error: impl Into<wasmtime::Error>) -> Result<(FaultKind, String), HostError> {
        classify(&error.into(), (FuelLimit::Step, 7), 100)
    }

    #[test]
    fn the_safety_net_is_never_a_verdict() {
        assert!(matches!(sorted(Trap::Interrupt), Err(HostError::Stalled)));
    }

    #[test]
    fn traps_and_limits_have_their_own_faults() {
        let memory = LimitExceeded::Memory { asked: 9, max: 8 };
        for (error, kind) in [
            (
                wasmtime::Error::from(Trap::OutOfFuel),
                FaultKind::OutOfFuel(FuelLimit::Step),
            ),
            (Trap::UnreachableCodeReached.into(), FaultKind::Unreachable),
            (Trap::InvalidDiscriminant.into(), FaultKind::Interface),
            (memory.into(), FaultKind::MemoryLimit),
            (
                wasmtime::Error::msg("return pointer not aligned"),
                FaultKind::Interface,
            ),
        ] {
            let (found, detail) = sorted(error).expect("a fault of the robot");
            assert_eq!(found, kind, "{detail}");
        }
    }
}
