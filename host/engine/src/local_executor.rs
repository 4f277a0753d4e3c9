//! [`LocalExecutor`]: plays on this machine, and chooses by trust in which kind of process.

use std::ops::ControlFlow;
use std::sync::{Arc, OnceLock};

use wasmouse_core::game::{Fault, Ruleset};
use wasmouse_core::record::MatchSpec;

use crate::admission::{Inspection, Rejection};
use crate::error::InfrastructureError;
use crate::executor::{AdmittedRobot, DetailedMatch, Executor, Handle, InProcess, Sandboxed, Sink};
use crate::limits::Limits;
use crate::profile::Profile;
use crate::runtime::{Cache, Frame};
use crate::sandbox::{SandboxStatus, WorkerOptions};
use crate::time::Control;

/// Whose code a robot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// It may run in this process: a bundled robot.
    Trusted,
    /// It may be anything, and runs in sandboxed workers.
    Untrusted,
}

/// Where robots run that are not trusted.
#[derive(Clone, Debug)]
pub enum Isolation {
    /// In this process, like all others.
    None,
    /// In sandboxed processes.
    Workers(WorkerOptions),
}

/// Runs untrusted robots in workers, and trusted ones too unless one match is played at a time;
/// starts either executor when the first robot needs it.
///
/// Threads that run robots in one process share its address space. A robot that grows its memory
/// changes page protections twice in each match, for which the kernel takes a lock on the whole
/// address space and interrupts the other cores: two threads are then hardly faster than one.
/// Processes do not have this problem.
pub struct LocalExecutor {
    rules: Arc<Ruleset>,
    limits: Limits,
    matches: u32,
    cache: Option<Cache>,
    isolation: Isolation,
    control: Control,
    in_process: OnceLock<InProcess>,
    sandboxed: OnceLock<Sandboxed>,
}

impl LocalExecutor {
    /// An executor for up to `matches` matches at the same time (at least 1), with compiled
    /// robots kept in `cache`.
    pub fn new(
        rules: Arc<Ruleset>,
        matches: u32,
        cache: Option<Cache>,
        isolation: Isolation,
    ) -> Self {
        Self {
            limits: Limits::with_sandbox(rules.sandbox),
            rules,
            matches,
            cache,
            isolation,
            control: Control::default(),
            in_process: OnceLock::new(),
            sandboxed: OnceLock::new(),
        }
    }

    /// The executor with something else that ends matches of this process; workers have it in
    /// their options.
    #[must_use]
    pub fn with_control(mut self, control: Control) -> Self {
        self.control = control;
        self
    }

    /// The rules of all matches.
    pub const fn rules(&self) -> &Arc<Ruleset> {
        &self.rules
    }

    /// The limits that robots are admitted and run under.
    pub const fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Which layers of the sandbox the workers have; `None` while there are no workers.
    pub fn sandbox(&self) -> Option<SandboxStatus> {
        self.sandboxed.get().map(Sandboxed::sandbox)
    }

    /// Admits a file, as [`Executor::admit`], where its trust lets it run.
    ///
    /// # Errors
    ///
    /// When the host fails; the inner error is the reason why the file is rejected.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use wasmouse_core::game::Ruleset;
    /// use wasmouse_engine::admission::Rejection;
    /// use wasmouse_engine::{Isolation, LocalExecutor, Trust};
    ///
    /// let rules = Arc::new(Ruleset::default());
    /// let executor = LocalExecutor::new(rules, 1, None, Isolation::None);
    /// let admission = executor.admit(b"", Trust::Trusted).expect("address space");
    /// assert!(matches!(admission, Err(Rejection::Empty)));
    /// ```
    pub fn admit(
        &self,
        file: &[u8],
        trust: Trust,
    ) -> Result<Result<AdmittedRobot, Rejection>, InfrastructureError> {
        self.for_trust(trust)?.admit(file)
    }

    /// Examines a file, as [`Executor::inspect`], where its trust lets it run.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn inspect(&self, file: &[u8], trust: Trust) -> Result<Inspection, InfrastructureError> {
        self.for_trust(trust)?.inspect(file)
    }

    fn for_trust(&self, trust: Trust) -> Result<&dyn Executor, InfrastructureError> {
        let is_trusted = trust == Trust::Trusted;
        match &self.isolation {
            Isolation::Workers(workers) if !is_trusted || self.matches > 1 => {
                match self.sandboxed(workers) {
                    // Trusted robots run in workers for speed, and need no sandbox.
                    Err(InfrastructureError::IncompleteSandbox { .. }) if is_trusted => {}
                    executor => return executor,
                }
            }
            Isolation::Workers(_) | Isolation::None => {}
        }
        let executor = get_or_try_init(&self.in_process, || {
            let executor = InProcess::new(self.limits, self.matches, self.cache.clone())?;
            Ok(executor.with_control(self.control.clone()))
        })?;
        Ok(executor)
    }

    fn sandboxed(&self, workers: &WorkerOptions) -> Result<&dyn Executor, InfrastructureError> {
        let executor = get_or_try_init(&self.sandboxed, || {
            let (rules, cache) = (Arc::clone(&self.rules), self.cache.clone());
            Sandboxed::new(rules, self.limits, workers.clone(), cache)
        })?;
        Ok(executor)
    }

    /// The executor that admitted a robot.
    fn of(&self, robot: &AdmittedRobot) -> Result<&dyn Executor, InfrastructureError> {
        let executor: Option<&dyn Executor> = match robot.handle {
            Handle::InProcess(_) => self.in_process.get().map(|it| it as _),
            Handle::Sandboxed(_) => self.sandboxed.get().map(|it| it as _),
        };
        executor.ok_or(InfrastructureError::ForeignRobot)
    }
}

impl Executor for LocalExecutor {
    /// Admits a file as an untrusted one.
    fn admit(&self, file: &[u8]) -> Result<Result<AdmittedRobot, Rejection>, InfrastructureError> {
        self.admit(file, Trust::Untrusted)
    }

    /// Examines a file as an untrusted one.
    fn inspect(&self, file: &[u8]) -> Result<Inspection, InfrastructureError> {
        self.inspect(file, Trust::Untrusted)
    }

    fn execute(
        &self,
        robot: &AdmittedRobot,
        batch: &[MatchSpec],
        sink: &mut Sink<'_>,
    ) -> ControlFlow<()> {
        match self.of(robot) {
            Ok(executor) => executor.execute(robot, batch, sink),
            Err(_) => batch
                .iter()
                .try_for_each(|spec| sink(spec, Err(InfrastructureError::ForeignRobot))),
        }
    }

    fn execute_with_details(
        &self,
        robot: &AdmittedRobot,
        spec: &MatchSpec,
    ) -> Result<DetailedMatch, InfrastructureError> {
        self.of(robot)?.execute_with_details(robot, spec)
    }

    fn backtrace(
        &self,
        robot: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, InfrastructureError> {
        self.of(robot)?.backtrace(robot, file, spec, fault)
    }

    fn profile(
        &self,
        robot: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        played: &DetailedMatch,
    ) -> Result<Result<Profile, String>, InfrastructureError> {
        self.of(robot)?.profile(robot, file, spec, played)
    }
}

fn get_or_try_init<T>(
    cell: &OnceLock<T>,
    init: impl FnOnce() -> Result<T, InfrastructureError>,
) -> Result<&T, InfrastructureError> {
    if let Some(value) = cell.get() {
        return Ok(value);
    }
    // Two threads may both get here; one of the two values is dropped again.
    let value = init()?;
    Ok(cell.get_or_init(|| value))
}
