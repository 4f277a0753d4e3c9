//! [`Pool`]: play workers that wait for work, and what each of them keeps.

use std::collections::HashMap;
use std::io;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::confine::Role;
use super::process::{Death, Process, Starter};
use super::wire::{Answers, Batch, GameOrder, Loaded, Request, Sandbox, Setup};
use crate::robot::code::Code;
use crate::robot::{Digest, Game, HostError};
use crate::sim::Ruleset;

/// Robots that a worker keeps; a contest plays them one after the other.
const ROBOT_SLOTS: u16 = 4;

/// Mazes that a worker keeps, of a few kilobytes each.
const MAZE_SLOTS: u16 = 1024;

/// What a worker may take to load a robot.
const LOAD_TIME_MAX: Duration = Duration::from_secs(60);

/// How often a worker is started that is killed at once.
const STARTS_MAX: u32 = 4;

/// A worker that plays, with what it has been given.
pub(super) struct PlayWorker {
    process: Process,
    pub(super) sandbox: Sandbox,
    patience: Duration,
    robots: [Option<Digest>; ROBOT_SLOTS as usize],
    next_robot: u16,
    mazes: HashMap<Vec<u8>, u16>,
    next_maze: u16,
}

/// Idle workers.
#[derive(Default)]
pub(super) struct Pool {
    idle: Mutex<Vec<PlayWorker>>,
}

impl Pool {
    /// An idle worker, one that has the robot rather than another.
    pub(super) fn take(&self, robot: &Digest) -> Option<PlayWorker> {
        let mut idle = self.lock();
        let with_robot = idle.iter().position(|worker| worker.has(robot));
        match with_robot {
            Some(index) => Some(idle.swap_remove(index)),
            None => idle.pop(),
        }
    }

    /// Keeps a worker for the next who needs one.
    pub(super) fn put(&self, worker: PlayWorker) {
        self.lock().push(worker);
    }

    fn lock(&self) -> MutexGuard<'_, Vec<PlayWorker>> {
        // Nothing that holds the lock panics half-way.
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl PlayWorker {
    /// Starts a worker for matches by these rules; another when that is killed from
    /// outside before it has said anything.
    pub(super) fn start(starter: &Starter, rules: &Ruleset) -> Result<Self, HostError> {
        let mut tries = 0;
        loop {
            tries += 1;
            match Self::try_start(starter, rules)? {
                Ok(worker) => return Ok(worker),
                Err(death) if death.is_kill() && tries < STARTS_MAX => {}
                Err(death) => {
                    return Err(HostError::Worker {
                        role: Role::Play.name(),
                        reason: death.to_string(),
                    });
                }
            }
        }
    }

    fn try_start(starter: &Starter, rules: &Ruleset) -> Result<Result<Self, Death>, HostError> {
        let mut process = Process::start(starter, Role::Play)?;
        let greeted = process
            .send(&Setup { rules: *rules })
            .and_then(|()| process.flush())
            .and_then(|()| process.greet());
        match greeted {
            Ok(sandbox) if !starter.may_use(sandbox) => Err(HostError::Unconfined(sandbox)),
            Ok(sandbox) => {
                process.expect_nothing();
                Ok(Ok(Self {
                    process,
                    sandbox,
                    patience: starter.workers.patience,
                    robots: [None; ROBOT_SLOTS as usize],
                    next_robot: 0,
                    mazes: HashMap::new(),
                    next_maze: 0,
                }))
            }
            Err(error) => Ok(Err(process.bury(&error))),
        }
    }

    fn has(&self, robot: &Digest) -> bool {
        self.robots.iter().flatten().any(|known| known == robot)
    }

    fn slot_of(&self, robot: &Digest) -> Option<u16> {
        let slot = self
            .robots
            .iter()
            .position(|known| known.as_ref() == Some(robot))?;
        u16::try_from(slot).ok()
    }

    /// Has it load a robot, unless it has it.
    pub(super) fn load(&mut self, robot: &Digest, code: &Code) -> io::Result<Option<Loaded>> {
        if self.has(robot) {
            return Ok(None);
        }
        let slot = self.next_robot;
        self.next_robot = (slot + 1) % ROBOT_SLOTS;
        self.robots[usize::from(slot)] = None;
        self.process.expect_within(LOAD_TIME_MAX);
        self.process.send(&Request::Robot {
            slot,
            length: code.length,
            code: code.digest,
            component: *robot,
        })?;
        code.send(self.process.writer())?;
        self.process.flush()?;
        let loaded = self.process.receive()?;
        self.process.expect_nothing();
        if matches!(loaded, Loaded::Ready(_)) {
            self.robots[usize::from(slot)] = Some(*robot);
        }
        Ok(Some(loaded))
    }

    /// Has it play matches of a robot that it has, and hands over its answers one by
    /// one, in order.
    pub(super) fn play(
        &mut self,
        robot: &Digest,
        games: &[Game<'_>],
        full: bool,
        each: &mut dyn FnMut(Answers) -> io::Result<()>,
    ) -> io::Result<()> {
        let missing = || io::Error::other("the robot is not loaded");
        let robot = self.slot_of(robot).ok_or_else(missing)?;
        let mut orders = Vec::with_capacity(games.len());
        for game in games {
            orders.push(GameOrder {
                maze: self.maze(game)?,
                seed: game.seed,
                setting: game.setting,
            });
        }
        self.process.send(&Request::Play(Batch {
            robot,
            full,
            games: orders,
        }))?;
        self.process.expect_within(self.patience);
        self.process.flush()?;
        for _ in games {
            let answers = self.process.receive()?;
            // For the next match; they come in groups.
            self.process.expect_within(self.patience);
            each(answers)?;
        }
        self.process.expect_nothing();
        Ok(())
    }

    /// The slot of the game's maze, which is sent when it is new.
    fn maze(&mut self, game: &Game<'_>) -> io::Result<u16> {
        let bytes = game.maze.identity_bytes();
        if let Some(slot) = self.mazes.get(&bytes) {
            return Ok(*slot);
        }
        let slot = self.next_maze;
        self.next_maze = (slot + 1) % MAZE_SLOTS;
        self.mazes.retain(|_, taken| *taken != slot);
        self.process.send(&Request::Maze {
            slot,
            bytes: bytes.clone(),
        })?;
        self.mazes.insert(bytes, slot);
        Ok(slot)
    }

    /// Ends it after `error` and tells how it ended.
    pub(super) fn bury(self, error: &io::Error) -> Death {
        self.process.bury(error)
    }
}
