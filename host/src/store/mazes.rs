//! Mazes in a store: what it takes to show them, and the names of generated ones.

use std::collections::HashMap;

use rusqlite::{CachedStatement, Connection, OptionalExtension as _, params};
use wasmouse_core::game::{Ruleset, Score};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::maze::generate::{GenSpec, GeneratedMaze};
use wasmouse_core::maze::{Area, Cell, DIMENSIONS, Heading, Maze, Walls};
use wasmouse_core::{Digest, GuestText};

use super::columns::{column, text_at};
use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, Table, digest_at};
use super::open::Store;
use crate::contest::ContestMaze;

/// The identity of the generators. Equal specifications give equal mazes in every version of
/// wasmouse with this one.
pub const GENERATOR: &str = "wasmouse.generate.1";

/// A maze of a store.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredMaze {
    /// What results call it; if it had several names, the first in the order of their bytes.
    pub name: GuestText,
    /// Its digest.
    pub digest: Digest,
    /// The maze, with that digest.
    pub maze: Maze,
}

/// Digests of generated mazes that a store knows, by their names: those that are looked up are
/// printed faster than all of them are parsed.
#[derive(Clone, Debug, Default)]
pub struct GeneratedDigests(HashMap<String, Digest>);

impl GeneratedDigests {
    /// The digest of a generated maze; `None` if it was not played yet.
    pub fn get(&self, maze: &GeneratedMaze) -> Option<&Digest> {
        if self.is_empty() {
            return None;
        }
        self.0.get(&maze.to_string())
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Store {
    /// The digests of all generated mazes, so that what is missing of a contest is known without
    /// generating its mazes.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn generated_digests(&self) -> Result<GeneratedDigests, StoreError> {
        self.read(|connection| {
            let mut statement = connection.prepare(
                "SELECT g.name, m.digest FROM generated g JOIN maze m ON m.id = g.maze \
                 WHERE g.generator = ?1",
            )?;
            let mut rows = statement.query([GENERATOR])?;
            let mut digests = HashMap::new();
            while let Some(row) = rows.next()? {
                digests.insert(row.get(0)?, digest_at(row, 1)?);
            }
            Ok(GeneratedDigests(digests))
        })
    }

    /// The digests of all mazes.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn maze_digests(&self) -> Result<Vec<Digest>, StoreError> {
        self.read(|connection| {
            let mazes = ids::all(connection, Table::Maze)?.into_iter();
            Ok(mazes.map(|(_, digest)| digest).collect())
        })
    }

    /// A maze; `None` if the store does not have it.
    ///
    /// # Errors
    ///
    /// When the store cannot be read, or the maze has another digest.
    pub fn maze(&self, digest: &Digest) -> Result<Option<StoredMaze>, StoreError> {
        self.read(|connection| stored_maze(connection, digest))
    }
}

/// A maze; `None` if the store does not have it.
pub(super) fn stored_maze(
    connection: &Connection,
    digest: &Digest,
) -> Result<Option<StoredMaze>, StoreErrorKind> {
    let sql = "SELECT name, dimension, walls, id FROM maze WHERE digest = ?1";
    let mut statement = connection.prepare_cached(sql)?;
    let row = statement.query_row(params![digest.as_bytes()], |row| {
        let maze = MazeRow {
            name: text_at(row, 0)?,
            digest: *digest,
            dimension: row.get(1)?,
            walls: row.get(2)?,
            oracle: None,
        };
        Ok((maze, row.get(3)?))
    });
    let Some((row, id)) = row.optional()? else {
        return Ok(None);
    };
    let (maze, _) = row.build(connection, id)?;
    Ok(Some(StoredMaze {
        name: row.name,
        digest: *digest,
        maze,
    }))
}

/// A name that generates the maze.
fn generated_name(connection: &Connection, maze: i64) -> Result<Option<String>, StoreErrorKind> {
    // There may be several, and the one of the maze is as good as any.
    let sql = "SELECT g.name FROM generated g JOIN maze m ON m.id = g.maze \
               WHERE g.generator = ?1 AND g.name = m.name AND m.id = ?2";
    let mut statement = connection.prepare_cached(sql)?;
    let name = statement.query_row(params![GENERATOR, maze], |row| row.get(0));
    if let Some(name) = name.optional()? {
        return Ok(Some(name));
    }
    let sql = "SELECT name FROM generated WHERE generator = ?1 AND maze = ?2";
    let mut statement = connection.prepare_cached(sql)?;
    let name = statement.query_row(params![GENERATOR, maze], |row| row.get(0));
    Ok(name.optional()?)
}

/// The maze that a name generates; `None` if the store does not know the name.
pub(super) fn generated_by(
    connection: &Connection,
    name: &str,
) -> Result<Option<i64>, StoreErrorKind> {
    let sql = "SELECT maze FROM generated WHERE generator = ?1 AND name = ?2";
    let mut statement = connection.prepare_cached(sql)?;
    let maze = statement.query_row(params![GENERATOR, name], |row| row.get(0));
    Ok(maze.optional()?)
}

/// The generated maze of that name.
pub(super) fn parse_generated(name: &str) -> Result<GeneratedMaze, StoreErrorKind> {
    let spec = name.parse::<GenSpec>().ok();
    let maze = spec
        .filter(|it| it.count() == 1)
        .and_then(|it| it.expand().next());
    maze.filter(|it| it.to_string() == name)
        .ok_or_else(|| StoreErrorKind::Damaged(format!("`{name}` is no generated maze")))
}

/// A maze to store.
#[derive(Clone, Debug)]
pub(super) struct MazeRow {
    pub name: GuestText,
    pub digest: Digest,
    pub dimension: u8,
    /// `None` for a maze that its name generates.
    pub walls: Option<Vec<u8>>,
    pub oracle: Option<Score>,
}

impl MazeRow {
    pub fn new(maze: &ContestMaze) -> Self {
        Self {
            name: maze.name.clone(),
            digest: maze.digest,
            dimension: maze.maze.dimension(),
            walls: (!maze.is_generated).then(|| pack(&maze.maze)),
            oracle: maze.oracle,
        }
    }

    /// The maze of this row of a store, and its name if that generates it.
    pub fn build(
        &self,
        connection: &Connection,
        id: i64,
    ) -> Result<(Maze, Option<String>), StoreErrorKind> {
        let name = match &self.walls {
            Some(_) => None,
            None => generated_name(connection, id)?,
        };
        let maze = match (&self.walls, &name) {
            (Some(walls), _) => unpack(walls),
            (None, Some(name)) => Some(parse_generated(name)?.generate()),
            (None, None) => None,
        };
        let maze = maze.filter(|it| it.digest() == self.digest && it.dimension() == self.dimension);
        let maze = maze.ok_or_else(|| {
            let problem = format!("maze {}: its walls have another digest", self.digest);
            StoreErrorKind::Damaged(problem)
        })?;
        Ok((maze, name))
    }
}

/// Adds mazes in a transaction.
pub(super) struct MazeWriter<'c> {
    connection: &'c Connection,
    maze: CachedStatement<'c>,
    oracle: CachedStatement<'c>,
    generated: CachedStatement<'c>,
}

impl<'c> MazeWriter<'c> {
    pub fn new(connection: &'c Connection) -> Result<Self, StoreErrorKind> {
        let maze = "INSERT INTO maze(digest, name, dimension, walls) VALUES(?1, ?2, ?3, ?4) \
                    ON CONFLICT DO NOTHING";
        let oracle = "INSERT INTO oracle(maze, rules, oracle_exploration, oracle_speed) \
                      VALUES(?1, ?2, ?3, ?4) ON CONFLICT DO NOTHING";
        let generated = "INSERT INTO generated(generator, name, maze) VALUES(?1, ?2, ?3) \
                         ON CONFLICT DO NOTHING";
        Ok(Self {
            connection,
            maze: connection.prepare_cached(maze)?,
            oracle: connection.prepare_cached(oracle)?,
            generated: connection.prepare_cached(generated)?,
        })
    }

    /// Adds a maze unless it is there, and what depends on the rules. Returns its id.
    pub fn put(&mut self, maze: &MazeRow, rules: i64) -> Result<i64, StoreErrorKind> {
        let id = self.put_alone(maze)?;
        let oracle = maze.oracle;
        let steps = oracle.map(|it| (it.exploration_steps(), it.speed_steps()));
        self.put_oracle(id, rules, steps)?;
        if maze.walls.is_none() {
            self.put_generated(maze.name.as_guest(), id)?;
        }
        Ok(id)
    }

    /// Adds a maze unless it is there. Returns its id.
    pub fn put_alone(&mut self, maze: &MazeRow) -> Result<i64, StoreErrorKind> {
        // Most mazes that arrive are new, so adding is tried first.
        let added = self.maze.execute(params![
            maze.digest.as_bytes(),
            column(&maze.name),
            maze.dimension,
            maze.walls,
        ])?;
        if added > 0 {
            return Ok(self.connection.last_insert_rowid());
        }
        let id = ids::find(self.connection, Table::Maze, &maze.digest)?;
        let id = id.ok_or_else(|| StoreErrorKind::Unknown(format!("maze {}", maze.digest)))?;
        let sql = "UPDATE maze SET name = ?2 WHERE id = ?1 AND name > ?2";
        let mut statement = self.connection.prepare_cached(sql)?;
        statement.execute(params![id, column(&maze.name)])?;
        Ok(id)
    }

    /// Adds what an oracle does in a maze.
    pub fn put_oracle(
        &mut self,
        maze: i64,
        rules: i64,
        steps: OracleSteps,
    ) -> Result<(), StoreErrorKind> {
        let (exploration, speed) = steps.unzip();
        let values = params![maze, rules, exploration, speed];
        self.oracle.execute(values)?;
        Ok(())
    }

    /// Adds the name of a generated maze.
    pub fn put_generated(&mut self, name: GuestStr<'_>, maze: i64) -> Result<(), StoreErrorKind> {
        let values = params![GENERATOR, column(name), maze];
        self.generated.execute(values)?;
        Ok(())
    }
}

/// The steps of the oracle under some rules: exploration and speed.
pub(super) type OracleSteps = Option<(u32, u32)>;

/// What the store says of the oracle in a maze; `None` if it says nothing.
pub(super) fn oracle_row(
    connection: &Connection,
    maze: i64,
    rules: i64,
) -> Result<Option<OracleSteps>, StoreErrorKind> {
    let mut statement = connection.prepare_cached(
        "SELECT oracle_exploration, oracle_speed FROM oracle WHERE maze = ?1 AND rules = ?2",
    )?;
    let row = statement.query_row([maze, rules], |row| {
        let exploration: Option<u32> = row.get(0)?;
        Ok(exploration.zip(row.get(1)?))
    });
    Ok(row.optional()?)
}

/// Fails if the store says something wrong of the oracle in a maze. Returns what it says.
pub(super) fn check_oracle(
    connection: &Connection,
    digest: &Digest,
    maze: &Maze,
    rules_id: i64,
    rules: &Ruleset,
) -> Result<Option<OracleSteps>, StoreErrorKind> {
    let Some(id) = ids::find(connection, Table::Maze, digest)? else {
        return Ok(None);
    };
    let said = oracle_row(connection, id, rules_id)?;
    if let Some(steps) = said {
        let oracle = rules.game.oracle_score(maze);
        let oracle = oracle.map(|it| (it.exploration_steps(), it.speed_steps()));
        if oracle != steps {
            let problem = format!("maze {digest}: its oracle score is wrong");
            return Err(StoreErrorKind::Damaged(problem));
        }
    }
    Ok(said)
}

/// The number of bytes before the walls: those of [`Maze::identity_bytes`].
const HEADER: usize = 7;

/// A maze in about a quarter of its [identity bytes](Maze::identity_bytes): their first seven,
/// then two bits for each cell, whether it is open up (1) and right (2). The other two sides are
/// those of its neighbours.
pub(super) fn pack(maze: &Maze) -> Vec<u8> {
    let identity = maze.identity_bytes();
    let (header, values) = identity.split_at(HEADER);
    let mut bytes = header.to_vec();
    bytes.extend(values.chunks(4).map(|values| {
        let cells = values.iter().enumerate();
        cells.fold(0, |byte, (place, value)| byte | (value & 3) << (2 * place))
    }));
    bytes
}

/// The maze of such bytes; `None` if there is none.
pub(super) fn unpack(bytes: &[u8]) -> Option<Maze> {
    let (&[dimension, start_x, start_y, goal_x, goal_y, width, height], packed) =
        bytes.split_first_chunk::<HEADER>()?;
    let cells = usize::from(dimension) * usize::from(dimension);
    if !DIMENSIONS.contains(&dimension) || packed.len() != cells.div_ceil(4) {
        return None;
    }
    let mut walls = Walls::closed(dimension);
    for (index, cell) in walls.cells().enumerate() {
        let value = packed[index / 4] >> (2 * (index % 4));
        for heading in [Heading::Up, Heading::Right] {
            if value & heading.bit() != 0 {
                walls.neighbor(cell, heading)?;
                walls.set(cell, heading, true);
            }
        }
    }
    let goal = Area::new(Cell::new(goal_x, goal_y), width, height)?;
    Maze::new(walls, Cell::new(start_x, start_y), goal).ok()
}
