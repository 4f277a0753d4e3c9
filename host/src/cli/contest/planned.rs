//! [`PlannedContest`]: the matches of a contest file, and which of them are left to play.

use std::collections::{HashMap, HashSet};
use std::path::Path;
use std::sync::Arc;

use wasmouse_core::game::Ruleset;
use wasmouse_core::record::MatchKey;
use wasmouse_core::{Digest, GuestText};
use wasmouse_engine::admission::Rejection;
use wasmouse_engine::{AdmissionLimits, engine_id};

use super::super::failure::Failure;
use super::super::store_failure::store_failure;
use super::load::ContestFolder;
use super::resolve::{self, Resolved, ResolvedRobot};
use super::shard::Shard;
use crate::contest::{Entrant, MatrixRobot, MazeSet, MazeSource, NotAdmitted, ScoreMatrix, Seeds};
use crate::store::{Cause, MatchKeys, MatrixRequest, Missing, Store, StoreError};

/// A contest file with everything that it names, found and digested.
pub struct PlannedContest {
    /// The contest file.
    pub folder: ContestFolder,
    /// The robots.
    pub robots: Vec<PlannedRobot>,
    /// The sets of mazes.
    pub sets: Vec<MazeSet>,
    /// The mazes, by set, each with the index of its set.
    pub mazes: Vec<(MazeSource, usize)>,
    /// The rules.
    pub rules: Arc<Ruleset>,
    /// The seeds of every maze.
    pub seeds: Seeds,
}

/// A robot of a contest.
pub struct PlannedRobot {
    /// Where it is, and what it is called.
    pub robot: ResolvedRobot,
    /// The digest of its file.
    pub digest: Digest,
}

impl PlannedRobot {
    /// What match keys call it.
    pub const fn player(&self) -> (Digest, u32) {
        (self.digest, self.robot.spec.variant())
    }
}

/// What a store does not have of a contest, and is to be played.
pub struct Left {
    /// Of the mazes whose digests are known.
    missing: Missing,
    known: HashSet<Digest>,
    /// Matches of robots that were withdrawn: for the organiser to decide.
    withdrawn: HashSet<MatchKey>,
    /// The mazes with matches to play, as indices.
    pub mazes: Vec<usize>,
    /// The robots with matches to play, as indices.
    pub robots: Vec<usize>,
    /// How many matches there are to play.
    pub matches: u64,
    /// How many there are to play of each robot, by file and variant.
    by_player: HashMap<(Digest, u32), u64>,
}

impl Left {
    /// Whether a match is to be played.
    pub fn wants(&self, key: &MatchKey) -> bool {
        if self.known.contains(&key.maze) {
            self.missing.contains(key) && !self.withdrawn.contains(key)
        } else {
            true
        }
    }

    /// How many matches there are to play of the entrants that were admitted.
    pub fn playable(&self, entrants: &[Entrant]) -> u64 {
        let admitted = entrants.iter().filter(|it| it.admission.is_ok());
        self.of(admitted.map(|it| (it.digest, it.variant)))
    }

    /// How many matches there are to play of the robots that are not rejected, as far as the store
    /// knows.
    pub fn not_rejected(&self, matrix: &ScoreMatrix) -> u64 {
        let admitted = matrix.robots.iter().filter(|it| it.not_admitted.is_none());
        self.of(admitted.map(|it| (it.digest, it.variant)))
    }

    fn of(&self, players: impl Iterator<Item = (Digest, u32)>) -> u64 {
        let players: HashSet<(Digest, u32)> = players.collect();
        let matches = players.iter().filter_map(|it| self.by_player.get(it));
        matches.sum()
    }
}

impl PlannedContest {
    /// Reads a contest file, and finds and reads everything that it names.
    ///
    /// # Errors
    ///
    /// As [`resolve::resolve`], and when a robot cannot be read.
    pub fn read(file: &Path) -> Result<Self, Failure> {
        let folder = ContestFolder::read(file)?;
        let Resolved {
            robots,
            sets,
            rules,
            seeds,
        } = resolve::resolve(&folder)?;
        let bytes_max = AdmissionLimits::default().component_bytes_max;
        let mut planned = Vec::with_capacity(robots.len());
        for robot in robots {
            let digest = Digest::of(&robot.spec.read(bytes_max)?);
            planned.push(PlannedRobot { robot, digest });
        }
        let mut mazes = Vec::new();
        let mut maze_sets = Vec::with_capacity(sets.len());
        for (index, set) in sets.into_iter().enumerate() {
            mazes.extend(set.mazes.into_iter().map(|maze| (maze, index)));
            maze_sets.push(set.set);
        }
        Ok(Self {
            folder,
            robots: planned,
            sets: maze_sets,
            mazes,
            rules,
            seeds,
        })
    }

    /// The robots by file and variant, each once.
    pub fn players(&self) -> Vec<(Digest, u32)> {
        let mut seen = HashSet::new();
        let players = self.robots.iter().map(PlannedRobot::player);
        players.filter(|it| seen.insert(*it)).collect()
    }

    /// How many matches the contest has: those of robots that are not rejected, as far as the store
    /// knows.
    pub fn matches(&self, matrix: &ScoreMatrix) -> u64 {
        let admitted = matrix.robots.iter().filter(|it| it.not_admitted.is_none());
        let players: HashSet<(Digest, u32)> = admitted.map(|it| (it.digest, it.variant)).collect();
        players.len() as u64 * self.mazes.len() as u64 * u64::from(self.seeds.count)
    }

    /// The digests of the mazes, as far as they are known without generating mazes: a generated
    /// maze is known when it was played before.
    pub fn digests(&self, store: &Store) -> Result<Vec<Option<Digest>>, StoreError> {
        let generated = store.generated_digests()?;
        let digest = |maze: &MazeSource| match maze {
            MazeSource::Loaded { maze, .. } => Some(maze.digest()),
            MazeSource::Generated(it) => generated.get(it).copied(),
        };
        Ok(self.mazes.iter().map(|(maze, _)| digest(maze)).collect())
    }

    /// What is left to play of a shard. Matches of robots that were withdrawn are left only when
    /// they are to be tried again.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn left(&self, store: &Store, shard: Shard, tries_again: bool) -> Result<Left, Failure> {
        let digests = self.digests(store).map_err(store_failure)?;
        let known: Vec<Digest> = digests.iter().flatten().copied().collect();
        let players = self.players();
        let keys = self.keys(&players, &known);
        let missing = store.missing(&keys).map_err(store_failure)?;
        let withdrawn: HashSet<MatchKey> = if tries_again {
            HashSet::new()
        } else {
            let unplayed = store.unplayed(&keys).map_err(store_failure)?.into_iter();
            let withdrawn = unplayed.filter(|it| it.cause == Cause::Withdrawn);
            withdrawn.map(|it| it.key).collect()
        };
        let mut left = Left {
            missing,
            known: known.iter().copied().collect(),
            withdrawn,
            mazes: Vec::new(),
            robots: Vec::new(),
            matches: 0,
            by_player: HashMap::new(),
        };
        let mut plays = vec![0; players.len()];
        for (maze, digest) in digests.iter().enumerate() {
            if !shard.has(maze) {
                continue;
            }
            let before = left.matches;
            for seed in 0..self.seeds.count {
                for (player, &(robot, variant)) in players.iter().enumerate() {
                    let is_left = digest.is_none_or(|maze| {
                        left.wants(&MatchKey {
                            engine: keys.engine,
                            rules: keys.rules,
                            robot,
                            variant,
                            maze,
                            seed: self.seeds.get(seed),
                        })
                    });
                    plays[player] += u64::from(is_left);
                    left.matches += u64::from(is_left);
                }
            }
            if left.matches > before {
                left.mazes.push(maze);
            }
        }
        let plays = players.into_iter().zip(plays);
        left.by_player = plays.filter(|(_, matches)| *matches > 0).collect();
        let robots = self.robots.iter().enumerate();
        left.robots = robots
            .filter(|(_, robot)| left.by_player.contains_key(&robot.player()))
            .map(|(index, _)| index)
            .collect();
        Ok(left)
    }

    /// Why robots play no match, by their indices, as far as the store knows.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn rejections(&self, store: &Store) -> Result<Vec<Option<NotAdmitted>>, Failure> {
        let submissions = store.current_submissions().map_err(store_failure)?;
        let rejected = submissions.into_iter().filter_map(|it| {
            let rejection = Rejection::from(it.rejection?);
            Some(((it.robot, it.variant), Arc::new(rejection)))
        });
        let rejected: HashMap<(Digest, u32), Arc<Rejection>> = rejected.collect();
        let rejection = |robot: &PlannedRobot| {
            let rejection = rejected.get(&robot.player())?;
            Some(NotAdmitted::Rejected(Arc::clone(rejection)))
        };
        Ok(self.robots.iter().map(rejection).collect())
    }

    /// The results of the contest by now. `not_admitted` says why robots play no match, by their
    /// indices.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn matrix(
        &self,
        store: &Store,
        not_admitted: &[Option<NotAdmitted>],
    ) -> Result<ScoreMatrix, Failure> {
        let digests = self.digests(store).map_err(store_failure)?;
        let mazes = self.mazes.iter().zip(digests);
        let mazes: Vec<(Digest, usize)> = mazes
            .filter_map(|((_, set), digest)| Some((digest?, *set)))
            .collect();
        let robots = self.robots.iter().enumerate().map(|(index, planned)| {
            let robot = &planned.robot;
            let (digest, variant) = planned.player();
            let mut entry = MatrixRobot::new(robot.name.clone(), digest, variant);
            entry.author = robot.author.clone();
            entry.class = robot.class.clone();
            entry.not_admitted = not_admitted[index].clone();
            entry
        });
        let matrix = store.matrix(MatrixRequest {
            engine: engine_id().digest(),
            rules: &self.rules,
            robots: robots.collect(),
            mazes: &mazes,
            sets: self.sets.clone(),
            seeds: self.seeds,
        });
        let mut matrix = matrix.map_err(store_failure)?;
        self.classify(&mut matrix);
        Ok(matrix)
    }

    /// Puts robots that declare no class into the first one whose limits they keep.
    fn classify(&self, matrix: &mut ScoreMatrix) {
        if self.folder.file.classes.is_empty() {
            return;
        }
        for robot in 0..matrix.robots.len() {
            if matrix.robots[robot].class.is_some() {
                continue;
            }
            let (mut step_fuel, mut memory_bytes) = (0, 0);
            for maze in 0..matrix.mazes.len() {
                for seed in 0..matrix.seeds.count {
                    if let Some(played) = matrix.get(robot, maze, seed) {
                        step_fuel = step_fuel.max(played.fuel.step_max);
                        memory_bytes = memory_bytes.max(played.memory_bytes);
                    }
                }
            }
            let class = self.folder.file.class_by_usage(step_fuel, memory_bytes);
            matrix.robots[robot].class = class.map(GuestText::from);
        }
    }

    /// The matches of some players in some mazes.
    pub fn keys<'a>(&self, players: &'a [(Digest, u32)], mazes: &'a [Digest]) -> MatchKeys<'a> {
        MatchKeys {
            engine: engine_id().digest(),
            rules: self.rules.digest(),
            players,
            mazes,
            seeds: self.seeds,
        }
    }
}
