//! [`classify`]: what an error of a guest call means.
//!
//! The only place that looks into errors of a call by wasmtime. An error is a fault of the robot
//! if it is known to be one; everything else becomes an [`InfrastructureError`] and never a
//! verdict. So an error that a new version of wasmtime adds, or that a host reports which is
//! short of memory or descriptors, cannot be blamed on a robot.

use std::char::DecodeUtf16Error;
use std::str::Utf8Error;

use wasmouse_core::game::{FaultKind, FuelLimit};
use wasmouse_core::{GuestText, guest_text};
use wasmtime::Trap;

use super::guest::Panicked;
use super::limiter::LimitExceeded;
use crate::error::InfrastructureError;

/// How wasmtime reports a call that passes too much. It calls the allowance fuel, which it is
/// not: robots have other fuel.
const TOO_MUCH_COPIED: &str = "too much data is being copied between the host and the guest";

/// How wasmtime's errors start that say that a robot broke the canonical ABI and have no type of
/// their own. `tests/it/violations.rs` has a robot for each.
const VIOLATIONS: [&str; 13] = [
    // Lifting the action.
    "pointer out of bounds of memory",
    "unexpected discriminant: ",
    // Lifting text for the journal.
    "string pointer not aligned to ",
    "string pointer/length out of bounds of memory",
    // Text that one component of a robot passes to another.
    "invalid utf8 encoding",
    "invalid utf16 encoding",
    // Handles of the robot's own resources.
    "unknown handle index ",
    "handle index ",
    "cannot allocate another handle: ",
    "cannot lend resource: ",
    "cannot remove owned resource while borrowed",
    "cannot lift own resource from a borrow",
    "borrow handles still remain at the end of the call",
];

/// Classifies an error of a guest call: a fault of the robot, or of the host.
///
/// # Errors
///
/// When the failure is not known to be the robot's.
///
/// `fuel` is the limit that the call ran under, with its size; `copied_max` how many
/// bytes one call may pass to the host.
pub(crate) fn classify(
    error: &wasmtime::Error,
    fuel: (FuelLimit, u64),
    copied_max: u64,
) -> Result<(FaultKind, GuestText), InfrastructureError> {
    if let Some(limit) = error.downcast_ref::<LimitExceeded>() {
        return Ok((limit.fault(), limit.to_string().into()));
    }
    if let Some(panicked) = error.downcast_ref::<Panicked>() {
        return Ok((FaultKind::Panic, guest_text!("panicked: {}", panicked.0)));
    }
    let fault = match error.downcast_ref::<Trap>() {
        Some(Trap::OutOfFuel) => return Ok(out_of_fuel(fuel)),
        // The safety net of the host: says nothing about the robot.
        Some(Trap::Interrupt) => return Err(InfrastructureError::call(error)),
        Some(trap) => fault_of_trap(*trap),
        None => violation(error, copied_max),
    };
    fault.ok_or_else(|| InfrastructureError::call(error))
}

/// What a trap says about the robot; `None` for traps of features that robots do not have, and
/// for wasmtime's assertions about itself.
fn fault_of_trap(trap: Trap) -> Option<(FaultKind, GuestText)> {
    let (kind, detail) = match trap {
        Trap::StackOverflow => (FaultKind::StackOverflow, "overflowed its stack"),
        Trap::UnreachableCodeReached => (
            FaultKind::Unreachable,
            "executed `unreachable` (panicked or aborted)",
        ),
        Trap::IntegerDivisionByZero => (FaultKind::DivisionByZero, "divided by zero"),
        Trap::IntegerOverflow => (FaultKind::IntegerOverflow, "overflowed an integer"),
        Trap::BadConversionToInteger => (
            FaultKind::IntegerOverflow,
            "converted a float that does not fit an integer",
        ),
        Trap::MemoryOutOfBounds => (FaultKind::OutOfBounds, "accessed memory out of bounds"),
        Trap::TableOutOfBounds => (FaultKind::OutOfBounds, "accessed a table out of bounds"),
        Trap::IndirectCallToNull => (FaultKind::BadIndirectCall, "called a null function"),
        Trap::BadSignature => (
            FaultKind::BadIndirectCall,
            "called a function of the wrong type",
        ),
        Trap::CannotEnterComponent
        | Trap::CannotLeaveComponent
        | Trap::InvalidChar
        | Trap::InvalidDiscriminant
        | Trap::ListOutOfBounds
        | Trap::StringOutOfBounds
        | Trap::UnalignedPointer => return Some(violated(&trap)),
        _ => return None,
    };
    Some((kind, detail.into()))
}

/// The violation of the canonical ABI that an error reports, if it is one.
fn violation(error: &wasmtime::Error, copied_max: u64) -> Option<(FaultKind, GuestText)> {
    // The cause itself: an engine for backtraces adds context to errors.
    let message = error.root_cause().to_string();
    if message.starts_with(TOO_MUCH_COPIED) {
        let detail = format!("passed more than {copied_max} bytes to the host in one call");
        return Some((FaultKind::InvalidAction, detail.into()));
    }
    let is_text = error.is::<Utf8Error>() || error.is::<DecodeUtf16Error>();
    let is_known = is_text || VIOLATIONS.iter().any(|it| message.starts_with(it));
    is_known.then(|| violated(&message))
}

fn violated(what: &dyn std::fmt::Display) -> (FaultKind, GuestText) {
    let detail = guest_text!("violated the interface: {}", what);
    (FaultKind::InvalidAction, detail)
}

/// The fault of a robot that needs more fuel than that limit, which has that size.
pub(crate) fn out_of_fuel((limit, max): (FuelLimit, u64)) -> (FaultKind, GuestText) {
    let of = match limit {
        FuelLimit::Start => "start",
        FuelLimit::Step => "per-step",
        FuelLimit::Match => "match",
    };
    let detail = format!("exceeded the {of} fuel limit ({})", grouped(max));
    (FaultKind::OutOfFuel(limit), detail.into())
}

/// The number with its digits in groups of three: `2,000,000,000`.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let first = digits.len() % 3;
    let mut grouped = String::with_capacity(digits.len() + digits.len() / 3);
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && place % 3 == first {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(
        error: impl Into<wasmtime::Error>,
    ) -> Result<(FaultKind, GuestText), InfrastructureError> {
        classify(&error.into(), (FuelLimit::Step, 7), 100)
    }

    #[test]
    fn the_safety_net_is_never_a_verdict() {
        assert!(matches!(
            sorted(Trap::Interrupt),
            Err(InfrastructureError::Call(_))
        ));
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
            (Trap::InvalidDiscriminant.into(), FaultKind::InvalidAction),
            (memory.into(), FaultKind::OutOfMemory),
            (
                wasmtime::Error::msg("pointer out of bounds of memory"),
                FaultKind::InvalidAction,
            ),
        ] {
            let (found, detail) = sorted(error).expect("a fault of the robot");
            assert_eq!(found, kind, "{detail:?}");
        }
    }

    /// What wasmtime returns when the host is short of something, and what nobody has seen yet.
    #[test]
    fn what_is_not_known_to_be_the_robots_is_the_hosts() {
        let system = |kind| wasmtime::Error::from(std::io::Error::from(kind));
        for error in [
            system(std::io::ErrorKind::OutOfMemory),
            system(std::io::ErrorKind::QuotaExceeded).context("cannot create a memfd"),
            wasmtime::Error::msg("cannot create a memfd"),
            wasmtime::Error::msg("mmap failed to allocate 0x10000 bytes"),
            wasmtime::Error::msg("resource limit exceeded: instance count too high at 65"),
            wasmtime::Error::msg("an error of the next version: unknown handle index 1"),
            Trap::DebugAssertPointerAligned.into(),
            Trap::AsyncDeadlock.into(),
        ] {
            let sorted = sorted(error);
            assert!(
                matches!(sorted, Err(InfrastructureError::Call(_))),
                "{sorted:?}"
            );
        }
    }
}
