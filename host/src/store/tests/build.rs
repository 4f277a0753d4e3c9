//! How SQLite is built: `.cargo/config.toml` sets flags that cargo would drop without a word where
//! it does not read that file, or where the crate stops asking for them.

use rusqlite::Connection;

#[test]
fn sqlite_is_built_with_the_flags_of_the_repository() {
    let database = Connection::open_in_memory().expect("memory");
    let mut options = database
        .prepare("PRAGMA compile_options")
        .expect("a statement");
    let options: Vec<String> = options
        .query_map([], |row| row.get(0))
        .expect("rows")
        .collect::<Result<_, _>>()
        .expect("texts");
    let has = |option: &str| options.iter().any(|it| it == option);
    assert!(has("DEFAULT_MEMSTATUS=0"), "{options:?}");
    assert!(!has("ENABLE_MEMORY_MANAGEMENT"), "{options:?}");
    // What the crate sets by itself is there, so the list is not empty for another reason.
    assert!(has("ENABLE_API_ARMOR"), "{options:?}");
}
