//! How records get into a store: added, found there, or in conflict with what is there.

use rusqlite::{CachedStatement, Connection, OptionalExtension as _, params};
use wasmouse_core::GuestText;
use wasmouse_core::game::Ruleset;
use wasmouse_core::record::{MatchKey, MatchRecord};

use super::columns::{self, Insert, SELECT_RECORD, text_at};
use super::error::{StoreError, StoreErrorKind};
use super::ids::Address;
use super::open::Store;
use super::submissions::robot_name;

/// What became of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Put {
    /// It is new.
    Added,
    /// It was there.
    Same,
    /// Its address has another record, which stays.
    Different,
}

/// Adds records in a transaction.
pub(super) struct RecordWriter<'c> {
    connection: &'c Connection,
    insert: Insert<'c>,
    /// Removes what was not played before; `None` while everything was played.
    clear: Option<CachedStatement<'c>>,
}

impl<'c> RecordWriter<'c> {
    pub fn new(connection: &'c Connection) -> Result<Self, StoreErrorKind> {
        let sql = "SELECT EXISTS(SELECT 1 FROM unplayed)";
        let has_unplayed: bool = connection.query_row(sql, [], |row| row.get(0))?;
        let clear = has_unplayed.then(|| {
            connection.prepare_cached(
                "DELETE FROM unplayed WHERE engine = ?1 AND rules = ?2 AND robot = ?3 \
                 AND variant = ?4 AND maze = ?5 AND seed = ?6",
            )
        });
        Ok(Self {
            connection,
            insert: Insert::new(connection)?,
            clear: clear.transpose()?,
        })
    }

    /// Adds a record, unless its address has one.
    pub fn put(
        &mut self,
        at: &Address,
        record: &MatchRecord,
        rules: &Ruleset,
    ) -> Result<Put, StoreErrorKind> {
        if self.insert.execute(at, record)? {
            if let Some(clear) = &mut self.clear {
                clear.execute(params![
                    at.engine, at.rules, at.robot, at.variant, at.maze, at.seed,
                ])?;
            }
            return Ok(Put::Added);
        }
        let there = find_record(self.connection, at, &record.key, rules)?;
        if there.as_ref() == Some(record) {
            Ok(Put::Same)
        } else {
            Ok(Put::Different)
        }
    }
}

/// The record of an address; `None` if there is none.
pub(super) fn find_record(
    connection: &Connection,
    at: &Address,
    key: &MatchKey,
    rules: &Ruleset,
) -> Result<Option<MatchRecord>, StoreErrorKind> {
    let mut statement = connection.prepare_cached(SELECT_RECORD)?;
    let mut rows = statement.query(params![
        at.engine, at.rules, at.robot, at.variant, at.maze, at.seed,
    ])?;
    rows.next()?
        .map(|row| columns::read_record(row, *key, rules))
        .transpose()
}

/// Keeps a record that contradicts the one of its address.
pub(super) fn put_conflict(
    connection: &Connection,
    record: &MatchRecord,
) -> Result<(), StoreErrorKind> {
    let json = serde_json::to_string(record).expect("records have a JSON form");
    let sql = "INSERT INTO conflict(record) VALUES(?1) ON CONFLICT DO NOTHING";
    connection.execute(sql, [json])?;
    Ok(())
}

/// The error for a record that contradicts the one of its address.
pub(super) fn conflict(
    connection: &Connection,
    key: &MatchKey,
) -> Result<StoreErrorKind, StoreErrorKind> {
    Ok(StoreErrorKind::Conflict {
        key: Box::new(*key),
        robot: robot_name(connection, &key.robot, key.variant)?,
        maze: maze_name(connection, key)?,
    })
}

/// What the maze of a match is called.
pub(super) fn maze_name(
    connection: &Connection,
    key: &MatchKey,
) -> Result<GuestText, StoreErrorKind> {
    let sql = "SELECT name FROM maze WHERE digest = ?1";
    let name = connection.query_row(sql, params![key.maze.as_bytes()], |row| text_at(row, 0));
    let name: Option<GuestText> = name.optional()?;
    Ok(name.unwrap_or_else(|| key.maze.to_string()[..12].into()))
}

impl Store {
    /// Records that contradict the one of their address, in the order in which they came. A store
    /// that has any was changed, or a bug of wasmouse made two runs differ: nothing in it is to be
    /// trusted.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn conflicts(&self) -> Result<Vec<MatchRecord>, StoreError> {
        self.read(|connection| {
            let mut statement = connection.prepare("SELECT record FROM conflict ORDER BY id")?;
            let mut rows = statement.query([])?;
            let mut records = Vec::new();
            while let Some(row) = rows.next()? {
                let json = row.get_ref(0)?.as_str().unwrap_or_default();
                records.push(parse_conflict(json)?);
            }
            Ok(records)
        })
    }
}

/// A row of the table of conflicts.
pub(super) fn parse_conflict(json: &str) -> Result<MatchRecord, StoreErrorKind> {
    serde_json::from_str(json)
        .map_err(|error| StoreErrorKind::Damaged(format!("a conflict: {error}")))
}
