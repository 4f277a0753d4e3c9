//! [`Contest`]: what is played, and playing it on many threads.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};

use crate::maze::Maze;
use crate::maze::omniscient_floor;
use crate::robot::{Digest, Game, Host, HostError, Outcome, Recorder, Refusal, Robot};
use crate::sim::{Ruleset, Score};

/// Stack of the threads that run robots, in bytes: wasm gets its own limit of
/// it, and wasmtime needs room for itself beyond that.
const STACK_BYTES: usize = 8 << 20;

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
    pub admission: Result<Arc<Robot>, Arc<Refusal>>,
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

    /// Plays all matches on `threads` threads (at least 1). When `cancelled`
    /// becomes true, matches that have not begun are left out.
    ///
    /// # Errors
    ///
    /// When the threads cannot be started.
    pub fn run(
        &self,
        host: &Host,
        threads: usize,
        cancelled: &AtomicBool,
        progress: &Progress<'_>,
    ) -> Result<Played, ContestError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads.max(1))
            .stack_size(STACK_BYTES)
            .thread_name(|index| format!("matches-{index}"))
            .build()
            .map_err(|error| ContestError::Threads {
                threads,
                reason: error.to_string(),
            })?;
        let plan = self.plan();
        let played: Vec<Result<MatchResult, FailedMatch>> = pool.install(|| {
            plan.into_par_iter()
                .map_init(Recorder::default, |recorder, planned| {
                    if cancelled.load(Ordering::Relaxed) {
                        return None;
                    }
                    let played = self.play_twice(host, &planned, recorder);
                    progress();
                    Some(played)
                })
                .flatten()
                .collect()
        });
        let mut all = Played::default();
        for match_played in played {
            match match_played {
                Ok(result) => all.results.push(result),
                Err(failed) => all.failed.push(failed),
            }
        }
        Ok(all)
    }

    /// Plays a match, and once more when the host fails: most failures, such as
    /// a machine that stood still, do not repeat.
    fn play_twice(
        &self,
        host: &Host,
        planned: &Planned<'_>,
        recorder: &mut Recorder,
    ) -> Result<MatchResult, FailedMatch> {
        self.play(host, planned, recorder)
            .or_else(|_| self.play(host, planned, recorder))
            .map_err(|error| FailedMatch {
                entrant: planned.entrant,
                maze: planned.maze,
                seed: planned.seed,
                error,
            })
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
        host: &Host,
        result: &MatchResult,
        recorder: &mut Recorder,
    ) -> Result<Option<Outcome>, HostError> {
        let Ok(robot) = &self.entrants[result.entrant].admission else {
            return Ok(None);
        };
        let game = self.game(result.entrant, result.maze, result.seed);
        host.play(robot, &game, recorder).map(Some)
    }

    fn game(&self, entrant: usize, maze: usize, seed: u64) -> Game<'_> {
        Game {
            maze: &self.mazes[maze].maze,
            rules: &self.rules,
            seed,
            setting: self.entrants[entrant].setting,
        }
    }

    fn plan(&self) -> Vec<Planned<'_>> {
        let mut plan = Vec::with_capacity(self.matches());
        for (entrant, Entrant { admission, .. }) in self.entrants.iter().enumerate() {
            let Ok(robot) = admission else { continue };
            for maze in 0..self.mazes.len() {
                for &seed in &self.seeds {
                    plan.push(Planned {
                        robot,
                        entrant,
                        maze,
                        seed,
                    });
                }
            }
        }
        plan
    }

    fn play(
        &self,
        host: &Host,
        planned: &Planned<'_>,
        recorder: &mut Recorder,
    ) -> Result<MatchResult, HostError> {
        let &Planned {
            robot,
            entrant,
            maze,
            seed,
        } = planned;
        let game = self.game(entrant, maze, seed);
        let outcome = host.play(robot, &game, recorder)?;
        let kept = u64::try_from(recorder.journal.len()).unwrap_or(u64::MAX);
        Ok(MatchResult {
            entrant,
            maze,
            seed,
            outcome,
            trace: Digest::of(&recorder.trace.identity_bytes()),
            journal: (kept, recorder.journal.dropped()),
        })
    }
}

/// One match to be played.
struct Planned<'a> {
    robot: &'a Robot,
    entrant: usize,
    maze: usize,
    seed: u64,
}
