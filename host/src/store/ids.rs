//! The ids that a file uses for digests.

use std::collections::HashMap;

use rusqlite::types::{FromSqlError, ValueRef};
use rusqlite::{Connection, OptionalExtension as _, Row, params};
use wasmouse_core::Digest;
use wasmouse_core::game::Ruleset;
use wasmouse_core::record::{EngineId, MatchKey};

use super::error::StoreErrorKind;

/// A table of digests.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Table {
    Engine,
    Rules,
    Robot,
    Maze,
}

impl Table {
    const fn select(self) -> &'static str {
        match self {
            Self::Engine => "SELECT id FROM engine WHERE digest = ?1",
            Self::Rules => "SELECT id FROM rules WHERE digest = ?1",
            Self::Robot => "SELECT id FROM robot WHERE digest = ?1",
            Self::Maze => "SELECT id FROM maze WHERE digest = ?1",
        }
    }

    const fn select_all(self) -> &'static str {
        match self {
            Self::Engine => "SELECT id, digest FROM engine",
            Self::Rules => "SELECT id, digest FROM rules",
            Self::Robot => "SELECT id, digest FROM robot",
            Self::Maze => "SELECT id, digest FROM maze",
        }
    }
}

/// The id of a digest; `None` if the store does not have it.
pub(super) fn find(
    connection: &Connection,
    table: Table,
    digest: &Digest,
) -> Result<Option<i64>, StoreErrorKind> {
    let mut statement = connection.prepare_cached(table.select())?;
    let row = statement.query_row(params![digest.as_bytes()], |row| row.get(0));
    Ok(row.optional()?)
}

/// All digests of a table with their ids.
pub(super) fn all(
    connection: &Connection,
    table: Table,
) -> Result<Vec<(i64, Digest)>, StoreErrorKind> {
    let mut statement = connection.prepare(table.select_all())?;
    let rows = statement.query_map([], |row| Ok((row.get(0)?, digest_at(row, 1)?)))?;
    Ok(rows.collect::<Result<_, _>>()?)
}

/// The digest in a column.
pub(super) fn digest_at(row: &Row<'_>, column: usize) -> rusqlite::Result<Digest> {
    let bytes = row.get_ref(column)?.as_blob();
    let bytes = bytes.and_then(|it| it.try_into().map_err(|_| FromSqlError::InvalidType));
    bytes.map(Digest::from_bytes).map_err(|error| {
        let blob = ValueRef::Blob(&[]).data_type();
        rusqlite::Error::FromSqlConversionFailure(column, blob, Box::new(error))
    })
}

/// Where a match is in a file: its key with ids for digests. Ordered as in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Address {
    pub engine: i64,
    pub rules: i64,
    pub robot: i64,
    pub variant: u32,
    pub maze: i64,
    /// The seed by its bits.
    pub seed: i64,
}

impl Address {
    /// Whether it is a match of the same player: engine, rules, robot and variant.
    pub fn is_same_player(&self, other: &Self) -> bool {
        let player = |it: &Self| (it.engine, it.rules, it.robot, it.variant);
        player(self) == player(other)
    }
}

/// The ids of a key; `None` if the store has no match with such a part.
pub(super) fn address(
    connection: &Connection,
    key: &MatchKey,
) -> Result<Option<Address>, StoreErrorKind> {
    let find = |table, digest| find(connection, table, digest);
    let (engine, rules) = (
        find(Table::Engine, &key.engine)?,
        find(Table::Rules, &key.rules)?,
    );
    let (robot, maze) = (
        find(Table::Robot, &key.robot)?,
        find(Table::Maze, &key.maze)?,
    );
    let (Some(engine), Some(rules), Some(robot), Some(maze)) = (engine, rules, robot, maze) else {
        return Ok(None);
    };
    Ok(Some(Address {
        engine,
        rules,
        robot,
        variant: key.variant,
        maze,
        seed: key.seed.cast_signed(),
    }))
}

/// Adds what is not there yet, and remembers the ids.
#[derive(Debug, Default)]
pub(super) struct IdCache {
    robots: HashMap<Digest, i64>,
    mazes: HashMap<Digest, i64>,
}

impl IdCache {
    /// Forgets everything, because a transaction that added ids was rolled back.
    pub fn clear(&mut self) {
        self.robots.clear();
        self.mazes.clear();
    }

    /// The id of a robot.
    pub fn robot(
        &mut self,
        connection: &Connection,
        digest: &Digest,
    ) -> Result<i64, StoreErrorKind> {
        if let Some(&id) = self.robots.get(digest) {
            return Ok(id);
        }
        let id = robot(connection, digest)?;
        self.robots.insert(*digest, id);
        Ok(id)
    }

    /// Remembers the id of a maze that has just been added.
    pub fn remember_maze(&mut self, digest: &Digest, id: i64) {
        self.mazes.insert(*digest, id);
    }

    /// The id of a maze that has been added; `None` for another.
    pub fn maze(
        &mut self,
        connection: &Connection,
        digest: &Digest,
    ) -> Result<Option<i64>, StoreErrorKind> {
        if let Some(&id) = self.mazes.get(digest) {
            return Ok(Some(id));
        }
        let id = find(connection, Table::Maze, digest)?;
        if let Some(id) = id {
            self.mazes.insert(*digest, id);
        }
        Ok(id)
    }
}

/// The id of a robot, which is added if it is new.
pub(super) fn robot(connection: &Connection, digest: &Digest) -> Result<i64, StoreErrorKind> {
    if let Some(id) = find(connection, Table::Robot, digest)? {
        return Ok(id);
    }
    let sql = "INSERT INTO robot(digest) VALUES(?1)";
    connection
        .prepare_cached(sql)?
        .execute(params![digest.as_bytes()])?;
    Ok(connection.last_insert_rowid())
}

/// The id of an engine, which is added if it is new.
pub(super) fn engine(connection: &Connection, engine: &EngineId) -> Result<i64, StoreErrorKind> {
    let digest = engine.digest();
    if let Some(id) = find(connection, Table::Engine, &digest)? {
        return Ok(id);
    }
    let sql = "INSERT INTO engine(digest, name) VALUES(?1, ?2)";
    connection.execute(sql, params![digest.as_bytes(), engine.as_str()])?;
    Ok(connection.last_insert_rowid())
}

/// The id of rules, which are added if they are new.
///
/// Rules with the same numbers are the same, whatever they are called. Of several names the first
/// in the order of their bytes is kept, so that the order in which they came does not matter.
pub(super) fn rules(connection: &Connection, rules: &Ruleset) -> Result<i64, StoreErrorKind> {
    let digest = rules.digest();
    let json = rules_json(rules);
    if let Some(id) = find(connection, Table::Rules, &digest)? {
        let sql = "UPDATE rules SET json = ?2 WHERE id = ?1 AND json > ?2";
        connection.execute(sql, params![id, json])?;
        return Ok(id);
    }
    let sql = "INSERT INTO rules(digest, json) VALUES(?1, ?2)";
    connection.execute(sql, params![digest.as_bytes(), json])?;
    Ok(connection.last_insert_rowid())
}

/// The serialised form of rules.
pub(super) fn rules_json(rules: &Ruleset) -> String {
    serde_json::to_string(rules).expect("rules have a JSON form")
}

/// The rules of a row, checked against its digest.
pub(super) fn parse_rules(json: &str, digest: &Digest) -> Result<Ruleset, StoreErrorKind> {
    let rules: Ruleset = serde_json::from_str(json)
        .map_err(|error| StoreErrorKind::Damaged(format!("rules {digest}: {error}")))?;
    if rules.digest() != *digest {
        let problem = format!("rules {digest}: their numbers have another digest");
        return Err(StoreErrorKind::Damaged(problem));
    }
    Ok(rules)
}
