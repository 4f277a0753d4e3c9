//! [`Plan`]: what a contest plays.

use std::collections::BTreeSet;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use wasmouse_core::game::Ruleset;
use wasmouse_core::record::{MatchKey, MatchSpec};
use wasmouse_core::{Digest, GuestText};
use wasmouse_engine::admission::Rejection;
use wasmouse_engine::{AdmittedRobot, engine_id};

use super::maze_source::{ContestMaze, MazeSource};

/// A robot that takes part, or was meant to.
#[derive(Clone)]
pub struct Entrant {
    /// What the standings call it.
    pub name: GuestText,
    /// The digest of the file that was submitted.
    pub digest: Digest,
    /// The number that chooses its mode.
    pub variant: u32,
    /// The admitted robot, or why it plays no match.
    pub admission: Result<Arc<AdmittedRobot>, NotAdmitted>,
}

/// Why an entrant plays no match.
#[derive(Clone, Debug)]
pub enum NotAdmitted {
    /// Its file is rejected.
    Rejected(Arc<Rejection>),
    /// The host could not admit it, which says nothing about the robot: why.
    Failed(GuestText),
}

/// Consecutive seeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seeds {
    /// The first seed.
    pub first: u64,
    /// How many there are. Range: at least 1.
    pub count: u32,
}

impl Seeds {
    /// The seed at that position, counted from 0. Wraps around after the largest seed.
    pub const fn get(self, position: u32) -> u64 {
        self.first.wrapping_add(position as u64)
    }
}

/// Every entrant in every maze with every seed.
///
/// The order of matches is mazes, then seeds, then players, so that whenever a contest stops,
/// all robots have played about the same mazes.
pub struct Plan {
    /// The robots.
    pub entrants: Vec<Entrant>,
    /// The mazes.
    pub mazes: Vec<MazeSource>,
    /// The seeds, the same in every maze.
    pub seeds: Seeds,
    /// The rules.
    pub rules: Arc<Ruleset>,
}

/// A robot in one of its variants. Entrants with the same file and variant are one player:
/// their matches have the same keys.
#[derive(Clone)]
pub struct Player {
    /// The admitted robot.
    pub robot: Arc<AdmittedRobot>,
    /// Its variant.
    pub variant: u32,
    /// Entrants that it stands for, as indices.
    pub entrants: Vec<usize>,
}

/// The parts of a plan that every match key of it has, digested once.
#[derive(Clone, Copy, Debug)]
pub struct KeyParts {
    engine: Digest,
    rules: Digest,
}

impl Plan {
    /// The admitted robots, in the order of the entrants, each once.
    pub fn players(&self) -> Vec<Player> {
        let mut players: Vec<Player> = Vec::new();
        for (index, entrant) in self.entrants.iter().enumerate() {
            let Ok(robot) = &entrant.admission else {
                continue;
            };
            let same = players.iter_mut().find(|player| {
                player.robot.digest() == robot.digest() && player.variant == entrant.variant
            });
            match same {
                Some(player) => player.entrants.push(index),
                None => players.push(Player {
                    robot: Arc::clone(robot),
                    variant: entrant.variant,
                    entrants: vec![index],
                }),
            }
        }
        players
    }

    /// How many matches there are.
    pub fn matches(&self) -> u64 {
        let robots = self.entrants.iter();
        let players: BTreeSet<(&Digest, u32)> = robots
            .filter(|entrant| entrant.admission.is_ok())
            .map(|entrant| (&entrant.digest, entrant.variant))
            .collect();
        players.len() as u64 * self.mazes.len() as u64 * u64::from(self.seeds.count)
    }

    /// What all keys have in common.
    pub fn key_parts(&self) -> KeyParts {
        KeyParts {
            engine: engine_id().digest(),
            rules: self.rules.digest(),
        }
    }

    /// The match of a player in a maze.
    pub fn spec(
        &self,
        parts: KeyParts,
        player: &Player,
        maze: &ContestMaze,
        seed: u64,
    ) -> MatchSpec {
        MatchSpec {
            key: MatchKey {
                engine: parts.engine,
                rules: parts.rules,
                robot: *player.robot.digest(),
                variant: player.variant,
                maze: maze.digest,
                seed,
            },
            maze: Arc::clone(&maze.maze),
            rules: Arc::clone(&self.rules),
        }
    }
}
