//! [`Supervisor`]: the trusted side, which admits untrusted robots and has them play without
//! compiling, loading or running anything of theirs itself.

use std::io::{self, Write as _};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Duration;

use serde::de::DeserializeOwned;
use wasmouse_core::game::{Fault, Ruleset};
use wasmouse_core::record::{FuelUse, MatchRecord, MatchSpec};
use wasmtime::Engine;

use super::super::protocol::{Backtrace, BacktraceOrder, Profiled};
use super::super::role::{COMPILE_CPU_SECONDS, Role, SandboxStatus};
use super::admit::Admitter;
#[cfg(not(windows))]
use super::group::Groups;
#[cfg(windows)]
use super::job::Groups;
use super::monitor::{Limit, Monitor};
use super::play::Sink;
use super::pool::Pool;
use super::process::{Process, Starter, WorkerOptions};
use super::robot::SandboxedRobot;
use crate::admission::{Inspection, Rejection};
use crate::error::InfrastructureError;
use crate::limits::Limits;
use crate::profile::{Expected, Profile};
use crate::runner::Recording;
use crate::runtime::{Cache, FRAMES_MAX, Frame, new_compiler};

/// How long a backtrace may take on the wall clock.
const BACKTRACE_TIME_MAX: Duration = Duration::from_secs(2 * COMPILE_CPU_SECONDS);

/// Starts workers, gives them files and matches, and checks what they report. One supervisor
/// serves any number of threads; each of them uses a worker of its own.
pub struct Supervisor {
    pool: Pool,
    cache: Option<Cache>,
    /// Names what compiled code is for; compiles nothing.
    engine: Engine,
    sandbox: SandboxStatus,
}

impl Supervisor {
    /// A supervisor for matches by these rules, with compiled robots kept in `cache`. Starts
    /// the first worker, to see which layers of the sandbox there are. Where this process is alone
    /// in a control group that it may arrange, it moves into a group below that, and its workers
    /// into others.
    ///
    /// # Errors
    ///
    /// When the machine gives no process, the program is another build of wasmouse, or a
    /// complete sandbox is required and the operating system cannot provide it.
    pub fn new(
        rules: Arc<Ruleset>,
        limits: Limits,
        workers: WorkerOptions,
        cache: Option<Cache>,
    ) -> Result<Self, InfrastructureError> {
        let engine = new_compiler(&limits)?;
        let starter = Starter {
            monitor: Monitor::start(workers.control.cancel.clone())
                .map_err(InfrastructureError::Thread)?,
            workers,
            groups: Groups::find(),
        };
        let pool = Pool::new(starter, rules, limits);
        let first = pool.start()?;
        let sandbox = first.sandbox;
        pool.put(first);
        Ok(Self {
            pool,
            cache,
            engine,
            sandbox,
        })
    }

    /// Which layers of the sandbox the workers have.
    pub const fn sandbox(&self) -> SandboxStatus {
        self.sandbox
    }

    /// Admits a file as a robot.
    ///
    /// # Errors
    ///
    /// When the host fails; the inner error is the reason why the file is rejected.
    pub fn admit(
        &self,
        bytes: &[u8],
    ) -> Result<Result<SandboxedRobot, Rejection>, InfrastructureError> {
        self.admitter().admit(bytes)
    }

    /// Examines a file as [`Supervisor::admit`] does, and reports everything.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn inspect(&self, bytes: &[u8]) -> Result<Inspection, InfrastructureError> {
        self.admitter().inspect(bytes)
    }

    /// Plays matches of a robot and passes on their records in order, until the sink breaks.
    pub fn play(
        &self,
        robot: &SandboxedRobot,
        specs: &[MatchSpec],
        recording: &mut Recording,
        sink: &mut Sink<'_>,
    ) -> ControlFlow<()> {
        self.pool.play(robot, specs, recording, sink)
    }

    /// Plays one match and leaves its journal and its fuel by step in `recording`.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn play_with_details(
        &self,
        robot: &SandboxedRobot,
        spec: &MatchSpec,
        recording: &mut Recording,
    ) -> Result<MatchRecord, InfrastructureError> {
        self.pool.play_with_details(robot, spec, recording)
    }

    /// The calls in progress when a robot fails in that match, most recent first; `None` when
    /// it does not fail so again or that cannot be found out. `file` is what was admitted.
    ///
    /// # Errors
    ///
    /// When the machine gives no process, or the worker takes too long or fails.
    pub fn backtrace(
        &self,
        file: &[u8],
        spec: &MatchSpec,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, InfrastructureError> {
        Ok(match self.play_apart(file, spec, None)? {
            Backtrace {
                fault: Some((kind, frames)),
            } if kind == fault.kind => {
                let frames = frames.into_iter().take(FRAMES_MAX);
                Some(frames.map(Frame::checked).collect())
            }
            _ => None,
        })
    }

    /// The fuel of that match by function; the inner error says why there is no profile. `file` is
    /// what was admitted, `fuel` what the match is known to use.
    ///
    /// # Errors
    ///
    /// As [`Supervisor::backtrace`].
    pub(crate) fn profile(
        &self,
        file: &[u8],
        spec: &MatchSpec,
        expected: &Expected,
        fuel: FuelUse,
    ) -> Result<Result<Profile, String>, InfrastructureError> {
        let Profiled { profile } = self.play_apart(file, spec, Some(expected.clone()))?;
        let fuel = fuel.start.saturating_add(fuel.steps);
        Ok(profile.and_then(|it| {
            let checked = it.checked(fuel);
            checked.ok_or_else(|| "the worker reported a profile that cannot be true".to_owned())
        }))
    }

    /// Has a backtrace worker play a match, and returns its answer.
    fn play_apart<T: DeserializeOwned>(
        &self,
        file: &[u8],
        spec: &MatchSpec,
        profile: Option<Expected>,
    ) -> Result<T, InfrastructureError> {
        let mut process = Process::start(&self.pool.starter, Role::Backtrace)?;
        let order = BacktraceOrder {
            rules: Ruleset::clone(&spec.rules),
            limits: self.pool.limits,
            maze: spec.maze.identity_bytes(),
            seed: spec.key.seed,
            variant: spec.key.variant,
            profile,
            length: u64::try_from(file.len()).unwrap_or(u64::MAX),
        };
        let answer = process.exchange(Limit::wall(BACKTRACE_TIME_MAX), |talk| {
            talk.send(&order)?;
            talk.writer().write_all(file)?;
            talk.flush()?;
            let sandbox = talk.greet()?;
            self.pool.starter.check(sandbox).map_err(io::Error::other)?;
            talk.receive::<T>()
        });
        // Both are optional: whatever goes wrong here, the verdict stands.
        answer.map_err(|error| InfrastructureError::Worker {
            role: Role::Backtrace.name(),
            reason: process.reap(&error).to_string(),
        })
    }

    const fn admitter(&self) -> Admitter<'_> {
        Admitter {
            pool: &self.pool,
            cache: self.cache.as_ref(),
            engine: &self.engine,
        }
    }
}
