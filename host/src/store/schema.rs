//! The schema of stores: its migrations, and a check that a file has exactly this one.

use std::sync::OnceLock;

use rusqlite::Connection;
use rusqlite_migration::{M, Migrations};

use super::error::StoreErrorKind;

/// The `application_id` of a store, "wMou" in ASCII. `file results.db` shows it.
pub const APPLICATION_ID: u32 = 0x774d_6f75;

/// The version of the schema, the `user_version` of a store. Range of supported versions: from 1
/// to this one.
pub const SCHEMA_VERSION: u32 = 1;

const STEPS: [M<'static>; SCHEMA_VERSION as usize] = [M::up(include_str!("001-first.sql"))];

/// Brings the schema to the latest version. Each step is a transaction.
pub(super) fn migrate(connection: &mut Connection) -> Result<(), StoreErrorKind> {
    match Migrations::from_slice(&STEPS).to_latest(connection) {
        Ok(()) => Ok(()),
        Err(rusqlite_migration::Error::RusqliteError { err, .. }) => Err(err.into()),
        Err(error) => Err(StoreErrorKind::Damaged(error.to_string())),
    }
}

/// Fails unless tables, indices, triggers and views are those of this version. A store that
/// someone made may have a view or a trigger in the place of a table.
pub(super) fn check(connection: &Connection) -> Result<(), StoreErrorKind> {
    static EXPECTED: OnceLock<Vec<String>> = OnceLock::new();
    let expected = match EXPECTED.get() {
        Some(expected) => expected,
        None => {
            let mut fresh = Connection::open_in_memory()?;
            migrate(&mut fresh)?;
            let objects = objects(&fresh)?;
            EXPECTED.get_or_init(|| objects)
        }
    };
    if objects(connection)? == *expected {
        return Ok(());
    }
    let problem = "its tables are not those of a store".to_owned();
    Err(StoreErrorKind::Damaged(problem))
}

/// The definition of everything in the schema. Tables that SQLite makes for itself, such as
/// those of `ANALYZE`, have names that begin with `sqlite_`.
fn objects(connection: &Connection) -> rusqlite::Result<Vec<String>> {
    let mut statement = connection.prepare(
        "SELECT type || ' ' || name || ' ' || tbl_name || ' ' || ifnull(sql, '') \
         FROM sqlite_schema WHERE name NOT LIKE 'sqlite\\_%' ESCAPE '\\' ORDER BY type, name",
    )?;
    let objects = statement.query_map([], |row| row.get(0))?;
    objects.collect()
}
