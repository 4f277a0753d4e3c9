//! [`Executor`]: one way to admit robots and play matches, wherever they run.
//!
//! [`InProcess`] runs robots in this process, [`Sandboxed`] in worker processes. Records are the
//! same bytes either way.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use wasmouse_core::Digest;
use wasmouse_core::game::{Fault, Ruleset};
use wasmouse_core::record::{MatchRecord, MatchSpec, Transcript};

use crate::admission::{Inspection, Rejection, examine, world};
use crate::error::InfrastructureError;
use crate::limits::{Limits, STACK_BYTES};
use crate::profile::{Expected, Profile, ProfileError, Profiler};
use crate::runner::Recording;
use crate::runtime::{AdmissionError, Cache, CacheUse, CompiledRobot, Frame, Runtime};
use crate::sandbox::{SandboxStatus, SandboxedRobot, Supervisor, WorkerOptions};
use crate::time::{Account, Control, MatchClock};

/// A match that was played.
#[derive(Debug)]
pub struct Played<'a> {
    /// What came of it.
    pub record: MatchRecord,
    /// The robot's actions.
    pub transcript: &'a Transcript,
}

/// Gets what came of each match of a batch, in order, and says whether to go on. A match that
/// the host could not play says nothing about the robot, and has to be played another time.
pub type Sink<'a> =
    dyn FnMut(&MatchSpec, Result<Played<'_>, InfrastructureError>) -> ControlFlow<()> + 'a;

/// A match with everything that the robot left behind.
#[derive(Debug)]
pub struct DetailedMatch {
    /// What came of it.
    pub record: MatchRecord,
    /// The robot's actions, its journal, and the fuel of each step.
    pub recording: Recording,
}

/// Admits robots and plays matches.
pub trait Executor: Sync {
    /// Admits the bytes of a component, or of a core module that can be turned into one, as a
    /// robot.
    ///
    /// # Errors
    ///
    /// When the host fails; the inner error is the reason why the file is rejected.
    fn admit(&self, file: &[u8]) -> Result<Result<AdmittedRobot, Rejection>, InfrastructureError>;

    /// Examines a file as [`Executor::admit`] does, and reports everything.
    ///
    /// # Errors
    ///
    /// When the host fails.
    fn inspect(&self, file: &[u8]) -> Result<Inspection, InfrastructureError>;

    /// Plays matches of one robot, in order, and passes each to the sink as it ends. Stops
    /// when the sink breaks, and when everything is cancelled. A match that does not end in time
    /// is not played again: that is left to the caller.
    fn execute(
        &self,
        robot: &AdmittedRobot,
        batch: &[MatchSpec],
        sink: &mut Sink<'_>,
    ) -> ControlFlow<()>;

    /// Plays one match and keeps the robot's journal and the fuel of each step.
    ///
    /// # Errors
    ///
    /// When the host fails.
    fn execute_with_details(
        &self,
        robot: &AdmittedRobot,
        spec: &MatchSpec,
    ) -> Result<DetailedMatch, InfrastructureError>;

    /// The calls in progress when a robot fails in that match, most recent first; `None` when
    /// that cannot be found out. `file` is what was admitted.
    ///
    /// # Errors
    ///
    /// When the host fails.
    fn backtrace(
        &self,
        robot: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, InfrastructureError>;

    /// The fuel of a match by function; the inner error says why there is no profile. `file` is what
    /// was admitted, and `played` the match without a profile, whose fuel the profile has.
    ///
    /// # Errors
    ///
    /// When the host fails.
    fn profile(
        &self,
        robot: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        played: &DetailedMatch,
    ) -> Result<Result<Profile, String>, InfrastructureError>;
}

/// A robot that an executor has admitted, and that only this executor can play.
pub struct AdmittedRobot {
    pub(crate) handle: Handle,
    account: Arc<Account>,
}

pub(crate) enum Handle {
    InProcess(Box<CompiledRobot>),
    Sandboxed(SandboxedRobot),
}

impl AdmittedRobot {
    /// The digest of the file that was admitted.
    pub const fn digest(&self) -> &Digest {
        match &self.handle {
            Handle::InProcess(robot) => robot.digest(),
            Handle::Sandboxed(robot) => robot.digest(),
        }
    }

    /// The processor time that its matches have used, in all variants.
    pub const fn account(&self) -> &Arc<Account> {
        &self.account
    }

    /// Where its compiled code came from.
    pub const fn cache_use(&self) -> &CacheUse {
        match &self.handle {
            Handle::InProcess(robot) => robot.cache_use(),
            Handle::Sandboxed(robot) => robot.cache_use(),
        }
    }

    fn in_process(&self) -> Result<&CompiledRobot, InfrastructureError> {
        match &self.handle {
            Handle::InProcess(robot) => Ok(robot),
            Handle::Sandboxed(_) => Err(InfrastructureError::ForeignRobot),
        }
    }

    const fn sandboxed(&self) -> Result<&SandboxedRobot, InfrastructureError> {
        match &self.handle {
            Handle::Sandboxed(robot) => Ok(robot),
            Handle::InProcess(_) => Err(InfrastructureError::ForeignRobot),
        }
    }
}

/// Runs robots in this process: for robots that are trusted.
pub struct InProcess {
    runtime: Runtime,
    control: Control,
}

impl InProcess {
    /// An executor for up to `matches` matches at the same time (at least 1), with compiled
    /// robots kept in `cache`.
    ///
    /// # Errors
    ///
    /// When the machine cannot give address space or threads.
    pub fn new(
        limits: Limits,
        matches: u32,
        cache: Option<Cache>,
    ) -> Result<Self, InfrastructureError> {
        let runtime = Runtime::new(limits, matches, cache)?;
        let control = Control::default();
        Ok(Self { runtime, control })
    }

    /// The executor with something else that ends its matches.
    #[must_use]
    pub fn with_control(mut self, control: Control) -> Self {
        self.control = control;
        self
    }

    fn play(
        &self,
        robot: &AdmittedRobot,
        spec: &MatchSpec,
        recording: &mut Recording,
    ) -> Result<MatchRecord, InfrastructureError> {
        let (compiled, account) = (robot.in_process()?, &robot.account);
        account.check()?;
        let clock = MatchClock::start(self.control.clone(), Some(Arc::clone(account)));
        let ran = self.runtime.run_within(compiled, spec, recording, &clock);
        clock.charge();
        match &ran {
            Ok(_) => account.count_match(),
            Err(error) if error.is_stall() => account.count_stall(),
            Err(_) => {}
        }
        let (result, usage) = ran?;
        Ok(MatchRecord::new(
            spec.key,
            result,
            usage,
            &recording.transcript,
        ))
    }
}

impl Executor for InProcess {
    fn admit(&self, file: &[u8]) -> Result<Result<AdmittedRobot, Rejection>, InfrastructureError> {
        match self.runtime.admit(file) {
            Ok(robot) => Ok(Ok(AdmittedRobot {
                handle: Handle::InProcess(Box::new(robot)),
                account: Arc::default(),
            })),
            Err(AdmissionError::Rejected(rejection)) => Ok(Err(rejection)),
            Err(AdmissionError::Host(error)) => Err(error),
        }
    }

    fn inspect(&self, file: &[u8]) -> Result<Inspection, InfrastructureError> {
        let examination = examine(file, self.runtime.limits());
        let mut inspection = Inspection::new(file);
        inspection.kind = examination.kind;
        inspection.shape = examination.shape;
        let admitted = match examination.component {
            Ok(component) => {
                inspection.wit = world(&component);
                self.runtime.admit(file)
            }
            Err(rejection) => Err(rejection.into()),
        };
        match admitted {
            Ok(robot) => inspection.requirements = robot.requirements(),
            Err(AdmissionError::Rejected(rejection)) => inspection.rejection = Some(rejection),
            Err(AdmissionError::Host(error)) => return Err(error),
        }
        Ok(inspection)
    }

    fn execute(
        &self,
        robot: &AdmittedRobot,
        batch: &[MatchSpec],
        sink: &mut Sink<'_>,
    ) -> ControlFlow<()> {
        let mut recording = Recording::default();
        batch.iter().try_for_each(|spec| {
            let mut play = || self.play(robot, spec, &mut recording);
            let played = match play() {
                Err(InfrastructureError::Cancelled) => return ControlFlow::Break(()),
                // A failure of the host may be a passing one.
                Err(error) if !error.is_final() => play(),
                played => played,
            };
            let transcript = &recording.transcript;
            sink(spec, played.map(|record| Played { record, transcript }))
        })
    }

    fn execute_with_details(
        &self,
        robot: &AdmittedRobot,
        spec: &MatchSpec,
    ) -> Result<DetailedMatch, InfrastructureError> {
        let mut recording = Recording::default();
        let record = self.play(robot, spec, &mut recording)?;
        Ok(DetailedMatch { record, recording })
    }

    fn backtrace(
        &self,
        _: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, InfrastructureError> {
        let runtime = Runtime::for_backtraces(*self.runtime.limits())?;
        runtime.clock().start()?;
        let Ok(robot) = runtime.admit(file) else {
            return Ok(None);
        };
        let mut recording = Recording::default();
        let clock = MatchClock::start(self.control.clone(), None);
        let (result, _) = runtime.run_within(&robot, spec, &mut recording, &clock)?;
        Ok(match result.verdict.fault() {
            Some(again) if again == fault => Some(recording.frames),
            _ => None,
        })
    }

    fn profile(
        &self,
        _: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        played: &DetailedMatch,
    ) -> Result<Result<Profile, String>, InfrastructureError> {
        let expected = Expected::new(&played.record, &played.recording.step_fuel);
        let profiler = Profiler::new(*self.runtime.limits())?;
        // Looking at every call takes far longer than a match may.
        let control = Control {
            match_time: PROFILE_TIME_MAX,
            ..self.control.clone()
        };
        thread::scope(|scope| {
            let profile = || {
                let clock = MatchClock::start(control, None);
                profiler.profile(file, spec, expected, &clock)
            };
            // Wrappers make the stack deeper.
            let stack = usize::try_from(spec.rules.sandbox.stack_bytes_max).unwrap_or(usize::MAX);
            let thread = thread::Builder::new()
                .name("profile".to_owned())
                .stack_size(STACK_BYTES.saturating_add(stack.saturating_mul(2)))
                .spawn_scoped(scope, profile)
                .map_err(InfrastructureError::Thread)?;
            let profiled = thread.join();
            match profiled.unwrap_or_else(|panic| std::panic::resume_unwind(panic)) {
                Ok(profile) => Ok(Ok(profile)),
                Err(ProfileError::Host(error)) => Err(error),
                Err(error) => Ok(Err(error.to_string())),
            }
        })
    }
}

/// Processor time of a match that is profiled in this process.
const PROFILE_TIME_MAX: Duration = Duration::from_secs(3600);

/// Runs robots in sandboxed worker processes: for robots that are not trusted.
pub struct Sandboxed {
    supervisor: Supervisor,
}

impl Sandboxed {
    /// An executor for matches by these rules, with compiled robots kept in `cache`. Starts the
    /// first worker.
    ///
    /// # Errors
    ///
    /// As [`Supervisor::new`].
    pub fn new(
        rules: Arc<Ruleset>,
        limits: Limits,
        workers: WorkerOptions,
        cache: Option<Cache>,
    ) -> Result<Self, InfrastructureError> {
        let supervisor = Supervisor::new(rules, limits, workers, cache)?;
        Ok(Self { supervisor })
    }

    /// Which layers of the sandbox the workers have.
    pub const fn sandbox(&self) -> SandboxStatus {
        self.supervisor.sandbox()
    }
}

impl Executor for Sandboxed {
    fn admit(&self, file: &[u8]) -> Result<Result<AdmittedRobot, Rejection>, InfrastructureError> {
        let admitted = self.supervisor.admit(file)?;
        Ok(admitted.map(|robot| AdmittedRobot {
            account: Arc::clone(robot.account()),
            handle: Handle::Sandboxed(robot),
        }))
    }

    fn inspect(&self, file: &[u8]) -> Result<Inspection, InfrastructureError> {
        self.supervisor.inspect(file)
    }

    fn execute(
        &self,
        robot: &AdmittedRobot,
        batch: &[MatchSpec],
        sink: &mut Sink<'_>,
    ) -> ControlFlow<()> {
        let robot = match robot.sandboxed() {
            Ok(robot) => robot,
            Err(_) => {
                return batch
                    .iter()
                    .try_for_each(|spec| sink(spec, Err(InfrastructureError::ForeignRobot)));
            }
        };
        let mut specs = batch.iter();
        let mut recording = Recording::default();
        let mut pass_on = |played: Result<MatchRecord, InfrastructureError>, it: &Recording| {
            let spec = specs.next().expect("one record for each match");
            let transcript = &it.transcript;
            sink(spec, played.map(|record| Played { record, transcript }))
        };
        self.supervisor
            .play(robot, batch, &mut recording, &mut pass_on)
    }

    fn execute_with_details(
        &self,
        robot: &AdmittedRobot,
        spec: &MatchSpec,
    ) -> Result<DetailedMatch, InfrastructureError> {
        let mut recording = Recording::default();
        let robot = robot.sandboxed()?;
        let record = self
            .supervisor
            .play_with_details(robot, spec, &mut recording)?;
        Ok(DetailedMatch { record, recording })
    }

    fn backtrace(
        &self,
        _: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, InfrastructureError> {
        self.supervisor.backtrace(file, spec, fault)
    }

    fn profile(
        &self,
        _: &AdmittedRobot,
        file: &[u8],
        spec: &MatchSpec,
        played: &DetailedMatch,
    ) -> Result<Result<Profile, String>, InfrastructureError> {
        let expected = Expected::new(&played.record, &played.recording.step_fuel);
        self.supervisor
            .profile(file, spec, &expected, played.record.fuel)
    }
}
