//! Matches that were not played, and why.

use rusqlite::{Connection, params};
use wasmouse_core::GuestText;
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::record::MatchKey;

use super::columns::column;
use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, Address, Table};
use super::keys::{MatchKeys, maze_positions};
use super::open::Store;

/// Why a match was not played.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// The host failed, which says nothing about the robot.
    Failed,
    /// The robot was withdrawn, because its matches took too long.
    Withdrawn,
}

/// A match that was not played. It is forgotten as soon as the match is played.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unplayed {
    /// Which match.
    pub key: MatchKey,
    /// Why.
    pub cause: Cause,
    /// Why, in words.
    pub reason: GuestText,
}

impl Cause {
    /// The code of the column `cause`.
    pub(super) const fn code(self) -> u8 {
        match self {
            Self::Failed => 0,
            Self::Withdrawn => 1,
        }
    }

    /// The cause of a code.
    pub(super) fn of_code(code: u8) -> Result<Self, StoreErrorKind> {
        match code {
            0 => Ok(Self::Failed),
            1 => Ok(Self::Withdrawn),
            _ => Err(StoreErrorKind::Damaged(format!(
                "an unplayed match has cause {code}"
            ))),
        }
    }
}

impl Store {
    /// The matches of a plan that were not played for a reason, in the order of the plan. Matches
    /// that were never tried are not among them.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn unplayed(&self, keys: &MatchKeys<'_>) -> Result<Vec<Unplayed>, StoreError> {
        self.read(|connection| {
            let mut found = Vec::new();
            let mazes = maze_positions(connection, keys.mazes)?;
            each(connection, keys, |player, maze, seed, cause, reason| {
                let maze = mazes.get(&maze).copied();
                let position = keys.seed_position(seed.cast_unsigned());
                if let (Some(maze), Some(seed)) = (maze, position) {
                    let unplayed = Unplayed {
                        key: keys.key(player, maze, seed),
                        cause,
                        reason: reason.into(),
                    };
                    found.push(((maze, seed, player), unplayed));
                }
            })?;
            found.sort_unstable_by_key(|(position, _)| *position);
            Ok(found.into_iter().map(|(_, unplayed)| unplayed).collect())
        })
    }
}

/// Calls `visit` with player, maze id, seed, cause and reason of every unplayed match of the
/// players.
pub(super) fn each(
    connection: &Connection,
    keys: &MatchKeys<'_>,
    mut visit: impl FnMut(usize, i64, i64, Cause, GuestStr<'_>),
) -> Result<(), StoreErrorKind> {
    let engine = ids::find(connection, Table::Engine, &keys.engine)?;
    let rules = ids::find(connection, Table::Rules, &keys.rules)?;
    let mut statement = connection.prepare_cached(
        "SELECT maze, seed, cause, reason FROM unplayed \
         WHERE engine = ?1 AND rules = ?2 AND robot = ?3 AND variant = ?4",
    )?;
    for (player, (robot, variant)) in keys.players.iter().enumerate() {
        let robot = ids::find(connection, Table::Robot, robot)?;
        let mut rows = statement.query(params![engine, rules, robot, variant])?;
        while let Some(row) = rows.next()? {
            let reason = row.get_ref(3)?.as_str().unwrap_or_default();
            let cause = Cause::of_code(row.get(2)?)?;
            visit(player, row.get(0)?, row.get(1)?, cause, reason.into());
        }
    }
    Ok(())
}

/// The beginning of a statement that adds an unplayed match, unless it was played.
macro_rules! insert {
    () => {
        "INSERT INTO unplayed(engine, rules, robot, variant, maze, seed, cause, reason) \
         SELECT ?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8 WHERE NOT EXISTS(SELECT 1 FROM match \
         WHERE engine = ?1 AND rules = ?2 AND robot = ?3 AND variant = ?4 AND maze = ?5 \
         AND seed = ?6) \
         ON CONFLICT DO UPDATE SET cause = excluded.cause, reason = excluded.reason"
    };
}

/// Records that a match was not played, unless it was. The last reason counts.
pub(super) fn put(
    connection: &Connection,
    at: &Address,
    cause: Cause,
    reason: GuestStr<'_>,
) -> Result<(), StoreErrorKind> {
    execute(connection, insert!(), at, cause, reason)
}

/// Like [`put`], but the least reason counts, so that the order does not matter.
pub(super) fn put_least(
    connection: &Connection,
    at: &Address,
    cause: Cause,
    reason: GuestStr<'_>,
) -> Result<(), StoreErrorKind> {
    const SQL: &str = concat!(
        insert!(),
        " WHERE (excluded.cause, excluded.reason) < (cause, reason)"
    );
    execute(connection, SQL, at, cause, reason)
}

fn execute(
    connection: &Connection,
    sql: &str,
    at: &Address,
    cause: Cause,
    reason: GuestStr<'_>,
) -> Result<(), StoreErrorKind> {
    let mut statement = connection.prepare_cached(sql)?;
    statement.execute(params![
        at.engine,
        at.rules,
        at.robot,
        at.variant,
        at.maze,
        at.seed,
        cause.code(),
        column(reason),
    ])?;
    Ok(())
}
