//! [`Store::records`]: records in the order of a plan. [`Store::record`]: one of them.

use std::io;
use std::ops::Range;

use rusqlite::{Connection, OptionalExtension as _, params};
use wasmouse_core::game::Ruleset;
use wasmouse_core::record::{MatchKey, MatchRecord};

use super::columns::{self, RECORD_COLUMNS, SELECT_SEEDS};
use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, Table};
use super::keys::{MatchKeys, positions};
use super::open::Store;
use super::writer::find_record;

/// Records in memory at once, about.
const CHUNK: usize = 4096;

impl Store {
    /// The record of a match; `None` if it was not played.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn record(&self, key: &MatchKey) -> Result<Option<MatchRecord>, StoreError> {
        self.read(|connection| {
            let at = ids::address(connection, key)?;
            let rules = stored_rules(connection, key)?;
            let (Some(at), Some(rules)) = (at, rules) else {
                return Ok(None);
            };
            find_record(connection, &at, key, &rules)
        })
    }

    /// Passes the records of a plan to `visit`, in the order of the plan: mazes, then seeds, then
    /// players. Matches that were not played are left out. Returns how many there were.
    ///
    /// # Errors
    ///
    /// When the store cannot be read, or `visit` fails.
    pub fn records(
        &self,
        keys: &MatchKeys<'_>,
        visit: &mut dyn FnMut(&MatchRecord) -> io::Result<()>,
    ) -> Result<u64, StoreError> {
        self.read(|connection| visit_records(connection, keys, visit))
    }
}

/// The rules of a key; `None` if the store does not have them.
fn stored_rules(
    connection: &Connection,
    key: &MatchKey,
) -> Result<Option<Ruleset>, StoreErrorKind> {
    let sql = "SELECT json FROM rules WHERE digest = ?1";
    let mut statement = connection.prepare_cached(sql)?;
    let json = statement.query_row(params![key.rules.as_bytes()], |row| row.get(0));
    let json: Option<String> = json.optional()?;
    json.map(|json| ids::parse_rules(&json, &key.rules))
        .transpose()
}

fn visit_records(
    connection: &Connection,
    keys: &MatchKeys<'_>,
    visit: &mut dyn FnMut(&MatchRecord) -> io::Result<()>,
) -> Result<u64, StoreErrorKind> {
    let mut count = 0;
    if keys.players.is_empty() || keys.mazes.is_empty() || keys.seeds.count == 0 {
        return Ok(0);
    }
    let engine = ids::find(connection, Table::Engine, &keys.engine)?;
    let rules_id = ids::find(connection, Table::Rules, &keys.rules)?;
    let rules = stored_rules(connection, &keys.key(0, 0, 0))?;
    let (Some(engine), Some(rules_id), Some(rules)) = (engine, rules_id, rules) else {
        return Ok(0);
    };
    let first_players = positions(keys.players);
    let mut robots = Vec::with_capacity(keys.players.len());
    for (player, place) in keys.players.iter().enumerate() {
        let robot = ids::find(connection, Table::Robot, &place.0)?;
        robots.push(robot.filter(|_| first_players[place] == player));
    }
    let first_mazes = positions(keys.mazes);
    let mut statement = connection.prepare_cached(SELECT_SEEDS)?;
    for (maze, digest) in keys.mazes.iter().enumerate() {
        let maze_id = ids::find(connection, Table::Maze, digest)?;
        let Some(maze_id) = maze_id.filter(|_| first_mazes[digest] == maze) else {
            continue;
        };
        for chunk in seed_chunks(keys) {
            let (first, last) = (keys.seeds.get(chunk.start), keys.seeds.get(chunk.end - 1));
            let mut records = Vec::new();
            for (player, robot) in robots.iter().enumerate() {
                let variant = keys.players[player].1;
                let mut rows = statement.query(params![
                    engine,
                    rules_id,
                    robot,
                    variant,
                    maze_id,
                    first.cast_signed(),
                    last.cast_signed(),
                ])?;
                while let Some(row) = rows.next()? {
                    let seed = columns::unsigned(row, RECORD_COLUMNS)?;
                    if let Some(position) = keys.seed_position(seed) {
                        let key = keys.key(player, maze, position);
                        let record = columns::read_record(row, key, &rules)?;
                        records.push((position, player, record));
                    }
                }
            }
            records.sort_unstable_by_key(|(seed, player, _)| (*seed, *player));
            for (_, _, record) in &records {
                visit(record).map_err(StoreErrorKind::Reader)?;
                count += 1;
            }
        }
    }
    Ok(count)
}

/// Positions of seeds that are neighbours in the file, in pieces.
fn seed_chunks(keys: &MatchKeys<'_>) -> Vec<Range<u32>> {
    let length = (CHUNK / keys.players.len()).clamp(1, CHUNK);
    let length = u32::try_from(length).expect("at most CHUNK");
    let count = keys.seeds.count;
    // Seeds are stored by their bits, so the order of the file breaks after 2^63 - 1.
    let to_break = (1_u64 << 63).wrapping_sub(keys.seeds.first);
    let to_break = u32::try_from(to_break).ok().filter(|it| *it < count);
    let mut chunks = Vec::new();
    let mut start = 0;
    while start < count {
        let mut end = start.saturating_add(length).min(count);
        if let Some(to_break) = to_break
            && start < to_break
        {
            end = end.min(to_break);
        }
        chunks.push(start..end);
        start = end;
    }
    chunks
}
