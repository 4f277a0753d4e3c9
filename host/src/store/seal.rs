//! The seal of a store: its content digest at the end of a run.

use rusqlite::{Connection, OptionalExtension as _};
use wasmouse_core::Digest;

use super::error::StoreErrorKind;
use super::ids::digest_at;

/// Removes the seal, because the content changes.
pub(super) fn unseal(connection: &Connection) -> Result<(), StoreErrorKind> {
    connection.prepare_cached("DELETE FROM seal")?.execute([])?;
    Ok(())
}

/// The content digest in the seal.
pub(super) fn sealed(connection: &Connection) -> Result<Option<Digest>, StoreErrorKind> {
    let sql = "SELECT content FROM seal";
    let content = connection.query_row(sql, [], |row| digest_at(row, 0));
    Ok(content.optional()?)
}
