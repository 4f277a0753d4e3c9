//! Changes a store behind its back, as someone with SQLite could.

use std::path::Path;

use rusqlite::Connection;

/// Executes statements in a store without its triggers and references.
pub fn tamper(path: &Path, sql: &str) {
    let connection = Connection::open(path).expect("a database");
    connection
        .pragma_update(None, "foreign_keys", false)
        .expect("a pragma");
    let mut statement = connection
        .prepare("SELECT name, sql FROM sqlite_schema WHERE type = 'trigger'")
        .expect("the schema");
    let triggers = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)));
    let triggers: Vec<(String, String)> = triggers
        .and_then(Iterator::collect)
        .expect("triggers have definitions");
    drop(statement);
    for (name, _) in &triggers {
        let drop = format!("DROP TRIGGER {name}");
        connection.execute_batch(&drop).expect("it is there");
    }
    connection.execute_batch(sql).expect("valid SQL");
    for (_, definition) in &triggers {
        connection.execute_batch(definition).expect("it was there");
    }
}
