//! [`Host::play`]: one match of an admitted robot in a maze.
//!
//! A pure function of component, maze, ruleset, seed and setting: a fresh store
//! and instance per match, fuel from the first instruction, and no clock.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

use wasmtime::Store;

use super::bindings::{self, Robot as RobotInstance};
use super::fault::{FuelLimit, classify};
use super::guest::Guest;
use super::limiter::Limiter;
use super::{Digest, Fault, FaultKind, Frame, Host, HostError, Journal, Robot, backtrace, engine};
use crate::maze::Maze;
use crate::sim::{Action, Counts, End, Ruleset, Run, Score, Simulation, Trace};

/// What a match is about, besides the robot.
#[derive(Clone, Copy, Debug)]
pub struct Game<'a> {
    /// The maze.
    pub maze: &'a Maze,
    /// The rules. Their limits must be those of the host.
    pub rules: &'a Ruleset,
    /// The robot's only source of chance.
    pub seed: u64,
    /// The variant of the robot.
    pub setting: u32,
}

/// Everything that a match leaves behind besides its [`Outcome`]. Reused from
/// match to match, so that a long contest allocates once.
#[derive(Debug, Default)]
pub struct Recorder {
    /// Every step.
    pub trace: Trace,
    /// What the robot said.
    pub journal: Journal,
    /// Fuel of every step, in order; one more than the trace has when the last
    /// call ended in a fault.
    pub step_fuel: Vec<u64>,
    /// Where in its code the robot was when it failed, the innermost call first; empty
    /// unless the host was made to explain.
    pub frames: Vec<Frame>,
}

impl Recorder {
    /// The digest of the trace.
    pub fn trace_digest(&self) -> Digest {
        Digest::of(&self.trace.identity_bytes())
    }
}

/// What the robot was doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Phase {
    /// Core start functions and data segments.
    Instantiate,
    /// The call of `start`.
    Start,
    /// A call of `next-move`.
    NextMove,
    /// Nobody knows: the process that would have is gone.
    Unknown,
}

impl Phase {
    /// A short name as in JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Instantiate => "instantiate",
            Self::Start => "start",
            Self::NextMove => "next-move",
            Self::Unknown => "unknown",
        }
    }
}

/// How a match ended. Closed: every match ends in exactly one of these.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Run 2 ended in the goal.
    Finished(Score),
    /// The step budget is used up.
    BudgetUsedUp {
        /// Whether a step of run 1 ended in the goal.
        goal_reached: bool,
    },
    /// The robot failed.
    Fault(Fault),
}

impl Verdict {
    /// A short name as in JSON: lowercase letters and hyphens.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Finished(_) => "finished",
            Self::BudgetUsedUp { goal_reached: true } => "budget-used-up-goal-reached",
            Self::BudgetUsedUp {
                goal_reached: false,
            } => "budget-used-up",
            Self::Fault(_) => "fault",
        }
    }

    /// The verdict in a few words for people.
    pub fn title(&self) -> Cow<'static, str> {
        match self {
            Self::Finished(_) => "finished".into(),
            Self::BudgetUsedUp { goal_reached: true } => "budget used up, goal reached".into(),
            Self::BudgetUsedUp {
                goal_reached: false,
            } => "budget used up".into(),
            Self::Fault(fault) => format!("fault: {}", fault.kind.name()).into(),
        }
    }
}

/// Fuel that a match used. The fuel of instantiation is limited but not told:
/// it depends on the operating system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FuelUse {
    /// In `start`.
    pub start: u64,
    /// In all steps together.
    pub steps: u64,
    /// In the most expensive step.
    pub step_max: u64,
}

/// The result of a match.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// How it ended.
    pub verdict: Verdict,
    /// Steps of run 1 and run 2.
    pub steps: [u32; 2],
    /// Bumps, clamps, refused resets.
    pub counts: Counts,
    /// Fuel.
    pub fuel: FuelUse,
}

impl Host {
    /// Plays one match.
    ///
    /// # Errors
    ///
    /// Only when the host fails; whatever a robot does is in the verdict.
    ///
    /// # Panics
    ///
    /// When the ruleset's limits are not those that the host was made with.
    pub fn play(
        &self,
        robot: &Robot,
        game: &Game<'_>,
        recorder: &mut Recorder,
    ) -> Result<Outcome, HostError> {
        assert_eq!(
            game.rules.limits,
            *self.limits(),
            "the host was made for other limits"
        );
        let limits = &game.rules.limits;
        recorder.step_fuel.clear();
        recorder.frames.clear();
        recorder.journal.clear(limits.journal_bytes_max);
        let guest = Guest {
            limiter: Limiter::new(limits),
            journal: std::mem::take(&mut recorder.journal),
            dimension: game.maze.dimension(),
            step: 0,
        };
        let mut simulation = Simulation::new(game.maze, game.rules, &mut recorder.trace);
        let mut runner = Runner::new(self.store(guest), game, &mut recorder.step_fuel);
        let verdict = runner.run(robot, &mut simulation);
        let fuel = runner.fuel;
        recorder.frames = runner.frames;
        recorder.journal = runner.store.into_data().journal;
        Ok(Outcome {
            verdict: verdict?,
            steps: [
                simulation.steps(Run::Exploration),
                simulation.steps(Run::Speed),
            ],
            counts: simulation.counts(),
            fuel,
        })
    }
}

/// One match in progress on the side of the robot.
struct Runner<'a> {
    store: Store<Guest>,
    game: &'a Game<'a>,
    step_fuel: &'a mut Vec<u64>,
    fuel: FuelUse,
    /// What is left of the match's fuel.
    match_fuel: u64,
    /// Where the call that ended without an answer was.
    frames: Vec<Frame>,
}

/// A call ended without an answer, by the robot's own doing.
struct Stop {
    kind: FaultKind,
    detail: String,
}

impl<'a> Runner<'a> {
    fn new(mut store: Store<Guest>, game: &'a Game<'a>, step_fuel: &'a mut Vec<u64>) -> Self {
        let limits = &game.rules.limits;
        store.limiter(|guest| &mut guest.limiter);
        store.set_epoch_deadline(engine::match_epochs_max());
        let copied_max = usize::try_from(limits.host_call_bytes_max).unwrap_or(usize::MAX);
        store.set_hostcall_fuel(copied_max);
        // The interface has no resources, so a robot never holds a handle.
        store.set_max_component_handles(16);
        Self {
            store,
            game,
            step_fuel,
            fuel: FuelUse::default(),
            match_fuel: limits.match_fuel_max,
            frames: Vec::new(),
        }
    }

    fn run(
        &mut self,
        robot: &Robot,
        simulation: &mut Simulation<'_>,
    ) -> Result<Verdict, HostError> {
        let start = self.game.rules.limits.start_fuel_max;
        let (result, _) = self.call((FuelLimit::Start, start), |store| {
            robot.pre.instantiate(store)
        })?;
        let instance = match result {
            Ok(instance) => instance,
            Err(stop) => return Ok(stop.verdict(Phase::Instantiate, 0, simulation)),
        };

        let briefing = bindings::briefing(
            self.game.maze,
            self.game.rules,
            self.game.seed,
            self.game.setting,
        );
        let (result, used) = self.call((FuelLimit::Start, start), |store| {
            let controller = instance.wasmouse_robot_controller();
            controller.call_start(store, briefing)
        })?;
        self.fuel.start = used;
        self.match_fuel = self.match_fuel.saturating_sub(used);
        if let Err(stop) = result {
            return Ok(stop.verdict(Phase::Start, 0, simulation));
        }

        loop {
            match simulation.end() {
                Some(End::Finished(score)) => return Ok(Verdict::Finished(score)),
                Some(End::BudgetUsedUp { goal_reached }) => {
                    return Ok(Verdict::BudgetUsedUp { goal_reached });
                }
                None => {}
            }
            let step = simulation.steps_total() + 1;
            match self.next_move(&instance, step, simulation)? {
                Ok(action) => simulation.apply(action),
                Err(stop) => return Ok(stop.verdict(Phase::NextMove, step, simulation)),
            };
        }
    }

    fn next_move(
        &mut self,
        instance: &RobotInstance,
        step: u32,
        simulation: &Simulation<'_>,
    ) -> Result<Result<Action, Stop>, HostError> {
        let limits = &self.game.rules.limits;
        let limit = if self.match_fuel < limits.step_fuel_max {
            (FuelLimit::Match, self.match_fuel)
        } else {
            (FuelLimit::Step, limits.step_fuel_max)
        };
        self.store.data_mut().step = step;
        let sensors = simulation.sense().into();
        let (result, used) = self.call(limit, |store| {
            let controller = instance.wasmouse_robot_controller();
            controller.call_next_move(store, sensors)
        })?;
        self.step_fuel.push(used);
        self.fuel.steps += used;
        self.fuel.step_max = self.fuel.step_max.max(used);
        self.match_fuel -= used;
        Ok(result.map(Action::from))
    }

    /// Calls into the robot under a limit of fuel; also tells the fuel used.
    fn call<T>(
        &mut self,
        (limit, fuel): (FuelLimit, u64),
        call: impl FnOnce(&mut Store<Guest>) -> wasmtime::Result<T>,
    ) -> Result<(Result<T, Stop>, u64), HostError> {
        let expect = "the engine is configured to consume fuel";
        self.store.set_fuel(fuel).expect(expect);
        let result = call(&mut self.store);
        let used = fuel - self.store.get_fuel().expect(expect);
        let result = match result {
            Ok(value) => Ok(value),
            Err(error) => {
                let told = match limit {
                    FuelLimit::Match => self.game.rules.limits.match_fuel_max,
                    FuelLimit::Start | FuelLimit::Step => fuel,
                };
                self.frames = backtrace::frames(&error);
                let copied_max = self.game.rules.limits.host_call_bytes_max;
                let (kind, detail) = classify(&error, (limit, told), copied_max)?;
                Err(Stop { kind, detail })
            }
        };
        Ok((result, used))
    }
}

impl Stop {
    fn verdict(self, phase: Phase, step: u32, simulation: &Simulation<'_>) -> Verdict {
        Verdict::Fault(Fault {
            kind: self.kind,
            phase,
            run: simulation.run(),
            step,
            cell: simulation.cell(),
            detail: self.detail,
        })
    }
}
