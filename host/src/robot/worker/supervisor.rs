//! [`Supervisor`]: admits strangers' robots (`admit.rs`) and has them play, without
//! compiling, loading or running anything of theirs itself.

use std::io::{self, Write as _};
use std::ops::ControlFlow;
use std::time::Duration;

use wasmtime::Engine;

use super::Role;
use super::admit::RemoteRobot;
use super::confine::COMPILE_CPU_SECONDS;
use super::keeper::Keeper;
use super::pool::{PlayWorker, Pool};
use super::process::{Death, Process, Starter, Workers};
use super::replay::replay;
use super::wire::{ExplainOrder, Explained, Loaded, Sandbox};
use crate::robot::backtrace::FRAMES_MAX;
use crate::robot::referee::Each;
use crate::robot::{
    Cache, Digest, Fault, FaultKind, Frame, FuelUse, Game, HostError, Outcome, Phase, Record,
    Recorder, Verdict, engine,
};
use crate::sim::{Counts, Ruleset, Run};

/// Matches in one message, at most: fewer than the mazes that a worker keeps.
const BATCH_MAX: usize = 64;

/// What an explanation may take on the wall clock.
const EXPLAIN_TIME_MAX: Duration = Duration::from_secs(2 * COMPILE_CPU_SECONDS);

/// How often a match is tried whose worker ends for reasons that may not be the
/// robot's.
pub(super) const TRIES: u32 = 4;

/// The trusted side: starts workers, gives them files and matches, and judges what
/// they say. One supervisor serves any number of threads; each of them uses a worker of
/// its own.
pub struct Supervisor {
    // The pool before the keeper: workers end before the thread that they live with.
    pub(super) pool: Pool,
    pub(super) starter: Starter,
    pub(super) rules: Ruleset,
    pub(super) cache: Option<Cache>,
    /// Names what compiled code is for; compiles nothing.
    pub(super) compiler: Engine,
    sandbox: Sandbox,
}

impl Supervisor {
    /// A supervisor for matches by these rules, with compiled robots kept in `cache`.
    /// Starts the first worker, to see how well it is confined.
    ///
    /// # Errors
    ///
    /// When the machine gives no process, the program is another build of wasmouse, or
    /// completely confined workers are required and the operating system cannot confine
    /// them so.
    pub fn new(rules: Ruleset, workers: Workers, cache: Option<Cache>) -> Result<Self, HostError> {
        let starter = Starter {
            keeper: Keeper::start().map_err(HostError::thread)?,
            workers,
        };
        let compiler = engine::new_compiler(&rules.limits)?;
        let pool = Pool::default();
        let first = PlayWorker::start(&starter, &rules)?;
        let sandbox = first.sandbox;
        pool.put(first);
        Ok(Self {
            pool,
            starter,
            rules,
            cache,
            compiler,
            sandbox,
        })
    }

    /// How well the operating system confines the workers.
    pub const fn sandbox(&self) -> Sandbox {
        self.sandbox
    }

    /// Plays matches of a robot, and hands over their records in order, until `each`
    /// breaks.
    pub fn play(
        &self,
        robot: &RemoteRobot,
        games: &[Game<'_>],
        recorder: &mut Recorder,
        each: &mut Each<'_>,
    ) -> ControlFlow<()> {
        games
            .chunks(BATCH_MAX)
            .try_for_each(|batch| self.play_batch(robot, batch, recorder, each))
    }

    /// Plays one match and leaves everything about it in `recorder`.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn record(
        &self,
        robot: &RemoteRobot,
        game: &Game<'_>,
        recorder: &mut Recorder,
    ) -> Result<Record, HostError> {
        let worker = self.worker(&robot.digest)?;
        match self.play_one(worker, robot, (game, true), recorder) {
            Ok(Ok(record)) => Ok(record),
            Ok(Err(_)) | Err(_) => self.play_alone(robot, (game, true), recorder),
        }
    }

    /// Where in its code a robot is when it fails in that match, the innermost call first;
    /// `None` when it does not fail so again or that cannot be found out.
    ///
    /// # Errors
    ///
    /// When the machine gives no process.
    pub fn explain(
        &self,
        bytes: &[u8],
        game: &Game<'_>,
        fault: &Fault,
    ) -> Result<Option<Vec<Frame>>, HostError> {
        let mut process = Process::start(&self.starter, Role::Explain)?;
        process.expect_within(EXPLAIN_TIME_MAX);
        let explained = (|| -> io::Result<Explained> {
            process.send(&ExplainOrder {
                rules: self.rules,
                maze: game.maze.identity_bytes(),
                seed: game.seed,
                setting: game.setting,
                length: u64::try_from(bytes.len()).unwrap_or(u64::MAX),
            })?;
            process.writer().write_all(bytes)?;
            process.flush()?;
            let sandbox = process.greet()?;
            if !self.starter.may_use(sandbox) {
                return Err(io::ErrorKind::PermissionDenied.into());
            }
            process.receive()
        })();
        // An explanation is a courtesy: whatever went wrong, the verdict stands.
        Ok(match explained {
            Ok(Explained {
                fault: Some((kind, frames)),
            }) if kind == fault.kind => {
                let frames = frames.into_iter().take(FRAMES_MAX);
                Some(frames.map(Frame::checked).collect())
            }
            _ => None,
        })
    }

    /// Plays a batch. A match whose worker ends is played again alone in a fresh one.
    fn play_batch(
        &self,
        robot: &RemoteRobot,
        games: &[Game<'_>],
        recorder: &mut Recorder,
        each: &mut Each<'_>,
    ) -> ControlFlow<()> {
        let mut left = games;
        while !left.is_empty() {
            let worker = match self.worker(&robot.digest) {
                Ok(worker) => worker,
                Err(error) => {
                    let reason = error.to_string();
                    return left
                        .iter()
                        .try_for_each(|_| each(Err(play_failed(reason.clone()))));
                }
            };
            let mut done = 0;
            let mut flow = ControlFlow::Continue(());
            let mut failed = false;
            let ended = self.try_batch(worker, robot, (left, false), recorder, &mut |record| {
                // A match that the worker itself gave up is played again too.
                if record.is_err() {
                    failed = true;
                    return ControlFlow::Break(());
                }
                done += 1;
                flow = each(record);
                flow
            });
            flow?;
            left = left.get(done..).unwrap_or_default();
            if (failed || ended.is_err())
                && let Some((first, rest)) = left.split_first()
            {
                each(self.play_alone(robot, (first, false), recorder))?;
                left = rest;
            }
        }
        ControlFlow::Continue(())
    }

    /// Plays one match in workers that have seen nothing else, and blames the robot
    /// when it crashes one of those.
    fn play_alone(
        &self,
        robot: &RemoteRobot,
        (game, full): (&Game<'_>, bool),
        recorder: &mut Recorder,
    ) -> Result<Record, HostError> {
        let mut tries = 0;
        loop {
            tries += 1;
            let fresh = PlayWorker::start(&self.starter, &self.rules)?;
            let death = match self.play_one(fresh, robot, (game, full), recorder) {
                Ok(record) => return record,
                Err(death) => death,
            };
            if death.expired {
                return Err(HostError::Stalled);
            }
            if death.is_crash() {
                return Ok(crashed(&death, game, recorder));
            }
            if tries == TRIES || !death.is_kill() {
                return Err(play_failed(death.to_string()));
            }
        }
    }

    fn play_one(
        &self,
        worker: PlayWorker,
        robot: &RemoteRobot,
        (game, full): (&Game<'_>, bool),
        recorder: &mut Recorder,
    ) -> Result<Result<Record, HostError>, Death> {
        let mut played = Err(play_failed("it was not played".into()));
        let games = [*game];
        self.try_batch(worker, robot, (&games, full), recorder, &mut |record| {
            played = record;
            ControlFlow::Continue(())
        })?;
        Ok(played)
    }

    /// Plays matches in that worker and keeps it when all went well. A worker that is
    /// in the middle of something when `each` breaks is ended.
    fn try_batch(
        &self,
        mut worker: PlayWorker,
        robot: &RemoteRobot,
        (games, full): (&[Game<'_>], bool),
        recorder: &mut Recorder,
        each: &mut Each<'_>,
    ) -> Result<(), Death> {
        let mut played = games.iter();
        let mut stopped = false;
        let outcome = worker.load(&robot.digest, &robot.code).and_then(|loaded| {
            if let Some(Loaded::Refused(_) | Loaded::Damaged) = loaded {
                return Err(io::Error::other("an admitted robot cannot be loaded"));
            }
            worker.play(&robot.digest, games, full, &mut |answers| {
                let game = played.next().ok_or(io::ErrorKind::InvalidData)?;
                let record = replay(answers, game, recorder)
                    .map_err(|nonsense| io::Error::other(nonsense.0))?;
                stopped = each(record).is_break();
                if stopped {
                    return Err(io::ErrorKind::Interrupted.into());
                }
                Ok(())
            })
        });
        match outcome {
            Ok(()) => {
                self.pool.put(worker);
                Ok(())
            }
            Err(_) if stopped => Ok(()),
            Err(error) => Err(worker.bury(&error)),
        }
    }

    /// A worker, an idle one if there is one.
    fn worker(&self, robot: &Digest) -> Result<PlayWorker, HostError> {
        match self.pool.take(robot) {
            Some(worker) => Ok(worker),
            None => PlayWorker::start(&self.starter, &self.rules),
        }
    }
}

/// The record of a match that ends its worker each time.
fn crashed(death: &Death, game: &Game<'_>, recorder: &mut Recorder) -> Record {
    recorder.trace.clear();
    recorder.step_fuel.clear();
    recorder.journal.clear(game.rules.limits.journal_bytes_max);
    Record {
        outcome: Outcome {
            verdict: Verdict::Fault(Fault {
                kind: FaultKind::Crash,
                phase: Phase::Unknown,
                run: Run::Exploration,
                step: 0,
                cell: game.maze.start(),
                detail: format!("crashed the process that it ran in, twice: {death}"),
            }),
            steps: [0, 0],
            counts: Counts::default(),
            fuel: FuelUse::default(),
        },
        trace: recorder.trace_digest(),
        journal: (0, 0),
    }
}

pub(super) fn play_failed(reason: String) -> HostError {
    HostError::Worker {
        role: Role::Play.name(),
        reason,
    }
}
