//! [`run`]: plays a plan on many threads.
//!
//! Threads take batches of one player each. Batches are cut from blocks of consecutive mazes
//! and seeds, block after block, so a contest of a million matches needs the memory of a few
//! blocks; mazes are generated and solved by the thread that needs them first. Matches end in
//! any order and reach the sink in the order of the plan.
//!
//! A robot that turns out to be slow plays last: its batches are put off, match by match, until
//! there is nothing else to play or the threads would have to wait. So is a match that did not
//! end in time, which is played once more. A robot that is [withdrawn](wasmouse_engine::Account::withdrawal)
//! plays no more.

use std::collections::VecDeque;
use std::io;
use std::ops::{ControlFlow, Range};
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::Duration;

use wasmouse_core::game::SandboxLimits;
use wasmouse_core::record::{MatchKey, MatchSpec};
use wasmouse_engine::{Executor, InfrastructureError, Played, STACK_BYTES, time_factor};

use super::maze_source::ContestMaze;
use super::plan::{KeyParts, Plan, Player};
use super::sink::{ContestMatch, Ended, MatchFailure, Sink};

/// Matches of one player that a thread takes at once, at most.
const BATCH_MAX: usize = 64;

/// Batches for each thread, at least, so that all end at about the same time.
const BATCHES_PER_JOB: usize = 8;

/// Matches in a batch of the last block, at least, unless a contest has few: a batch takes a message
/// to a worker.
const LAST_BATCH_MIN: usize = 8;

/// Matches in a block, at most.
const BLOCK_MATCHES_MAX: usize = 4096;

/// Mazes and seeds in a block, at most.
const BLOCK_ROWS_MAX: usize = 256;

/// How many blocks the threads may be ahead of the first one that is not complete.
const BLOCKS_AHEAD: usize = 8;

/// Processor time that a robot may use in a contest of that many matches of its own, by default.
/// All the fuel of a match lasts 1 to 2 s in a robot like flood, so such a robot never reaches it;
/// one that uses all its fuel ten times as slowly does after some ten matches. Limits with more
/// fuel have as many times more time.
pub const fn default_robot_time(matches: u64, limits: &SandboxLimits) -> Duration {
    let seconds = 300_u64.saturating_add(matches.saturating_mul(2));
    Duration::from_secs(seconds.saturating_mul(time_factor(limits)))
}

/// Takes a match that has ended, with its maze. Both are shared, so keeping them copies nothing.
pub type OnEnded<'a> = dyn Fn(&Arc<ContestMaze>, &Arc<Ended>) -> io::Result<()> + Sync + 'a;

/// How a contest is run.
pub struct Options<'a> {
    /// Threads, or as many of them as the system can start. Range: at least 1.
    pub jobs: usize,
    /// When this becomes true, matches that have not begun are left out.
    pub cancelled: &'a AtomicBool,
    /// Which matches to play: all, or those that are missing somewhere.
    pub wanted: &'a (dyn Fn(&MatchKey) -> bool + Sync),
    /// Called for every match as it ends, with its maze: from any thread and in any order, so that
    /// what has ended can be stored or shown before matches that come first in the plan. The
    /// contest ends when it fails.
    pub ended: &'a OnEnded<'a>,
    /// Processor time that each robot may use, in all its variants together; `None` is
    /// [`default_robot_time`].
    pub robot_time: Option<Duration>,
}

/// Why a contest did not come to its end.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Not even one thread could be started.
    #[error("failed to start a thread: {0}")]
    Thread(io::Error),
    /// A sink could not go on.
    #[error("failed to store results: {0}")]
    Sink(io::Error),
}

/// Plays a plan.
///
/// # Errors
///
/// When no thread can be started or the sink fails. What the sink has received by then
/// stands.
pub fn run(
    plan: &Plan,
    executor: &dyn Executor,
    options: &Options<'_>,
    sink: &mut dyn Sink,
) -> Result<(), RunError> {
    let players = plan.players();
    let jobs = options.jobs.max(1);
    let rows = plan.mazes.len() as u64 * u64::from(plan.seeds.count);
    if players.is_empty() || rows == 0 {
        return Ok(());
    }
    set_budgets(&players, rows, options.robot_time, &plan.rules.sandbox);
    let block_rows = (BLOCK_MATCHES_MAX / players.len()).clamp(1, BLOCK_ROWS_MAX);
    let batch = plan.matches() / (jobs * BATCHES_PER_JOB) as u64;
    let batch = usize::try_from(batch).unwrap_or(BATCH_MAX);
    let run = Run {
        plan,
        players: &players,
        parts: plan.key_parts(),
        executor,
        options,
        jobs,
        rows,
        block_rows: block_rows as u64,
        batch: batch.clamp(1, BATCH_MAX),
        state: Mutex::new(State::default()),
        changed: Condvar::new(),
        sink: Mutex::new(Emitter {
            sink,
            last_maze: None,
        }),
    };
    thread::scope(|scope| {
        for job in 0..jobs {
            let started = thread::Builder::new()
                .name(format!("matches-{job}"))
                .stack_size(STACK_BYTES)
                .spawn_scoped(scope, || run.work());
            // Where there is no room for all threads, those that have started play everything.
            if let Err(error) = started {
                if job == 0 {
                    run.fail(RunError::Thread(error));
                }
                break;
            }
        }
    });
    run.finish()
}

/// Sets the budget of each robot.
fn set_budgets(
    players: &[Player],
    rows: u64,
    robot_time: Option<Duration>,
    limits: &SandboxLimits,
) {
    for player in players {
        let robot = player.robot.digest();
        let variants = players.iter().filter(|it| it.robot.digest() == robot);
        let matches = rows.saturating_mul(variants.count() as u64);
        let budget = robot_time.unwrap_or_else(|| default_robot_time(matches, limits));
        player.robot.account().set_budget(budget);
    }
}

/// A contest in progress.
struct Run<'a> {
    plan: &'a Plan,
    players: &'a [Player],
    parts: KeyParts,
    executor: &'a dyn Executor,
    options: &'a Options<'a>,
    jobs: usize,
    /// Mazes times seeds: one row is one maze with one seed, for all players.
    rows: u64,
    block_rows: u64,
    /// Rows in a batch.
    batch: usize,
    state: Mutex<State>,
    /// Signalled when a block was emitted, or the run failed.
    changed: Condvar,
    /// Locked only while `state` is locked too, or by the thread that took a block from it.
    sink: Mutex<Emitter<'a>>,
}

#[derive(Default)]
struct State {
    /// Blocks that are in progress, in order; the first one is emitted next.
    blocks: VecDeque<Arc<Block>>,
    /// Rows that are in blocks already.
    begun: u64,
    /// Batches of the last block that are not taken yet, last one first.
    batches: Vec<Batch>,
    /// Single matches of slow robots, and those that did not end in time.
    put_off: VecDeque<(Arc<Block>, Batch)>,
    error: Option<RunError>,
}

/// Consecutive rows.
struct Block {
    rows: Range<u64>,
    first_maze: usize,
    mazes: Vec<OnceLock<Arc<ContestMaze>>>,
    slots: Mutex<Slots>,
}

/// What came of the matches of a block.
struct Slots {
    /// By row, then by player; `None` while a match is not played.
    matches: Vec<Option<Arc<Ended>>>,
    /// Batches that have not ended.
    batches_left: usize,
}

/// Rows of one player, relative to the block.
struct Batch {
    player: usize,
    rows: Range<usize>,
    /// Whether it is a match that did not end in time before.
    is_again: bool,
}

impl Batch {
    /// Its matches, one by one.
    fn singly(&self) -> impl Iterator<Item = Self> {
        let (player, is_again) = (self.player, self.is_again);
        self.rows.clone().map(move |row| Self {
            player,
            rows: row..row + 1,
            is_again,
        })
    }
}

/// What came of a batch.
struct PlayedBatch {
    /// By row; `None` for what is not wanted, was not played, or is put off.
    ended: Vec<Option<Arc<Ended>>>,
    put_off: Vec<Batch>,
}

struct Emitter<'a> {
    sink: &'a mut dyn Sink,
    last_maze: Option<usize>,
}

impl Run<'_> {
    /// Plays batches until there are none.
    fn work(&self) {
        while let Some((block, batch)) = self.take() {
            let PlayedBatch { ended, put_off } = self.play(&block, &batch);
            {
                let mut state = lock(&self.state);
                let mut slots = lock(&block.slots);
                for (row, ended) in batch.rows.clone().zip(ended) {
                    if ended.is_some() {
                        slots.matches[row * self.players.len() + batch.player] = ended;
                    }
                }
                slots.batches_left += put_off.len();
                slots.batches_left -= 1;
                let put_off = put_off.into_iter().map(|it| (Arc::clone(&block), it));
                state.put_off.extend(put_off);
            }
            self.changed.notify_all();
            self.emit_complete();
        }
    }

    fn is_cancelled(&self) -> bool {
        self.options.cancelled.load(Ordering::Relaxed)
    }

    /// The next batch with its block; waits while the threads are too far ahead.
    fn take(&self) -> Option<(Arc<Block>, Batch)> {
        let mut state = lock(&self.state);
        loop {
            if state.error.is_some() || self.is_cancelled() {
                return None;
            }
            if let Some(batch) = state.batches.pop() {
                let block = state.blocks.back().map(Arc::clone);
                let block = block.expect("batches belong to the last block");
                if !self.is_put_off(batch.player) {
                    return Some((block, batch));
                }
                lock(&block.slots).batches_left += batch.rows.len() - 1;
                let singly = batch.singly().map(|it| (Arc::clone(&block), it));
                state.put_off.extend(singly);
            } else if state.begun < self.rows && state.blocks.len() < BLOCKS_AHEAD {
                self.begin_block(&mut state);
            } else if let Some(single) = state.put_off.pop_front() {
                return Some(single);
            } else if state.begun == self.rows {
                return None;
            } else {
                state = self
                    .changed
                    .wait(state)
                    .unwrap_or_else(PoisonError::into_inner);
            }
        }
    }

    /// Whether a player's matches are put off. Those of one that was withdrawn end at once.
    fn is_put_off(&self, player: usize) -> bool {
        let account = self.players[player].robot.account();
        account.is_slow() && account.withdrawal().is_none()
    }

    fn begin_block(&self, state: &mut State) {
        let rows = state.begun..self.rows.min(state.begun + self.block_rows);
        state.begun = rows.end;
        let length = usize::try_from(rows.end - rows.start).expect("a block is small");
        let (first, last) = (self.maze_of(rows.start), self.maze_of(rows.end - 1));
        let batch = if rows.end == self.rows {
            self.last_batch(length)
        } else {
            self.batch
        };
        // The threads begin in different mazes, so that each prepares its own.
        let starts: Vec<usize> = (0..length).step_by(batch).collect();
        for group in starts.chunks(self.jobs) {
            for player in 0..self.players.len() {
                state.batches.extend(group.iter().map(|&start| Batch {
                    player,
                    rows: start..length.min(start + batch),
                    is_again: false,
                }));
            }
        }
        state.batches.reverse();
        let matches = length * self.players.len();
        state.blocks.push_back(Arc::new(Block {
            rows,
            first_maze: first,
            mazes: (first..=last).map(|_| OnceLock::new()).collect(),
            slots: Mutex::new(Slots {
                matches: (0..matches).map(|_| None).collect(),
                batches_left: state.batches.len(),
            }),
        }));
    }

    /// Rows in a batch of the last block, which has that many: fewer than elsewhere, so that all
    /// threads end at about the same time.
    fn last_batch(&self, rows: usize) -> usize {
        let matches = rows * self.players.len();
        let batch = matches / (self.jobs * BATCHES_PER_JOB);
        self.batch.min(batch.max(LAST_BATCH_MIN))
    }

    /// The maze of a row, as an index into the plan's.
    fn maze_of(&self, row: u64) -> usize {
        let maze = row / u64::from(self.plan.seeds.count);
        usize::try_from(maze).expect("there are as many mazes as fit memory")
    }

    fn seed_of(&self, row: u64) -> u64 {
        let position = row % u64::from(self.plan.seeds.count);
        let position = u32::try_from(position).expect("a remainder of a u32");
        self.plan.seeds.get(position)
    }

    fn maze<'a>(&self, block: &'a Block, row: u64) -> &'a Arc<ContestMaze> {
        let index = self.maze_of(row);
        block.mazes[index - block.first_maze]
            .get_or_init(|| Arc::new(self.plan.mazes[index].prepare(&self.plan.rules.game)))
    }

    /// Plays a batch. When everything is cancelled, what was not played is left out.
    fn play(&self, block: &Block, batch: &Batch) -> PlayedBatch {
        let player = &self.players[batch.player];
        let first = block.rows.start;
        let mut rows = Vec::with_capacity(batch.rows.len());
        let mut specs = Vec::with_capacity(batch.rows.len());
        for row in batch.rows.clone() {
            let row_in_plan = first + row as u64;
            let maze = self.maze(block, row_in_plan);
            let seed = self.seed_of(row_in_plan);
            let spec = self.plan.spec(self.parts, player, maze, seed);
            if (self.options.wanted)(&spec.key) {
                rows.push(row);
                specs.push(spec);
            }
        }
        let mut played = PlayedBatch {
            ended: batch.rows.clone().map(|_| None).collect(),
            put_off: Vec::new(),
        };
        let single = |row: usize, is_again| Batch {
            player: batch.player,
            rows: row..row + 1,
            is_again,
        };
        let mut done = 0;
        let mut sink = |spec: &MatchSpec, result: Result<Played<'_>, InfrastructureError>| {
            let row = rows[done];
            done += 1;
            match self.ended(batch, spec, result) {
                Some(ended) => {
                    let ended = Arc::new(ended);
                    self.report(self.maze(block, first + row as u64), &ended);
                    played.ended[row - batch.rows.start] = Some(ended);
                }
                None => played.put_off.push(single(row, true)),
            }
            if self.is_cancelled() || self.is_put_off(batch.player) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        // A bug that a robot may bring about costs this match, and not the contest.
        let outcome = panic::catch_unwind(AssertUnwindSafe(|| {
            self.executor.execute(&player.robot, &specs, &mut sink)
        }));
        if outcome.is_err()
            && let (Some(&row), Some(spec)) = (rows.get(done), specs.get(done))
        {
            done += 1;
            let ended = Arc::new(Ended::Failed(MatchFailure {
                key: spec.key,
                reason: "wasmouse panicked, which is a bug".into(),
            }));
            self.report(self.maze(block, first + row as u64), &ended);
            played.ended[row - batch.rows.start] = Some(ended);
        }
        if !self.is_cancelled() {
            let rest = rows.get(done..).unwrap_or_default();
            played
                .put_off
                .extend(rest.iter().map(|&row| single(row, batch.is_again)));
        }
        played
    }

    /// What came of a match; `None` when it is to be played again.
    fn ended(
        &self,
        batch: &Batch,
        spec: &MatchSpec,
        played: Result<Played<'_>, InfrastructureError>,
    ) -> Option<Ended> {
        let failure = |reason: String| MatchFailure {
            key: spec.key,
            reason: reason.into(),
        };
        match played {
            Ok(played) => Some(Ended::Played(ContestMatch {
                player: batch.player,
                record: played.record,
                transcript: played.transcript.clone(),
            })),
            Err(InfrastructureError::Withdrawn(reason)) => {
                Some(Ended::Withdrawn(failure(reason.to_string())))
            }
            Err(error) if error.is_stall() && !batch.is_again => None,
            Err(error) => Some(Ended::Failed(failure(error.to_string()))),
        }
    }

    /// Emits the blocks at the front that are complete.
    fn emit_complete(&self) {
        let mut state = lock(&self.state);
        while let Some(block) = state.blocks.front() {
            let is_last = state.blocks.len() == 1;
            if lock(&block.slots).batches_left > 0 || (is_last && !state.batches.is_empty()) {
                return;
            }
            let block = state.blocks.pop_front().expect("there is a first one");
            // The order of blocks is kept, because the sink is taken before the state is
            // given back.
            let mut emitter = lock(&self.sink);
            drop(state);
            let emitted = self.emit(&block, &mut emitter);
            drop(emitter);
            self.changed.notify_all();
            state = lock(&self.state);
            if let Err(error) = emitted {
                state.error.get_or_insert(RunError::Sink(error));
                return;
            }
        }
    }

    fn emit(&self, block: &Block, emitter: &mut Emitter<'_>) -> io::Result<()> {
        let matches = std::mem::take(&mut lock(&block.slots).matches);
        for (position, ended) in matches.into_iter().enumerate() {
            let Some(ended) = ended else { continue };
            let row = block.rows.start + (position / self.players.len()) as u64;
            let maze = self.maze_of(row);
            if emitter.last_maze != Some(maze) {
                emitter.last_maze = Some(maze);
                emitter.sink.maze(self.maze(block, row))?;
            }
            match &*ended {
                Ended::Played(played) => emitter.sink.played(played)?,
                Ended::Failed(failure) => emitter.sink.failed(failure)?,
                Ended::Withdrawn(failure) => emitter.sink.withdrawn(failure)?,
            }
        }
        Ok(())
    }

    /// Tells the one who asked for it that a match has ended.
    fn report(&self, maze: &Arc<ContestMaze>, ended: &Arc<Ended>) {
        if let Err(error) = (self.options.ended)(maze, ended) {
            self.fail(RunError::Sink(error));
        }
    }

    fn fail(&self, error: RunError) {
        lock(&self.state).error.get_or_insert(error);
        self.changed.notify_all();
    }

    /// Emits what is left of a contest that was cancelled.
    fn finish(self) -> Result<(), RunError> {
        let state = std::mem::take(&mut *lock(&self.state));
        if let Some(error) = state.error {
            return Err(error);
        }
        let mut emitter = lock(&self.sink);
        state
            .blocks
            .iter()
            .try_for_each(|block| self.emit(block, &mut emitter))
            .map_err(RunError::Sink)
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Nothing that holds a lock panics half-way.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
