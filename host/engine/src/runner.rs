//! [`Runtime::run`]: one match of an admitted robot in a maze.
//!
//! A pure function of the match's key: a fresh store and instance per match, fuel from the
//! first instruction, and no clock.

use std::sync::Arc;

use wasmouse_core::GuestText;
use wasmouse_core::game::{FaultKind, FuelLimit, Phase, SandboxLimits, Simulation};
use wasmouse_core::journal::Journal;
use wasmouse_core::record::{FuelUse, GameResult, MatchSpec, Transcript, Usage};
use wasmtime::{Store, UpdateDeadline};

use crate::error::InfrastructureError;
use crate::runtime::{
    CompiledRobot, Frame, Guest, Instance, Runtime, action, briefing, classify, frames,
    out_of_fuel, sensors,
};
use crate::time::{Control, MatchClock};

/// Everything that a match leaves behind besides its result and usage. Reused from match to
/// match, so that a long contest allocates once.
#[derive(Debug, Default)]
pub struct Recording {
    /// The robot's actions, and how the match ended.
    pub transcript: Transcript,
    /// What the robot wrote to its journal.
    pub journal: Journal,
    /// Fuel of every call of `next-move`, in order: one for each step, and one more when the
    /// last call ended in a fault.
    pub step_fuel: Vec<u64>,
    /// The calls in progress when the robot failed, most recent first; empty unless the
    /// runtime was made for backtraces.
    pub frames: Vec<Frame>,
}

impl Recording {
    /// Forgets everything, keeps the memory, and sets the journal's limit.
    pub(crate) fn clear(&mut self, limits: &SandboxLimits) {
        self.transcript.clear();
        self.journal.clear(limits.journal_bytes_max);
        self.step_fuel.clear();
        self.frames.clear();
    }
}

impl Runtime {
    /// Plays one match.
    ///
    /// # Errors
    ///
    /// Only when the host fails; whatever a robot does is in the verdict.
    ///
    /// # Panics
    ///
    /// When the match has other sandbox limits than the runtime was made with.
    pub fn run(
        &self,
        robot: &CompiledRobot,
        spec: &MatchSpec,
        recording: &mut Recording,
    ) -> Result<(GameResult, Usage), InfrastructureError> {
        let clock = MatchClock::start(Control::default(), None);
        self.run_within(robot, spec, recording, &clock)
    }

    /// [`Runtime::run`] for as long as the clock allows, which was started on this thread.
    pub(crate) fn run_within(
        &self,
        robot: &CompiledRobot,
        spec: &MatchSpec,
        recording: &mut Recording,
        clock: &Arc<MatchClock>,
    ) -> Result<(GameResult, Usage), InfrastructureError> {
        self.run_watched(robot, spec, recording, |store| watch(store, clock))
    }

    /// [`Runtime::run`] with something else that looks at the match with every epoch.
    pub(crate) fn run_watched(
        &self,
        robot: &CompiledRobot,
        spec: &MatchSpec,
        recording: &mut Recording,
        watch: impl FnOnce(&mut Store<Guest>),
    ) -> Result<(GameResult, Usage), InfrastructureError> {
        assert_eq!(
            spec.rules.sandbox,
            self.limits().sandbox,
            "the runtime was made for other limits"
        );
        recording.clear(&spec.rules.sandbox);
        let guest = Guest {
            limiter: self.limiter(),
            journal: std::mem::take(&mut recording.journal),
            dimension: spec.maze.dimension(),
            step: 0,
            calls: 0,
        };
        let mut simulation = Simulation::new(&spec.maze, &spec.rules.game);
        let mut store = self.store(guest);
        watch(&mut store);
        let mut runner = Runner::new(store, spec, recording);
        let ended = runner.run(robot, &mut simulation);
        let fuel = runner.fuel;
        let guest = runner.store.into_data();
        recording.journal = guest.journal;
        let usage = Usage {
            fuel,
            memory_bytes: guest.limiter.memory_bytes(),
            journal: recording.journal.counts(),
        };
        if let Some(stop) = ended? {
            recording
                .transcript
                .end_with_fault(stop.kind, stop.phase, stop.detail);
        }
        let result = GameResult::new(&simulation, recording.transcript.ending())
            .expect("a match that was simulated step by step follows the rules");
        Ok((result, usage))
    }
}

/// Asks the clock with every epoch whether the match may go on.
fn watch(store: &mut Store<Guest>, clock: &Arc<MatchClock>) {
    let clock = Arc::clone(clock);
    store.set_epoch_deadline(1);
    store.epoch_deadline_callback(move |_| {
        clock.check().map_err(wasmtime::Error::new)?;
        Ok(UpdateDeadline::Continue(1))
    });
}

/// One match in progress, on the side of the robot.
struct Runner<'a> {
    store: Store<Guest>,
    spec: &'a MatchSpec,
    transcript: &'a mut Transcript,
    step_fuel: &'a mut Vec<u64>,
    frames: &'a mut Vec<Frame>,
    fuel: FuelUse,
    /// What is left of the match's fuel.
    match_fuel: u64,
}

/// The robot failed.
struct Stop {
    kind: FaultKind,
    phase: Phase,
    detail: GuestText,
}

/// What came of a call: a value, or the robot's failure with its reason.
type Called<T> = Result<T, (FaultKind, GuestText)>;

impl<'a> Runner<'a> {
    fn new(mut store: Store<Guest>, spec: &'a MatchSpec, recording: &'a mut Recording) -> Self {
        let limits = &spec.rules.sandbox;
        store.limiter(|guest| &mut guest.limiter);
        let copied_max = usize::try_from(limits.host_call_bytes_max).unwrap_or(usize::MAX);
        store.set_hostcall_fuel(copied_max);
        // The interface has no resources, so a robot never holds a handle.
        store.set_max_component_handles(16);
        Self {
            store,
            spec,
            transcript: &mut recording.transcript,
            step_fuel: &mut recording.step_fuel,
            frames: &mut recording.frames,
            fuel: FuelUse::default(),
            match_fuel: limits.match_fuel_max,
        }
    }

    /// Plays to the end of the match; `None` when the rules ended it.
    fn run(
        &mut self,
        robot: &CompiledRobot,
        simulation: &mut Simulation<'_>,
    ) -> Result<Option<Stop>, InfrastructureError> {
        let stop = |phase| {
            move |(kind, detail)| Stop {
                kind,
                phase,
                detail,
            }
        };
        let start = (FuelLimit::Start, self.spec.rules.sandbox.start_fuel_max);
        let instantiated = self.instantiate(robot)?;
        let instance = match instantiated.map_err(stop(Phase::Instantiate)) {
            Ok(instance) => instance,
            Err(stop) => return Ok(Some(stop)),
        };
        let controller = instance.wasmouse_robot_controller();

        let briefing = briefing(self.spec);
        let (called, used) = self.call(start, |store| controller.call_start(store, briefing))?;
        self.fuel.start = used;
        self.match_fuel = self.match_fuel.saturating_sub(used);
        if let Err(stop) = called.map_err(stop(Phase::Start)) {
            return Ok(Some(stop));
        }

        while !simulation.has_ended() {
            self.store.data_mut().step += 1;
            let readings = sensors(simulation.sense());
            let limit = self.step_fuel_limit();
            let (called, used) =
                self.call(limit, |store| controller.call_next_move(store, readings))?;
            self.step_fuel.push(used);
            self.fuel.steps += used;
            self.fuel.step_max = self.fuel.step_max.max(used);
            self.match_fuel -= used;
            match called.map_err(stop(Phase::NextMove)) {
                Ok(moved) => {
                    let action = action(moved);
                    simulation.apply(action);
                    self.transcript.push(action);
                }
                Err(stop) => return Ok(Some(stop)),
            }
        }
        Ok(None)
    }

    /// Makes the robot's instance, with the fuel that is left of the start's after what the
    /// instance costs.
    fn instantiate(
        &mut self,
        robot: &CompiledRobot,
    ) -> Result<Called<Instance>, InfrastructureError> {
        let max = self.spec.rules.sandbox.start_fuel_max;
        let Some(fuel) = max.checked_sub(robot.startup_fuel()) else {
            return Ok(Err(out_of_fuel((FuelLimit::Start, max))));
        };
        let (called, _) = self.call((FuelLimit::Start, fuel), |store| robot.instantiate(store))?;
        Ok(called)
    }

    /// The fuel of the next step: its own limit, or what is left of the match's.
    fn step_fuel_limit(&self) -> (FuelLimit, u64) {
        let step = self.spec.rules.sandbox.step_fuel_max;
        if self.match_fuel < step {
            (FuelLimit::Match, self.match_fuel)
        } else {
            (FuelLimit::Step, step)
        }
    }

    /// Calls into the robot with that much fuel; also returns the fuel used.
    fn call<T>(
        &mut self,
        (limit, fuel): (FuelLimit, u64),
        call: impl FnOnce(&mut Store<Guest>) -> wasmtime::Result<T>,
    ) -> Result<(Called<T>, u64), InfrastructureError> {
        let expect = "the engine is configured to consume fuel";
        self.store.data_mut().calls += 1;
        self.store.set_fuel(fuel).expect(expect);
        let called = call(&mut self.store);
        let used = fuel - self.store.get_fuel().expect(expect);
        let called = match called {
            Ok(value) => Ok(value),
            Err(error) => {
                // The clock said so, or the host itself failed.
                let error = match error.downcast::<InfrastructureError>() {
                    Ok(error) => return Err(error),
                    Err(error) => error,
                };
                let limits = &self.spec.rules.sandbox;
                let max = match limit {
                    FuelLimit::Match => limits.match_fuel_max,
                    FuelLimit::Start => limits.start_fuel_max,
                    FuelLimit::Step => fuel,
                };
                *self.frames = frames(&error);
                Err(classify(&error, (limit, max), limits.host_call_bytes_max)?)
            }
        };
        Ok((called, used))
    }
}
