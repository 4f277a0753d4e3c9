//! [`MatchKeys`]: the matches of a plan, by what their keys are made of.

use std::collections::HashMap;

use rusqlite::Connection;
use wasmouse_core::Digest;
use wasmouse_core::record::MatchKey;

use super::error::StoreErrorKind;
use super::ids::{self, Table};
use crate::contest::Seeds;

/// The matches of some players in some mazes with some seeds, under the same engine and rules.
///
/// Their order is that of a [`Plan`](crate::contest::Plan): mazes, then seeds, then players. A
/// player or maze that is listed twice counts once, at its first place.
#[derive(Clone, Copy, Debug)]
pub struct MatchKeys<'a> {
    /// The engine.
    pub engine: Digest,
    /// The rules.
    pub rules: Digest,
    /// Robots with their variants.
    pub players: &'a [(Digest, u32)],
    /// The mazes.
    pub mazes: &'a [Digest],
    /// The seeds of every maze.
    pub seeds: Seeds,
}

impl MatchKeys<'_> {
    /// The key of a match, by positions in the lists.
    pub fn key(&self, player: usize, maze: usize, seed: u32) -> MatchKey {
        let (robot, variant) = self.players[player];
        MatchKey {
            engine: self.engine,
            rules: self.rules,
            robot,
            variant,
            maze: self.mazes[maze],
            seed: self.seeds.get(seed),
        }
    }

    /// The position of a seed.
    pub(super) fn seed_position(&self, seed: u64) -> Option<u32> {
        seed_position(self.seeds, seed)
    }
}

/// The position of a seed, counted from 0.
pub(super) fn seed_position(seeds: Seeds, seed: u64) -> Option<u32> {
    let position = u32::try_from(seed.wrapping_sub(seeds.first)).ok()?;
    (position < seeds.count).then_some(position)
}

/// The first position of each item.
pub(super) fn positions<T: Copy + Eq + std::hash::Hash>(items: &[T]) -> HashMap<T, usize> {
    let mut positions = HashMap::with_capacity(items.len());
    for (position, &item) in items.iter().enumerate() {
        positions.entry(item).or_insert(position);
    }
    positions
}

/// The ids of a plan's mazes in a store.
pub(super) fn maze_positions(
    connection: &Connection,
    mazes: &[Digest],
) -> Result<HashMap<i64, usize>, StoreErrorKind> {
    let positions = positions(mazes);
    let mut by_id = HashMap::with_capacity(mazes.len());
    // One scan is faster than many look-ups, and no store has many more mazes than its contest.
    for (id, digest) in ids::all(connection, Table::Maze)? {
        if let Some(&position) = positions.get(&digest) {
            by_id.insert(id, position);
        }
    }
    Ok(by_id)
}
