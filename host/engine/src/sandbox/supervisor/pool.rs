//! [`Pool`]: run workers that wait for work, and what each of them keeps.

use std::collections::HashMap;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use wasmouse_core::Digest;
use wasmouse_core::game::Ruleset;
use wasmouse_core::record::MatchSpec;

use super::super::protocol::{Loaded, MatchOrder, MatchReport, Request, RunBatch, Setup};
use super::super::role::{Role, SandboxStatus};
use super::monitor::{Kill, Limit};
use super::process::{Process, START_TIME_MAX, Starter, Talk, WorkerExit};
use super::robot::SandboxedRobot;
use crate::error::InfrastructureError;
use crate::limits::Limits;
use crate::runtime::CompiledCode;

/// Robots that a shared worker keeps. In a contest they take turns, maze by maze; loading one again
/// takes 0.1 ms, or 26 ms and 60 MB for a Python robot.
const ROBOT_SLOTS: usize = 8;

/// Idle workers that are kept for their robots, so that no worker runs two robots: one takes 3 MB,
/// and starting one takes as long as some ten matches. With more robots than this, workers are
/// shared.
const IDLE_MAX: usize = 32;

/// Mazes that a worker keeps, of a few kilobytes each.
const MAZE_SLOTS: usize = 1024;

/// How long a worker may take to load a robot.
const LOAD_TIME_MAX: Duration = Duration::from_secs(60);

/// How often a worker is started again that is killed before it has sent anything.
const STARTS_MAX: u32 = 4;

/// How much longer than it should a match may take in a worker before that is killed: its own
/// clock comes first, so that a slow robot does not cost a worker.
const GRACE: Duration = Duration::from_secs(1);

/// Starts run workers and keeps the idle ones.
pub(super) struct Pool {
    // Before the starter: workers end before the thread that they live with.
    idle: Mutex<Vec<RunWorker>>,
    pub(super) starter: Starter,
    /// What every worker is set up with.
    pub(super) rules: Arc<Ruleset>,
    pub(super) limits: Limits,
}

impl Pool {
    /// A pool without workers.
    pub(super) const fn new(starter: Starter, rules: Arc<Ruleset>, limits: Limits) -> Self {
        Self {
            idle: Mutex::new(Vec::new()),
            starter,
            rules,
            limits,
        }
    }

    /// A worker: an idle one that has the robot, else one that has none, else a new one. When
    /// too many are idle, it is the one that has been so for longest, whatever it has run.
    pub(super) fn take(&self, robot: &Digest) -> Result<RunWorker, InfrastructureError> {
        let idle = {
            let mut idle = self.lock();
            let own = idle.iter().position(|worker| worker.robots.has(robot));
            let index = own.or_else(|| idle.iter().position(|worker| worker.robots.is_empty()));
            match index {
                Some(index) => Some(idle.remove(index)),
                None if idle.len() >= IDLE_MAX => Some(idle.remove(0)),
                None => None,
            }
        };
        match idle {
            Some(worker) => Ok(worker),
            None => self.start(),
        }
    }

    /// Keeps a worker for later.
    pub(super) fn put(&self, worker: RunWorker) {
        self.lock().push(worker);
    }

    /// Ends all idle workers, which may have what the machine lacks: descriptors, memory. Says
    /// whether there was any.
    pub(super) fn end_idle(&self) -> bool {
        let idle = std::mem::take(&mut *self.lock());
        !idle.is_empty()
    }

    /// Starts a worker; if need be, in the place of idle ones.
    pub(super) fn start(&self) -> Result<RunWorker, InfrastructureError> {
        match self.start_once() {
            Err(InfrastructureError::Worker { .. }) if self.end_idle() => self.start_once(),
            started => started,
        }
    }

    /// Starts a worker; another one when that is killed from outside before it has sent
    /// anything.
    fn start_once(&self) -> Result<RunWorker, InfrastructureError> {
        let mut starts = 0;
        loop {
            starts += 1;
            match self.try_start()? {
                Ok(worker) => return Ok(worker),
                Err(exit) if exit.killed == Some(Kill::Cancelled) => {
                    return Err(InfrastructureError::Cancelled);
                }
                Err(exit) if exit.is_kill() && starts < STARTS_MAX => {}
                Err(exit) => {
                    return Err(InfrastructureError::Worker {
                        role: Role::Run.name(),
                        reason: exit.to_string(),
                    });
                }
            }
        }
    }

    fn try_start(&self) -> Result<Result<RunWorker, WorkerExit>, InfrastructureError> {
        let mut process = Process::start(&self.starter, Role::Run)?;
        let setup = Setup {
            rules: Ruleset::clone(&self.rules),
            limits: self.limits,
            match_time: self.starter.workers.control.match_time,
        };
        let greeted = process.exchange(Limit::wall(START_TIME_MAX), |talk| {
            talk.send(&setup)?;
            talk.flush()?;
            talk.greet()
        });
        match greeted {
            Ok(sandbox) => {
                self.starter.check(sandbox)?;
                Ok(Ok(RunWorker {
                    process,
                    sandbox,
                    patience: self.starter.workers.patience,
                    match_time: self.starter.workers.control.match_time,
                    robots: Slots::new(ROBOT_SLOTS),
                    mazes: Slots::new(MAZE_SLOTS),
                }))
            }
            Err(error) => Ok(Err(process.reap(&error))),
        }
    }

    fn lock(&self) -> MutexGuard<'_, Vec<RunWorker>> {
        // Nothing that holds the lock panics half-way.
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A run worker, with what it has been given.
pub(super) struct RunWorker {
    process: Process,
    pub(super) sandbox: SandboxStatus,
    patience: Duration,
    match_time: Duration,
    robots: Slots,
    mazes: Slots,
}

impl RunWorker {
    /// Has it load a robot, unless it has it already.
    pub(super) fn load(
        &mut self,
        robot: &Digest,
        code: &CompiledCode,
    ) -> io::Result<Option<Loaded>> {
        if self.robots.has(robot) {
            return Ok(None);
        }
        let slot = self.robots.free_next();
        let loaded = self.process.exchange(Limit::wall(LOAD_TIME_MAX), |talk| {
            talk.send(&Request::Robot {
                slot,
                length: code.length,
                code: code.digest,
                robot: *robot,
            })?;
            code.send(talk.writer())?;
            talk.flush()?;
            talk.receive()
        })?;
        if matches!(loaded, Loaded::Ready(_)) {
            self.robots.fill(slot, *robot);
        }
        Ok(Some(loaded))
    }

    /// Has it play matches of a robot that it has, and passes on its reports one by one, in
    /// order.
    pub(super) fn run(
        &mut self,
        robot: &SandboxedRobot,
        specs: &[MatchSpec],
        details: bool,
        sink: &mut dyn FnMut(MatchReport) -> io::Result<()>,
    ) -> io::Result<()> {
        let missing = || io::Error::other("the robot is not loaded");
        let slot = self.robots.find(&robot.digest).ok_or_else(missing)?;
        let limit = Limit {
            wall: self.patience,
            matches: Some((self.match_time + GRACE, Arc::clone(&robot.account))),
        };
        let mazes = &mut self.mazes;
        self.process.exchange(limit, |talk| {
            let mut matches = Vec::with_capacity(specs.len());
            for spec in specs {
                matches.push(MatchOrder {
                    maze: maze_slot(mazes, talk, spec)?,
                    seed: spec.key.seed,
                    variant: spec.key.variant,
                });
            }
            talk.send(&Request::Run(RunBatch {
                robot: slot,
                details,
                matches,
            }))?;
            talk.flush()?;
            for _ in specs {
                let has_waited = !talk.has_frame();
                let report = talk.receive()?;
                // Reports come many at a time, and each look at the clock takes two system calls. A
                // match whose report has come does not begin now.
                if has_waited || !talk.has_frame() {
                    talk.next_match();
                }
                sink(report)?;
            }
            Ok(())
        })
    }

    /// Kills and reaps it after `error`, and returns its exit status.
    pub(super) fn reap(self, error: &io::Error) -> WorkerExit {
        self.process.reap(error)
    }
}

/// The slot of the match's maze, which is sent when it is new.
fn maze_slot(mazes: &mut Slots, talk: &mut Talk<'_>, spec: &MatchSpec) -> io::Result<u16> {
    let digest = &spec.key.maze;
    if let Some(slot) = mazes.find(digest) {
        return Ok(slot);
    }
    let slot = mazes.free_next();
    talk.send(&Request::Maze {
        slot,
        digest: *digest,
        bytes: spec.maze.identity_bytes(),
    })?;
    mazes.fill(slot, *digest);
    Ok(slot)
}

/// What a worker keeps, by slot; the slot that was filled first is used again first.
struct Slots {
    digests: Vec<Option<Digest>>,
    by_digest: HashMap<Digest, u16>,
    next: usize,
}

impl Slots {
    fn new(count: usize) -> Self {
        Self {
            digests: vec![None; count],
            by_digest: HashMap::new(),
            next: 0,
        }
    }

    fn is_empty(&self) -> bool {
        self.by_digest.is_empty()
    }

    fn has(&self, digest: &Digest) -> bool {
        self.by_digest.contains_key(digest)
    }

    fn find(&self, digest: &Digest) -> Option<u16> {
        self.by_digest.get(digest).copied()
    }

    /// Empties the slot that is to be used next.
    fn free_next(&mut self) -> u16 {
        let slot = self.next;
        self.next = (slot + 1) % self.digests.len();
        if let Some(digest) = self.digests[slot].take() {
            self.by_digest.remove(&digest);
        }
        u16::try_from(slot).expect("a worker has fewer than 65,536 slots")
    }

    fn fill(&mut self, slot: u16, digest: Digest) {
        self.digests[usize::from(slot)] = Some(digest);
        self.by_digest.insert(digest, slot);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_slot_is_used_again() {
        let mut slots = Slots::new(2);
        let digest = |byte: u8| Digest::of(&[byte]);
        for byte in 0..3 {
            let slot = slots.free_next();
            slots.fill(slot, digest(byte));
        }
        let found = [0, 1, 2].map(|byte| slots.find(&digest(byte)));
        assert_eq!(found, [None, Some(1), Some(0)]);
    }
}
