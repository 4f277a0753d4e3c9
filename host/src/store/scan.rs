//! All records of a store, whatever plan they belong to.

use std::collections::HashMap;

use rusqlite::{Connection, params};
use wasmouse_core::Digest;
use wasmouse_core::game::Ruleset;
use wasmouse_core::record::{EngineId, MatchKey, MatchRecord};

use super::columns::{self, RECORD_COLUMNS, SELECT_PLAYER};
use super::error::StoreErrorKind;
use super::ids::{self, Address, Table, digest_at};

/// What the ids of a file stand for. Engines and rules have the digests that they should have.
#[derive(Debug)]
pub(super) struct Catalog {
    pub engines: HashMap<i64, EngineId>,
    pub rules: HashMap<i64, Ruleset>,
    engine_digests: HashMap<i64, Digest>,
    rules_digests: HashMap<i64, Digest>,
    pub robots: HashMap<i64, Digest>,
    pub mazes: HashMap<i64, Digest>,
}

impl Catalog {
    /// Reads and checks it.
    pub fn load(connection: &Connection) -> Result<Self, StoreErrorKind> {
        let mut catalog = Self {
            engines: HashMap::new(),
            rules: HashMap::new(),
            engine_digests: HashMap::new(),
            rules_digests: HashMap::new(),
            robots: ids::all(connection, Table::Robot)?.into_iter().collect(),
            mazes: ids::all(connection, Table::Maze)?.into_iter().collect(),
        };
        let mut statement = connection.prepare("SELECT id, digest, name FROM engine")?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let (id, digest) = (row.get(0)?, digest_at(row, 1)?);
            let engine = EngineId::new(row.get::<_, String>(2)?);
            if engine.digest() != digest {
                let problem = format!("engine `{engine}` has another digest");
                return Err(StoreErrorKind::Damaged(problem));
            }
            catalog.engines.insert(id, engine);
            catalog.engine_digests.insert(id, digest);
        }
        let mut statement = connection.prepare("SELECT id, digest, json FROM rules")?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let (id, digest) = (row.get(0)?, digest_at(row, 1)?);
            let rules = ids::parse_rules(&row.get::<_, String>(2)?, &digest)?;
            catalog.rules.insert(id, rules);
            catalog.rules_digests.insert(id, digest);
        }
        Ok(catalog)
    }

    /// The key of an address.
    pub fn key(&self, at: &Address) -> Result<MatchKey, StoreErrorKind> {
        Ok(MatchKey {
            engine: *found(&self.engine_digests, at.engine)?,
            rules: *found(&self.rules_digests, at.rules)?,
            robot: *found(&self.robots, at.robot)?,
            variant: at.variant,
            maze: *found(&self.mazes, at.maze)?,
            seed: at.seed.cast_unsigned(),
        })
    }

    /// The rules of an address.
    pub fn rules(&self, at: &Address) -> Result<&Ruleset, StoreErrorKind> {
        found(&self.rules, at.rules)
    }
}

/// What an id stands for.
pub(super) fn found<T>(all: &HashMap<i64, T>, id: i64) -> Result<&T, StoreErrorKind> {
    all.get(&id).ok_or_else(|| {
        let problem = format!("it refers to id {id}, which it does not have");
        StoreErrorKind::Damaged(problem)
    })
}

/// Passes every record to `visit`, in the order of the file, so players one after the other.
pub(super) fn each_record<E: From<StoreErrorKind>>(
    connection: &Connection,
    catalog: &Catalog,
    mut visit: impl FnMut(&Address, MatchRecord) -> Result<(), E>,
) -> Result<(), E> {
    let sqlite = |error: rusqlite::Error| StoreErrorKind::from(error);
    let mut statement = connection.prepare(SELECT_PLAYER).map_err(sqlite)?;
    let mut last = None;
    while let Some(player) = next_player(connection, last.as_ref()).map_err(sqlite)? {
        let rules = catalog.rules(&player)?;
        let values = params![player.engine, player.rules, player.robot, player.variant];
        let mut rows = statement.query(values).map_err(sqlite)?;
        let mut key = None;
        while let Some(row) = rows.next().map_err(sqlite)? {
            let at = Address {
                maze: row.get(RECORD_COLUMNS).map_err(sqlite)?,
                seed: row.get(RECORD_COLUMNS + 1).map_err(sqlite)?,
                ..player
            };
            let next = match key {
                Some(key) => MatchKey {
                    maze: *found(&catalog.mazes, at.maze)?,
                    seed: at.seed.cast_unsigned(),
                    ..key
                },
                None => catalog.key(&at)?,
            };
            key = Some(next);
            visit(&at, columns::read_record(row, next, rules)?)?;
        }
        last = Some(player);
    }
    Ok(())
}

/// The player of the first match in the order of the file, or of the first one behind all matches
/// of a player; its maze and seed are 0. SQLite finds it without going through those matches.
fn next_player(
    connection: &Connection,
    last: Option<&Address>,
) -> rusqlite::Result<Option<Address>> {
    let sql = match last {
        None => {
            "SELECT engine, rules, robot, variant FROM match \
             ORDER BY engine, rules, robot, variant LIMIT 1"
        }
        Some(_) => {
            "SELECT engine, rules, robot, variant FROM match \
             WHERE (engine, rules, robot, variant) > (?1, ?2, ?3, ?4) \
             ORDER BY engine, rules, robot, variant LIMIT 1"
        }
    };
    let mut statement = connection.prepare_cached(sql)?;
    let values = last.map(|it| (it.engine, it.rules, it.robot, it.variant));
    let mut rows = match values {
        None => statement.query([])?,
        Some(values) => statement.query(values)?,
    };
    let Some(row) = rows.next()? else {
        return Ok(None);
    };
    Ok(Some(Address {
        engine: row.get(0)?,
        rules: row.get(1)?,
        robot: row.get(2)?,
        variant: row.get(3)?,
        maze: 0,
        seed: 0,
    }))
}

/// A row of the table of transcripts.
pub(super) struct TranscriptRow<'r> {
    pub at: Address,
    pub is_best: bool,
    pub bytes: &'r [u8],
}

/// Passes every transcript to `visit`, in the order of the file.
pub(super) fn each_transcript<E: From<StoreErrorKind>>(
    connection: &Connection,
    mut visit: impl FnMut(&TranscriptRow<'_>) -> Result<(), E>,
) -> Result<(), E> {
    let sqlite = |error: rusqlite::Error| StoreErrorKind::from(error);
    let mut statement = connection
        .prepare(
            "SELECT engine, rules, robot, variant, maze, seed, is_best, bytes FROM transcript \
             ORDER BY engine, rules, robot, variant, maze, seed",
        )
        .map_err(sqlite)?;
    let mut rows = statement.query([]).map_err(sqlite)?;
    while let Some(row) = rows.next().map_err(sqlite)? {
        let read = || -> rusqlite::Result<_> {
            let at = Address {
                engine: row.get(0)?,
                rules: row.get(1)?,
                robot: row.get(2)?,
                variant: row.get(3)?,
                maze: row.get(4)?,
                seed: row.get(5)?,
            };
            Ok(TranscriptRow {
                at,
                is_best: row.get(6)?,
                bytes: row.get_ref(7)?.as_blob().unwrap_or_default(),
            })
        };
        visit(&read().map_err(sqlite)?)?;
    }
    Ok(())
}
