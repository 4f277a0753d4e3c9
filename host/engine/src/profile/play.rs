//! [`Profiler`]: plays one match with an instrumented robot.

use std::sync::{Arc, Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use wasmouse_core::game::{Phase, SandboxLimits};
use wasmouse_core::record::{MatchRecord, MatchSpec};
use wasmtime::{StoreContextMut, Trap, UpdateDeadline, WasmBacktrace};

use super::Profile;
use super::instrument::{Function, Mark, NotInstrumented, instrument};
use super::meter::Meter;
use crate::admission::{Rejection, examine};
use crate::error::InfrastructureError;
use crate::limits::Limits;
use crate::runner::Recording;
use crate::runtime::{AdmissionError, Clock, CompiledRobot, Guest, Runtime};
use crate::time::MatchClock;

/// Why there is no profile.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ProfileError {
    /// The match failed before the robot was called.
    #[error("the robot failed before its first call")]
    NeverCalled,
    /// The instrumented robot did not do the same.
    #[error("the robot behaved differently when it was instrumented: {0}")]
    Differs(&'static str),
    /// It cannot be a robot.
    #[error(transparent)]
    Rejected(#[from] Rejection),
    /// It is no valid component, which admission would have found.
    #[error(transparent)]
    NotInstrumented(#[from] NotInstrumented),
    /// The host failed.
    #[error(transparent)]
    Host(#[from] InfrastructureError),
}

impl From<AdmissionError> for ProfileError {
    fn from(error: AdmissionError) -> Self {
        match error {
            AdmissionError::Rejected(rejection) => Self::Rejected(rejection),
            AdmissionError::Host(error) => Self::Host(error),
        }
    }
}

/// The fuel of each call of a match, as it was without a profile, and how it ended.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Expected {
    /// Of `start`, then of each step.
    calls: Vec<u64>,
    /// The fault of the last call, if there was one.
    fault: Option<Phase>,
}

impl Expected {
    /// What a match of that record is expected to do, with the fuel of each step.
    pub(crate) fn new(record: &MatchRecord, step_fuel: &[u64]) -> Self {
        let mut calls = vec![record.fuel.start];
        calls.extend_from_slice(step_fuel);
        let fault = record.verdict.fault().map(|it| it.phase);
        Self { calls, fault }
    }
}

/// Makes profiles.
pub(crate) struct Profiler {
    runtime: Runtime,
    limits: Limits,
}

/// Calls of the host before the first one that is profiled: instantiation.
const CALLS_BEFORE: usize = 1;

/// How many checks the clock is not asked for.
const CHECKS: u32 = 4096;

impl Profiler {
    /// A profiler for robots under these limits.
    ///
    /// # Errors
    ///
    /// When the machine cannot give address space.
    pub(crate) fn new(limits: Limits) -> Result<Self, InfrastructureError> {
        // Wrappers use fuel, too. Which limit a match exceeded is known.
        let mut runtime_limits = limits;
        runtime_limits.sandbox = room(&limits.sandbox);
        Ok(Self {
            runtime: Runtime::for_profiles(runtime_limits)?,
            limits,
        })
    }

    /// A clock that may run, and makes no difference.
    pub(crate) fn clock(&self) -> Clock {
        self.runtime.clock()
    }

    /// The profile of a match of which everything else is known.
    ///
    /// # Errors
    ///
    /// When there is nothing to profile, the instrumented robot does not do the same, or the host
    /// fails.
    pub(crate) fn profile(
        &self,
        file: &[u8],
        spec: &MatchSpec,
        expected: Expected,
        clock: &Arc<MatchClock>,
    ) -> Result<Profile, ProfileError> {
        if matches!(expected.fault, Some(Phase::Instantiate | Phase::Unknown)) {
            return Err(ProfileError::NeverCalled);
        }
        let component = examine(file, &self.limits).component?;
        let instrumented = instrument(&component)?;
        let robot = self.runtime.admit_examined(&instrumented.component)?;
        self.play(&robot, instrumented.functions, spec, expected, clock)
    }

    fn play(
        &self,
        robot: &CompiledRobot,
        functions: Vec<Function>,
        spec: &MatchSpec,
        expected: Expected,
        clock: &Arc<MatchClock>,
    ) -> Result<Profile, ProfileError> {
        let mut rules = (*spec.rules).clone();
        rules.sandbox = room(&rules.sandbox);
        let spec = MatchSpec {
            rules: Arc::new(rules),
            ..spec.clone()
        };
        let parameters = functions.iter().map(|it| it.parameters).collect();
        let watch = Arc::new(Mutex::new(Watch {
            meter: Meter::new(parameters),
            expected,
            sandbox: spec.rules.sandbox,
            calls: 0,
            seen: None,
            is_body: false,
            checks: 0,
        }));
        let mut recording = Recording::default();
        let (shared, clock) = (Arc::clone(&watch), Arc::clone(clock));
        let ran = self
            .runtime
            .run_watched(robot, &spec, &mut recording, move |store| {
                store.set_epoch_deadline(0);
                store.epoch_deadline_callback(move |context| {
                    let mut watch = shared.lock().unwrap_or_else(PoisonError::into_inner);
                    watch.check(context, &clock)?;
                    Ok(UpdateDeadline::Continue(0))
                });
            });
        let (result, _) = ran?;
        let mut watch = watch.lock().unwrap_or_else(PoisonError::into_inner);
        watch.end_call();
        if watch.calls != watch.expected.calls.len() + CALLS_BEFORE {
            return Err(ProfileError::Differs("another number of calls"));
        }
        if result.verdict.fault().is_some() != watch.expected.fault.is_some() {
            return Err(ProfileError::Differs("another verdict"));
        }
        let meter = std::mem::replace(&mut watch.meter, Meter::new(Vec::new()));
        let (nodes, collapsed) = meter.finish().ok_or(ProfileError::Differs("other fuel"))?;
        Ok(Profile::new(&nodes, collapsed, &functions))
    }
}

/// The limits with room for what wrappers cost: a call costs at least 4 units, and its wrapper and
/// parameters hardly more than twice as much.
fn room(limits: &SandboxLimits) -> SandboxLimits {
    let more = |fuel: u64| {
        fuel.saturating_mul(4)
            .saturating_add(1_000_000)
            .min(1 << 60)
    };
    SandboxLimits {
        start_fuel_max: more(limits.start_fuel_max),
        step_fuel_max: more(limits.step_fuel_max),
        match_fuel_max: u64::MAX,
        stack_bytes_max: limits.stack_bytes_max.saturating_mul(2),
        ..*limits
    }
}

/// What looks at a match in progress.
struct Watch {
    meter: Meter,
    expected: Expected,
    /// The limits that the calls run under.
    sandbox: SandboxLimits,
    /// Calls of the host so far.
    calls: usize,
    /// The fuel that was left at the last check of this call.
    seen: Option<u64>,
    /// Whether the next check is that of a body, of which the wrapper has told.
    is_body: bool,
    checks: u32,
}

impl Watch {
    /// A function begins, or a loop begins again.
    fn check(
        &mut self,
        context: StoreContextMut<'_, Guest>,
        clock: &MatchClock,
    ) -> wasmtime::Result<()> {
        self.checks = self.checks.wrapping_add(1);
        if self.checks.is_multiple_of(CHECKS) {
            clock.check().map_err(wasmtime::Error::new)?;
        }
        let calls = context.data().calls;
        if calls != self.calls {
            self.end_call();
            (self.calls, self.seen, self.is_body) = (calls, None, false);
            self.meter.begin();
        }
        if calls <= CALLS_BEFORE {
            return Ok(());
        }
        let left = context.get_fuel()?;
        let is_same = self.seen.replace(left) == Some(left);
        // A counter only changes when a function calls or returns.
        if is_same || std::mem::take(&mut self.is_body) {
            return Ok(());
        }
        let backtrace = WasmBacktrace::force_capture(&context);
        let name = backtrace.frames().first().and_then(|it| it.func_name());
        if let Some(mark) = name.and_then(Mark::of) {
            self.is_body = matches!(mark, Mark::Enter { .. });
            let limit = match calls {
                2 => self.sandbox.start_fuel_max,
                _ => self.sandbox.step_fuel_max,
            };
            self.meter.mark(mark, limit.saturating_sub(left));
        }
        // A stack that overflows does so at another depth, and fuel runs out elsewhere.
        let is_last = calls == self.expected.calls.len() + CALLS_BEFORE;
        if is_last && self.expected.fault.is_some() && self.meter.spent() >= self.fuel() {
            return Err(Trap::OutOfFuel.into());
        }
        Ok(())
    }

    /// The fuel of the call in progress, in the match.
    fn fuel(&self) -> u64 {
        let call = self.calls.checked_sub(CALLS_BEFORE + 1);
        let fuel = call.and_then(|it| self.expected.calls.get(it));
        fuel.copied().unwrap_or(0)
    }

    /// The call in progress has ended.
    fn end_call(&mut self) {
        if self.calls <= CALLS_BEFORE {
            return;
        }
        let fuel = self.fuel();
        let is_last = self.calls == self.expected.calls.len() + CALLS_BEFORE;
        if is_last && self.expected.fault.is_some() {
            self.meter.end_with_fault(fuel);
        } else {
            self.meter.end(fuel);
        }
    }
}
