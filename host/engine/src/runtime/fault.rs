//! [`classify`]: what an error of a guest call means.
//!
//! The only place that looks into errors of a call by wasmtime. What is not the robot's doing
//! becomes an [`InfrastructureError`] and never a verdict.

use wasmouse_core::game::{FaultKind, FuelLimit};
use wasmtime::Trap;

use super::config::MATCH_SECONDS_MAX;
use super::guest::Panicked;
use super::limiter::LimitExceeded;
use crate::error::InfrastructureError;

/// How wasmtime reports a call that hands over too much. It calls the allowance fuel, which
/// it is not: robots have other fuel.
const TOO_MUCH_COPIED: &str = "fuel allocated for hostcalls has been exhausted";

/// Classifies an error of a guest call: a fault of the robot, or of the host.
///
/// # Errors
///
/// When the failure is not the robot's.
///
/// `fuel` is the limit that the call ran under, with its size; `copied_max` how many
/// bytes one call may hand to the host.
pub(crate) fn classify(
    error: &wasmtime::Error,
    fuel: (FuelLimit, u64),
    copied_max: u64,
) -> Result<(FaultKind, String), InfrastructureError> {
    if let Some(limit) = error.downcast_ref::<LimitExceeded>() {
        let kind = match limit {
            LimitExceeded::Memory { .. } => FaultKind::OutOfMemory,
            LimitExceeded::Table { .. } => FaultKind::TableLimit,
        };
        return Ok((kind, limit.to_string()));
    }
    if let Some(panicked) = error.downcast_ref::<Panicked>() {
        return Ok((FaultKind::Panic, panicked.to_string()));
    }
    if error.is::<wasmtime::PoolConcurrencyLimitError>() {
        return Err(InfrastructureError::call(error));
    }
    let Some(trap) = error.downcast_ref::<Trap>() else {
        // Everything else that a call returns is about lifting what the robot
        // handed over: discriminants, pointers, strings, sizes.
        let message = format!("{error:#}");
        let detail = if message.contains(TOO_MUCH_COPIED) {
            format!("passed more than {copied_max} bytes to the host in one call")
        } else {
            format!("violated the interface: {message}")
        };
        return Ok((FaultKind::InvalidAction, detail));
    };
    let (kind, detail) = match trap {
        Trap::OutOfFuel => return Ok(out_of_fuel(fuel)),
        // The safety net of the host: says nothing about the robot.
        Trap::Interrupt => {
            return Err(InfrastructureError::Stalled {
                seconds: MATCH_SECONDS_MAX,
            });
        }
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
        _ => {
            return Ok((
                FaultKind::InvalidAction,
                format!("violated the interface: {trap}"),
            ));
        }
    };
    Ok((kind, detail.to_owned()))
}

fn out_of_fuel((limit, max): (FuelLimit, u64)) -> (FaultKind, String) {
    let of = match limit {
        FuelLimit::Start => "start",
        FuelLimit::Step => "per-step",
        FuelLimit::Match => "match",
    };
    let detail = format!("exceeded the {of} fuel limit ({})", grouped(max));
    (FaultKind::OutOfFuel(limit), detail)
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
    ) -> Result<(FaultKind, String), InfrastructureError> {
        classify(&error.into(), (FuelLimit::Step, 7), 100)
    }

    #[test]
    fn the_safety_net_is_never_a_verdict() {
        assert!(matches!(
            sorted(Trap::Interrupt),
            Err(InfrastructureError::Stalled { .. })
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
                wasmtime::Error::msg("return pointer not aligned"),
                FaultKind::InvalidAction,
            ),
        ] {
            let (found, detail) = sorted(error).expect("a fault of the robot");
            assert_eq!(found, kind, "{detail}");
        }
    }
}
