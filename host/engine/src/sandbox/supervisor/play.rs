//! Playing batches of matches in workers, whatever happens to those.
//!
//! Nothing that happens to a worker changes a result. A match whose worker ends is played
//! again alone in a fresh one; only a robot that crashes that one too is blamed. A worker that
//! was killed from outside is never the robot's fault. A match that takes too long is not played
//! again here: whoever asked for it decides when.

use std::io;
use std::ops::ControlFlow;

use wasmouse_core::game::{FaultKind, Phase};
use wasmouse_core::record::{MatchRecord, MatchSpec, Usage, replay};

use super::super::protocol::Loaded;
use super::super::role::Role;
use super::check::check;
use super::monitor::Kill;
use super::pool::{Pool, RunWorker};
use super::process::WorkerExit;
use super::robot::SandboxedRobot;
use crate::error::InfrastructureError;
use crate::runner::Recording;

/// Matches in one message, at most: fewer than the mazes that a worker keeps.
const BATCH_MAX: usize = 64;

/// How often a match is tried when its worker ends for reasons that may not be the robot's.
const TRIES: u32 = 4;

/// Gets what came of each match, in order, and says whether to go on.
pub type Sink<'a> =
    dyn FnMut(Result<MatchRecord, InfrastructureError>, &Recording) -> ControlFlow<()> + 'a;

impl Pool {
    /// Plays matches of a robot and passes on their records in order, until the sink breaks.
    pub(super) fn play(
        &self,
        robot: &SandboxedRobot,
        specs: &[MatchSpec],
        recording: &mut Recording,
        sink: &mut Sink<'_>,
    ) -> ControlFlow<()> {
        specs
            .chunks(BATCH_MAX)
            .try_for_each(|batch| self.play_batch(robot, batch, recording, sink))
    }

    /// Plays one match and leaves its journal and its fuel by step in `recording`.
    pub(super) fn play_with_details(
        &self,
        robot: &SandboxedRobot,
        spec: &MatchSpec,
        recording: &mut Recording,
    ) -> Result<MatchRecord, InfrastructureError> {
        robot.account.check()?;
        let worker = self.take(&robot.digest)?;
        match self.play_one(worker, robot, (spec, true), recording) {
            Ok(Ok(record)) => Ok(record),
            Ok(Err(error)) if error.is_final() => Err(error),
            Err(exit) if exit.killed.is_some() => Err(self.given_up(&exit, robot)),
            Ok(Err(_)) | Err(_) => self.play_alone(robot, (spec, true), recording),
        }
    }

    fn play_batch(
        &self,
        robot: &SandboxedRobot,
        specs: &[MatchSpec],
        recording: &mut Recording,
        sink: &mut Sink<'_>,
    ) -> ControlFlow<()> {
        let mut left = specs;
        while !left.is_empty() {
            let worker = match robot
                .account
                .check()
                .and_then(|()| self.take(&robot.digest))
            {
                Ok(worker) => worker,
                Err(InfrastructureError::Cancelled) => return ControlFlow::Break(()),
                Err(InfrastructureError::Withdrawn(reason)) => {
                    let error = || InfrastructureError::Withdrawn(reason);
                    return left.iter().try_for_each(|_| sink(Err(error()), recording));
                }
                Err(error) => {
                    let reason = error.to_string();
                    return left
                        .iter()
                        .try_for_each(|_| sink(Err(run_failed(reason.clone())), recording));
                }
            };
            let mut done = 0;
            let mut flow = ControlFlow::Continue(());
            let mut given_up = None;
            let ended = self.try_batch(
                worker,
                robot,
                (left, false),
                recording,
                &mut |record, recording| match record {
                    Ok(record) => {
                        done += 1;
                        flow = sink(Ok(record), recording);
                        flow
                    }
                    // A match that the worker itself gave up on.
                    Err(error) => {
                        given_up = Some(error);
                        ControlFlow::Break(())
                    }
                },
            );
            flow?;
            left = left.get(done..).unwrap_or_default();
            let Some((first, rest)) = left.split_first() else {
                break;
            };
            let played = match (given_up, ended) {
                (Some(error), _) if error.is_final() => Err(error),
                // Reports wait for each other, so perhaps not the first match took so long.
                (_, Err(exit)) if is_slow(&exit) && !rest.is_empty() => {
                    self.play_alone(robot, (first, false), recording)
                }
                (_, Err(exit)) if exit.killed.is_some() => Err(self.given_up(&exit, robot)),
                (None, Ok(())) => continue,
                _ => self.play_alone(robot, (first, false), recording),
            };
            if matches!(played, Err(InfrastructureError::Cancelled)) {
                return ControlFlow::Break(());
            }
            sink(played, recording)?;
            left = rest;
        }
        ControlFlow::Continue(())
    }

    /// Why a match has no result whose worker the supervisor killed.
    fn given_up(&self, exit: &WorkerExit, robot: &SandboxedRobot) -> InfrastructureError {
        let workers = &self.starter.workers;
        let error = match exit.killed {
            Some(Kill::Cancelled) => InfrastructureError::Cancelled,
            Some(Kill::Withdrawn) => match robot.account.check() {
                Err(error) => error,
                Ok(()) => run_failed(exit.to_string()),
            },
            Some(Kill::Slow) => InfrastructureError::Slow {
                seconds: workers.control.match_time.as_secs(),
            },
            Some(Kill::Deadline) => InfrastructureError::Stalled {
                seconds: workers.patience.as_secs(),
            },
            None => run_failed(exit.to_string()),
        };
        if error.is_stall() {
            robot.account.count_stall();
        }
        error
    }

    /// Plays one match in workers that have run nothing else, and blames the robot when it
    /// crashes one of those.
    fn play_alone(
        &self,
        robot: &SandboxedRobot,
        (spec, details): (&MatchSpec, bool),
        recording: &mut Recording,
    ) -> Result<MatchRecord, InfrastructureError> {
        let mut tries = 0;
        loop {
            tries += 1;
            let exit = match self.play_one(self.start()?, robot, (spec, details), recording) {
                Ok(record) => return record,
                Err(exit) => exit,
            };
            if exit.killed.is_some() {
                return Err(self.given_up(&exit, robot));
            }
            // No robot can use up the memory of a worker, so that is the host's.
            if exit.is_crash() && !exit.is_out_of_memory() {
                return Ok(crashed(&exit, spec, recording));
            }
            if tries == TRIES || !exit.is_kill() {
                return Err(run_failed(exit.to_string()));
            }
        }
    }

    fn play_one(
        &self,
        worker: RunWorker,
        robot: &SandboxedRobot,
        (spec, details): (&MatchSpec, bool),
        recording: &mut Recording,
    ) -> Result<Result<MatchRecord, InfrastructureError>, WorkerExit> {
        let mut played = Err(run_failed("it was not played".into()));
        let specs = std::slice::from_ref(spec);
        self.try_batch(
            worker,
            robot,
            (specs, details),
            recording,
            &mut |record, _| {
                played = record;
                ControlFlow::Continue(())
            },
        )?;
        Ok(played)
    }

    /// Plays matches in that worker and keeps it when all went well. A worker that is in the
    /// middle of something when the sink breaks is killed.
    fn try_batch(
        &self,
        mut worker: RunWorker,
        robot: &SandboxedRobot,
        (specs, details): (&[MatchSpec], bool),
        recording: &mut Recording,
        sink: &mut Sink<'_>,
    ) -> Result<(), WorkerExit> {
        let mut played = specs.iter();
        let mut stopped = false;
        let outcome = worker.load(&robot.digest, &robot.code).and_then(|loaded| {
            if !matches!(loaded, None | Some(Loaded::Ready(_))) {
                return Err(io::Error::other("an admitted robot cannot be loaded"));
            }
            worker.run(robot, specs, details, &mut |report| {
                let spec = played.next().ok_or(io::ErrorKind::InvalidData)?;
                let record = check(report, spec, recording).map_err(io::Error::other)?;
                match &record {
                    Ok(_) => robot.account.count_match(),
                    Err(error) if error.is_stall() => robot.account.count_stall(),
                    Err(_) => {}
                }
                stopped = sink(record, recording).is_break();
                if stopped {
                    return Err(io::ErrorKind::Interrupted.into());
                }
                Ok(())
            })
        });
        match outcome {
            Ok(()) => {
                self.put(worker);
                Ok(())
            }
            Err(_) if stopped => Ok(()),
            Err(error) => Err(worker.reap(&error)),
        }
    }
}

/// Whether a worker was killed because of one match.
fn is_slow(exit: &WorkerExit) -> bool {
    matches!(exit.killed, Some(Kill::Slow | Kill::Deadline))
}

/// The record of a match that crashes its worker each time.
fn crashed(exit: &WorkerExit, spec: &MatchSpec, recording: &mut Recording) -> MatchRecord {
    recording.clear(&spec.rules.sandbox);
    let detail = format!("crashed its worker process twice: {exit}");
    let transcript = &mut recording.transcript;
    transcript.end_with_fault(FaultKind::Crash, Phase::Unknown, detail);
    let result = replay(&spec.maze, &spec.rules.game, transcript)
        .expect("a match may fail before its first step");
    MatchRecord::new(spec.key, result, Usage::default(), transcript)
}

fn run_failed(reason: String) -> InfrastructureError {
    InfrastructureError::Worker {
        role: Role::Run.name(),
        reason,
    }
}
