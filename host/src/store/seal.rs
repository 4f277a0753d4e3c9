//! The seal of a store: its content digest at the end of a run.

use rusqlite::Connection;

use super::error::StoreErrorKind;

/// Removes the seal, because the content changes.
pub(super) fn unseal(connection: &Connection) -> Result<(), StoreErrorKind> {
    connection.prepare_cached("DELETE FROM seal")?.execute([])?;
    Ok(())
}
