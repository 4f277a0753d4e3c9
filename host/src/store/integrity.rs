//! [`Store::integrity`]: whether everything in a store makes sense.

use std::collections::HashMap;
use std::sync::Arc;

use rusqlite::Connection;
use wasmouse_core::game::Ruleset;
use wasmouse_core::maze::Maze;
use wasmouse_core::record::{MatchKey, MatchRecord, replay};

use super::content::seal_holds;
use super::error::{StoreError, StoreErrorKind};
use super::ids::Address;
use super::mazes::{check_oracle, stored_maze};
use super::open::Store;
use super::scan::{Catalog, each_record, each_transcript};
use super::submissions::{self, robot_name};
use super::transcripts;
use super::unplayed::Cause;
use super::writer::{find_record, maze_name, parse_conflict};

/// What was found to be in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Integrity {
    /// Records that were read.
    pub matches: u64,
    /// Transcripts whose matches were replayed, with the same result.
    pub transcripts: u64,
    /// Mazes whose walls have their digest.
    pub mazes: u64,
    /// Whether the store has a seal; it holds then.
    pub is_sealed: bool,
}

impl Store {
    /// Checks the whole store: the pages and references of the database, the digests of engines,
    /// rules and mazes, oracle scores, every record, every transcript by replaying it, the seal.
    ///
    /// What only the robot decides cannot be checked without playing: its actions, fuel, memory
    /// and journal.
    ///
    /// # Errors
    ///
    /// With what is wrong, or when the store cannot be read.
    pub fn integrity(&self) -> Result<Integrity, StoreError> {
        self.read(check)
    }
}

fn check(connection: &Connection) -> Result<Integrity, StoreErrorKind> {
    check_database(connection)?;
    let catalog = Catalog::load(connection)?;
    for digest in catalog.mazes.values() {
        let maze = stored_maze(connection, digest)?;
        let maze = maze.ok_or_else(|| StoreErrorKind::Unknown(format!("maze {digest}")))?;
        for (rules_id, rules) in &catalog.rules {
            check_oracle(connection, digest, &maze.maze, *rules_id, rules)?;
        }
    }
    let mut matches = 0;
    each_record(connection, &catalog, |_, _| -> Result<(), StoreErrorKind> {
        matches += 1;
        Ok(())
    })?;
    let mut transcripts = 0;
    let mut replaying = Replaying::new(connection, &catalog);
    each_transcript(connection, |row| -> Result<(), StoreErrorKind> {
        transcripts += 1;
        replaying.check(&row.at, row.bytes)
    })?;
    check_others(connection)?;
    let seal = seal_holds(connection)?;
    if seal == Some(false) {
        return Err(StoreErrorKind::SealBroken);
    }
    Ok(Integrity {
        matches,
        transcripts,
        mazes: catalog.mazes.len() as u64,
        is_sealed: seal.is_some(),
    })
}

/// Fails if SQLite finds something wrong.
pub(super) fn check_database(connection: &Connection) -> Result<(), StoreErrorKind> {
    let mut statement = connection.prepare("PRAGMA integrity_check(3)")?;
    let problems = statement.query_map([], |row| row.get(0))?;
    let problems: Vec<String> = problems.collect::<Result<_, _>>()?;
    if problems != ["ok"] {
        return Err(StoreErrorKind::Damaged(problems.join("; ")));
    }
    let mut statement = connection.prepare("PRAGMA foreign_key_check")?;
    let mut rows = statement.query([])?;
    if let Some(row) = rows.next()? {
        let table: String = row.get(0)?;
        let problem = format!("a row of the table {table} refers to one that is not there");
        return Err(StoreErrorKind::Damaged(problem));
    }
    Ok(())
}

fn check_others(connection: &Connection) -> Result<(), StoreErrorKind> {
    submissions::all(connection)?;
    let mut statement = connection.prepare("SELECT record FROM conflict")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        parse_conflict(row.get_ref(0)?.as_str().unwrap_or_default())?;
    }
    let mut statement = connection.prepare(
        "SELECT cause, variant, EXISTS(SELECT 1 FROM match m WHERE m.engine = u.engine \
         AND m.rules = u.rules AND m.robot = u.robot AND m.variant = u.variant \
         AND m.maze = u.maze AND m.seed = u.seed) FROM unplayed u",
    )?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        Cause::of_code(row.get(0)?)?;
        let _variant: u32 = row.get(1)?;
        if row.get(2)? {
            let problem = "a match was played and not played".to_owned();
            return Err(StoreErrorKind::Damaged(problem));
        }
    }
    Ok(())
}

/// Mazes in memory at once.
const MAZES_MAX: usize = 4096;

/// Checks transcripts against their records.
pub(super) struct Replaying<'a> {
    connection: &'a Connection,
    catalog: &'a Catalog,
    mazes: HashMap<i64, Arc<Maze>>,
}

impl<'a> Replaying<'a> {
    pub fn new(connection: &'a Connection, catalog: &'a Catalog) -> Self {
        Self {
            connection,
            catalog,
            mazes: HashMap::new(),
        }
    }

    /// Fails unless these bytes are the transcript of the record of that address, and the record
    /// follows from them.
    pub fn check(&mut self, at: &Address, bytes: &[u8]) -> Result<(), StoreErrorKind> {
        let key = self.catalog.key(at)?;
        let rules = self.catalog.rules(at)?;
        let record = find_record(self.connection, at, &key, rules)?;
        let record = record
            .ok_or_else(|| StoreErrorKind::Damaged("a transcript has no match".to_owned()))?;
        match self.problem(at, bytes, &record, rules)? {
            None => Ok(()),
            Some(problem) => self.inconsistent(&key, &problem),
        }
    }

    fn problem(
        &mut self,
        at: &Address,
        bytes: &[u8],
        record: &MatchRecord,
        rules: &Ruleset,
    ) -> Result<Option<String>, StoreErrorKind> {
        let transcript = match transcripts::decode(bytes, &record.transcript, &record.key) {
            Ok(transcript) => transcript,
            Err(StoreErrorKind::Inconsistent { problem, .. }) => return Ok(Some(problem)),
            Err(error) => return Err(error),
        };
        let maze = self.maze(at.maze, &record.key)?;
        Ok(match replay(&maze, &rules.game, &transcript) {
            Err(error) => Some(error.to_string()),
            Ok(result) => {
                let is_same = result.verdict == record.verdict
                    && result.steps == record.steps
                    && result.counts == record.counts;
                (!is_same).then(|| "the record does not follow from its transcript".to_owned())
            }
        })
    }

    fn maze(&mut self, id: i64, key: &MatchKey) -> Result<Arc<Maze>, StoreErrorKind> {
        if let Some(maze) = self.mazes.get(&id) {
            return Ok(Arc::clone(maze));
        }
        let maze = stored_maze(self.connection, &key.maze)?;
        let maze = maze.ok_or_else(|| StoreErrorKind::Unknown(format!("maze {}", key.maze)))?;
        let maze = Arc::new(maze.maze);
        if self.mazes.len() >= MAZES_MAX {
            self.mazes.clear();
        }
        self.mazes.insert(id, Arc::clone(&maze));
        Ok(maze)
    }

    fn inconsistent(&self, key: &MatchKey, problem: &str) -> Result<(), StoreErrorKind> {
        let robot = robot_name(self.connection, &key.robot, key.variant)?;
        let maze = maze_name(self.connection, key)?;
        Err(StoreErrorKind::Inconsistent {
            key: Box::new(*key),
            problem: format!(
                "robot `{}`, maze `{}`, seed {}: {problem}",
                robot.escaped(),
                maze.escaped(),
                key.seed
            ),
        })
    }
}
