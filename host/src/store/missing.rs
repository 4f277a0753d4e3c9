//! [`Missing`]: which matches of a plan a store does not have.

use std::collections::HashMap;

use rusqlite::{Connection, params};
use wasmouse_core::Digest;
use wasmouse_core::record::MatchKey;

use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, Table};
use super::keys::{MatchKeys, maze_positions, positions, seed_position};
use super::open::Store;
use crate::contest::Seeds;

/// The matches of a plan that a store does not have: one bit each.
#[derive(Clone, Debug)]
pub struct Missing {
    engine: Digest,
    rules: Digest,
    seeds: Seeds,
    players: HashMap<(Digest, u32), usize>,
    mazes: HashMap<Digest, usize>,
    /// By maze, then seed, then player, as in a plan.
    bits: Vec<u64>,
    width: usize,
    count: u64,
}

impl Missing {
    /// Whether a match is missing. `false` for a match that is not in the plan.
    pub fn contains(&self, key: &MatchKey) -> bool {
        if key.engine != self.engine || key.rules != self.rules {
            return false;
        }
        let player = self.players.get(&(key.robot, key.variant));
        let maze = self.mazes.get(&key.maze);
        let seed = seed_position(self.seeds, key.seed);
        match (player, maze, seed) {
            (Some(&player), Some(&maze), Some(seed)) => self.get(player, maze, seed),
            _ => false,
        }
    }

    /// Whether a match is missing, by positions in the lists of the plan.
    ///
    /// # Panics
    ///
    /// If there is no such position.
    pub fn get(&self, player: usize, maze: usize, seed: u32) -> bool {
        let bit = self.bit(player, maze, seed);
        self.bits[bit / 64] & 1 << (bit % 64) != 0
    }

    /// Whether any match in a maze is missing, by its position in the list of the plan.
    ///
    /// # Panics
    ///
    /// If there is no such position.
    pub fn has_maze(&self, maze: usize) -> bool {
        (0..self.seeds.count).any(|seed| (0..self.width).any(|player| self.get(player, maze, seed)))
    }

    /// How many matches are missing.
    pub const fn count(&self) -> u64 {
        self.count
    }

    fn bit(&self, player: usize, maze: usize, seed: u32) -> usize {
        (maze * self.seeds.count as usize + seed as usize) * self.width + player
    }

    fn set(&mut self, player: usize, maze: usize, seed: u32) {
        let bit = self.bit(player, maze, seed);
        self.bits[bit / 64] |= 1 << (bit % 64);
        self.count += 1;
    }

    fn clear(&mut self, player: usize, maze: usize, seed: u32) {
        if self.get(player, maze, seed) {
            let bit = self.bit(player, maze, seed);
            self.bits[bit / 64] &= !(1 << (bit % 64));
            self.count -= 1;
        }
    }

    /// All matches of a plan.
    fn all(keys: &MatchKeys<'_>) -> Self {
        let width = keys.players.len();
        let matches = keys.mazes.len() * keys.seeds.count as usize * width;
        let mut missing = Self {
            engine: keys.engine,
            rules: keys.rules,
            seeds: keys.seeds,
            players: positions(keys.players),
            mazes: positions(keys.mazes),
            bits: vec![0; matches.div_ceil(64)],
            width,
            count: 0,
        };
        let is_first_player = |it: &usize| missing.players[&keys.players[*it]] == *it;
        let players: Vec<usize> = (0..width).filter(is_first_player).collect();
        for (maze, digest) in keys.mazes.iter().enumerate() {
            if missing.mazes[digest] == maze {
                for seed in 0..keys.seeds.count {
                    for &player in &players {
                        missing.set(player, maze, seed);
                    }
                }
            }
        }
        missing
    }
}

impl Store {
    /// The matches of a plan that the store does not have. Those that were not played for a reason
    /// are among them.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn missing(&self, keys: &MatchKeys<'_>) -> Result<Missing, StoreError> {
        let mut missing = Missing::all(keys);
        self.read(|connection| remove_played(connection, keys, &mut missing))?;
        Ok(missing)
    }
}

fn remove_played(
    connection: &Connection,
    keys: &MatchKeys<'_>,
    missing: &mut Missing,
) -> Result<(), StoreErrorKind> {
    let engine = ids::find(connection, Table::Engine, &keys.engine)?;
    let rules = ids::find(connection, Table::Rules, &keys.rules)?;
    let (Some(engine), Some(rules)) = (engine, rules) else {
        return Ok(());
    };
    let mazes = maze_positions(connection, keys.mazes)?;
    let mut statement = connection.prepare_cached(
        "SELECT maze, seed FROM match \
         WHERE engine = ?1 AND rules = ?2 AND robot = ?3 AND variant = ?4",
    )?;
    for (&(digest, variant), &player) in &missing.players.clone() {
        let Some(robot) = ids::find(connection, Table::Robot, &digest)? else {
            continue;
        };
        let mut rows = statement.query(params![engine, rules, robot, variant])?;
        while let Some(row) = rows.next()? {
            let (maze, seed): (i64, i64) = (row.get(0)?, row.get(1)?);
            let seed = keys.seed_position(seed.cast_unsigned());
            if let (Some(&maze), Some(seed)) = (mazes.get(&maze), seed) {
                missing.clear(player, maze, seed);
            }
        }
    }
    Ok(())
}
