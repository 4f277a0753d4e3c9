//! [`RecordedScores`]: a [`ScoreMatrix`] of results that were written to files.

use std::collections::{HashMap, HashSet};

use thiserror::Error;
use wasmouse_core::Digest;
use wasmouse_core::game::Ruleset;

use super::matrix::{MatchScore, MatrixMaze, MatrixRobot, ScoreMatrix};
use super::plan::Seeds;
use super::results::{MazeEntry, Results};

/// Matches of all documents together, at most: about 1 GB of scores. A damaged document may claim
/// more seeds than there is memory for.
const MATCHES_MAX: u64 = 20_000_000;

/// Scores of one document, or of several that can be compared.
///
/// Robots are the same if name, file and variant are; mazes if their digests are. Where several
/// documents have the same match, the last one counts.
#[derive(Debug, Default)]
pub struct RecordedScores {
    documents: Vec<Results>,
}

/// Why a document cannot be added to others.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum RecordedError {
    /// They were played by other rules.
    #[error("its rules are `{found}`, those of the files before are `{expected}`")]
    Rules {
        /// The name of those of the first document.
        expected: String,
        /// The name of those of this one.
        found: String,
    },
    /// They were played with other seeds.
    #[error(
        "its seeds are {} from {}, those of the files before are {} from {}",
        found.count, found.first, expected.count, expected.first
    )]
    Seeds {
        /// Those of the first document.
        expected: Seeds,
        /// Those of this one.
        found: Seeds,
    },
    /// All documents together have too many matches, played or not.
    #[error("{matches} matches are too many; at most {MATCHES_MAX}")]
    TooLarge {
        /// Robots times mazes times seeds.
        matches: u64,
    },
}

impl RecordedScores {
    /// Adds a document.
    ///
    /// # Errors
    ///
    /// When its rules or seeds are not those of the first one, or there are too many matches.
    pub fn push(&mut self, results: Results) -> Result<(), RecordedError> {
        if let Some(first) = self.documents.first() {
            let (expected, found) = (&first.contest, &results.contest);
            if expected.rules.digest() != found.rules.digest() {
                return Err(RecordedError::Rules {
                    expected: expected.rules.name.clone(),
                    found: found.rules.name.clone(),
                });
            }
            if expected.seeds != found.seeds {
                return Err(RecordedError::Seeds {
                    expected: expected.seeds,
                    found: found.seeds,
                });
            }
        }
        self.documents.push(results);
        let all = || self.documents.iter();
        let robots: usize = all().map(|it| it.contest.robots.len()).sum();
        let mazes: usize = all().map(|it| it.summary.mazes.len()).sum();
        let seeds = u64::from(self.documents[0].contest.seeds.count);
        let matches = (robots as u64)
            .saturating_mul(mazes as u64)
            .saturating_mul(seeds);
        if matches > MATCHES_MAX {
            return Err(RecordedError::TooLarge { matches });
        }
        Ok(())
    }

    /// The scores of all documents; without a document, a matrix without robots.
    pub fn matrix(&self) -> ScoreMatrix {
        let contest = self.documents.first().map(|first| &first.contest);
        let rules = contest.map_or_else(Ruleset::default, |it| it.rules.clone());
        let seeds = contest.map_or(Seeds { first: 0, count: 1 }, |it| it.seeds);
        let mut robots: Vec<MatrixRobot> = Vec::new();
        let mut mazes: Vec<&MazeEntry> = Vec::new();
        let mut known: HashSet<Digest> = HashSet::new();
        for results in &self.documents {
            for entry in &results.contest.robots {
                let is_same = |it: &MatrixRobot| {
                    (&it.name, it.digest, it.variant) == (&entry.name, entry.digest, entry.variant)
                };
                if entry.is_admitted() && !robots.iter().any(is_same) {
                    robots.push(MatrixRobot::new(
                        entry.name.clone(),
                        entry.digest,
                        entry.variant,
                    ));
                }
            }
            for entry in &results.summary.mazes {
                if known.insert(entry.digest) {
                    mazes.push(entry);
                }
            }
        }
        // A robot that was entered under two names has two places.
        let mut players: HashMap<(Digest, u32), Vec<usize>> = HashMap::new();
        for (index, robot) in robots.iter().enumerate() {
            let player = players.entry((robot.digest, robot.variant)).or_default();
            player.push(index);
        }
        let mut matrix = ScoreMatrix::new(rules, seeds, robots);
        let mut places: HashMap<Digest, usize> = HashMap::new();
        for maze in mazes {
            let place = matrix.push_maze(MatrixMaze {
                name: maze.name.clone(),
                digest: maze.digest,
                dimension: maze.dimension,
                oracle: maze.oracle,
                set: 0,
            });
            places.insert(maze.digest, place);
        }
        for record in self.documents.iter().flat_map(|it| &it.matches) {
            let key = &record.key;
            let seed = u32::try_from(key.seed.wrapping_sub(seeds.first)).ok();
            let seed = seed.filter(|&seed| seed < seeds.count);
            let Some((&maze, seed)) = places.get(&key.maze).zip(seed) else {
                continue;
            };
            let robots = players.get(&(key.robot, key.variant)).into_iter().flatten();
            for &robot in robots {
                matrix.set(robot, maze, seed, MatchScore::new(record));
                matrix.robots[robot].count_fault(record);
            }
        }
        matrix
    }
}
