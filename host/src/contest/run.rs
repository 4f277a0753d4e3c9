//! [`Contest`]: what is played, and playing it on many threads.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};

use crate::maze::Maze;
use crate::maze::omniscient_floor;
use crate::robot::{
    Digest, Game, HostError, Outcome, Player, Record, Recorder, Referee, Refusal, STACK_BYTES,
};
use crate::sim::{Ruleset, Score};

/// Matches that a thread plays in a row, at most: what a worker process gets in one
/// message.
const ROW_MAX: usize = 64;

/// Rows for each thread, at least, so that all end at about the same time.
const ROWS_PER_THREAD: usize = 8;

/// A robot that takes part, or was meant to.
#[derive(Clone)]
pub struct Entrant {
    /// What the standings call it.
    pub name: String,
    /// The digest of the file that was submitted.
    pub digest: Digest,
    /// The variant of the robot.
    pub setting: u32,
    /// The admitted robot, or why it plays no match.
    pub admission: Result<Arc<Player>, Arc<Refusal>>,
}

/// A maze with its name and what a robot that knows it would score.
#[derive(Clone, Debug)]
pub struct ContestMaze {
    /// What results call it.
    pub name: String,
    /// The maze.
    pub maze: Maze,
    /// The digest of [`Maze::identity_bytes`].
    pub digest: Digest,
    /// The score of the optimal path, a reset, and the optimal path again;
    /// `None` when the goal cannot be reached.
    pub floor: Option<Score>,
}

impl ContestMaze {
    /// A maze with its digest and floor under these rules.
    pub fn new(name: String, maze: Maze, rules: &Ruleset) -> Self {
        let floor = omniscient_floor(&maze, rules.longest_move).map(|floor| {
            Score::new(
                floor.speed_steps,
                floor.exploration_steps,
                rules.exploration_divisor,
            )
        });
        Self {
            name,
            digest: Digest::of(&maze.identity_bytes()),
            maze,
            floor,
        }
    }
}

/// Every entrant in every maze with every seed.
///
/// The order of matches is entrants, then mazes, then seeds. Refused entrants
/// play none.
pub struct Contest {
    /// Who plays.
    pub entrants: Vec<Entrant>,
    /// Where.
    pub mazes: Vec<ContestMaze>,
    /// With which seeds; each seed is the same in every maze.
    pub seeds: Vec<u64>,
    /// By which rules.
    pub rules: Ruleset,
}

/// A match that is to be played.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pairing {
    /// Index into [`Contest::entrants`].
    pub entrant: usize,
    /// Index into [`Contest::mazes`].
    pub maze: usize,
    /// The seed, which need not be one of [`Contest::seeds`].
    pub seed: u64,
}

/// What came of one match.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MatchResult {
    /// Index into [`Contest::entrants`].
    pub entrant: usize,
    /// Index into [`Contest::mazes`].
    pub maze: usize,
    /// The seed.
    pub seed: u64,
    /// How it ended.
    pub outcome: Outcome,
    /// The digest of the trace.
    pub trace: Digest,
    /// Entries that the robot's journal has, and that were dropped from it.
    pub journal: (u64, u64),
}

/// A match that the host could not play, even when tried again. It says nothing
/// about the robot, counts for nothing, and has to be played another time.
#[derive(Debug)]
pub struct FailedMatch {
    /// Index into [`Contest::entrants`].
    pub entrant: usize,
    /// Index into [`Contest::mazes`].
    pub maze: usize,
    /// The seed.
    pub seed: u64,
    /// What went wrong.
    pub error: HostError,
}

/// What has been played of a contest, in the contest's order.
#[derive(Debug, Default)]
pub struct Played {
    /// The results.
    pub results: Vec<MatchResult>,
    /// The failures of the host.
    pub failed: Vec<FailedMatch>,
}

/// Told about every match as it ends, from any thread, in any order.
pub type Progress<'a> = dyn Fn() + Sync + 'a;

/// Why a contest did not end.
#[derive(Debug, thiserror::Error)]
pub enum ContestError {
    /// The threads could not be started.
    #[error("failed to start {threads} threads: {reason}")]
    Threads {
        /// How many.
        threads: usize,
        /// What the operating system said.
        reason: String,
    },
}

impl Contest {
    /// How many matches will be played.
    pub fn matches(&self) -> usize {
        let admitted = self
            .entrants
            .iter()
            .filter(|entrant| entrant.admission.is_ok());
        admitted.count() * self.mazes.len() * self.seeds.len()
    }

    /// All matches, in the contest's order.
    pub fn pairings(&self) -> Vec<Pairing> {
        let mut pairings = Vec::with_capacity(self.matches());
        for (entrant, Entrant { admission, .. }) in self.entrants.iter().enumerate() {
            if admission.is_err() {
                continue;
            }
            for maze in 0..self.mazes.len() {
                pairings.extend(self.seeds.iter().map(|&seed| Pairing {
                    entrant,
                    maze,
                    seed,
                }));
            }
        }
        pairings
    }

    /// Plays all matches on `threads` threads (at least 1). When `cancelled`
    /// becomes true, matches that have not begun are left out.
    ///
    /// # Errors
    ///
    /// When the threads cannot be started.
    pub fn run(
        &self,
        referee: &Referee,
        threads: usize,
        cancelled: &AtomicBool,
        progress: &Progress<'_>,
    ) -> Result<Played, ContestError> {
        self.run_only(&self.pairings(), referee, threads, cancelled, progress)
    }

    /// Plays these matches as [`Contest::run`] plays all, and returns what came of
    /// them in their order. Those of refused entrants are left out.
    ///
    /// # Errors
    ///
    /// When the threads cannot be started.
    pub fn run_only(
        &self,
        pairings: &[Pairing],
        referee: &Referee,
        threads: usize,
        cancelled: &AtomicBool,
        progress: &Progress<'_>,
    ) -> Result<Played, ContestError> {
        let threads = threads.max(1);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .stack_size(STACK_BYTES)
            .thread_name(|index| format!("matches-{index}"))
            .build()
            .map_err(|error| ContestError::Threads {
                threads,
                reason: error.to_string(),
            })?;
        let rows = self.rows(pairings, threads);
        let played: Vec<Vec<Result<MatchResult, FailedMatch>>> = pool.install(|| {
            rows.into_par_iter()
                .map_init(Recorder::default, |recorder, row| {
                    if cancelled.load(Ordering::Relaxed) {
                        return Vec::new();
                    }
                    self.play(referee, &row, recorder, &mut || {
                        progress();
                        !cancelled.load(Ordering::Relaxed)
                    })
                })
                .collect()
        });
        let mut all = Played::default();
        for match_played in played.into_iter().flatten() {
            match match_played {
                Ok(result) => all.results.push(result),
                Err(failed) => all.failed.push(failed),
            }
        }
        Ok(all)
    }

    /// Plays the match of a result again and leaves its trace and journal in
    /// `recorder`; `None` when the entrant was refused.
    ///
    /// Matches are reproducible, so results need not carry their traces.
    ///
    /// # Errors
    ///
    /// When the host fails.
    pub fn replay(
        &self,
        referee: &Referee,
        result: &MatchResult,
        recorder: &mut Recorder,
    ) -> Result<Option<Outcome>, HostError> {
        let Ok(player) = &self.entrants[result.entrant].admission else {
            return Ok(None);
        };
        let game = self.game_of(result);
        referee.record(player, &game, recorder).map(Some)
    }

    /// The match of a result.
    pub fn game_of(&self, result: &MatchResult) -> Game<'_> {
        self.game(&result.pairing())
    }

    fn game(&self, pairing: &Pairing) -> Game<'_> {
        Game {
            maze: &self.mazes[pairing.maze].maze,
            rules: &self.rules,
            seed: pairing.seed,
            setting: self.entrants[pairing.entrant].setting,
        }
    }

    /// Matches in their order, cut into rows of one entrant each.
    fn rows<'a>(&'a self, pairings: &'a [Pairing], threads: usize) -> Vec<Row<'a>> {
        let length = pairings.len() / (threads * ROWS_PER_THREAD);
        let length = length.clamp(1, ROW_MAX);
        let mut rows = Vec::new();
        for own in pairings.chunk_by(|a, b| a.entrant == b.entrant) {
            let Ok(player) = &self.entrants[own[0].entrant].admission else {
                continue;
            };
            rows.extend(own.chunks(length).map(|pairings| Row { player, pairings }));
        }
        rows
    }

    fn play(
        &self,
        referee: &Referee,
        row: &Row<'_>,
        recorder: &mut Recorder,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Vec<Result<MatchResult, FailedMatch>> {
        let games: Vec<Game<'_>> = row.pairings.iter().map(|it| self.game(it)).collect();
        let mut pairings = row.pairings.iter();
        let mut played = Vec::with_capacity(games.len());
        let _ = referee.play(row.player, &games, recorder, &mut |record| {
            let pairing = pairings.next().expect("a record for each game");
            played.push(match record {
                Ok(record) => Ok(MatchResult::new(pairing, record)),
                Err(error) => Err(FailedMatch {
                    entrant: pairing.entrant,
                    maze: pairing.maze,
                    seed: pairing.seed,
                    error,
                }),
            });
            if goes_on() {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        played
    }
}

impl MatchResult {
    /// Which match it is.
    pub const fn pairing(&self) -> Pairing {
        Pairing {
            entrant: self.entrant,
            maze: self.maze,
            seed: self.seed,
        }
    }

    fn new(pairing: &Pairing, record: Record) -> Self {
        Self {
            entrant: pairing.entrant,
            maze: pairing.maze,
            seed: pairing.seed,
            outcome: record.outcome,
            trace: record.trace,
            journal: record.journal,
        }
    }
}

impl FailedMatch {
    /// Which match it is.
    pub const fn pairing(&self) -> Pairing {
        Pairing {
            entrant: self.entrant,
            maze: self.maze,
            seed: self.seed,
        }
    }
}

/// Matches of one entrant to be played one after the other.
struct Row<'a> {
    player: &'a Player,
    pairings: &'a [Pairing],
}
