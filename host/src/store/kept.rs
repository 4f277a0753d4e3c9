//! [`Store::kept_matches`]: the matches that can be watched, because their transcript is kept.

use std::collections::HashMap;

use rusqlite::Connection;
use wasmouse_core::game::Ruleset;
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::maze::Maze;
use wasmouse_core::record::{MatchRecord, Transcript};
use wasmouse_core::{Digest, GuestText};

use super::columns::text_at;
use super::error::{StoreError, StoreErrorKind};
use super::ids::digest_at;
use super::mazes::stored_maze;
use super::open::Store;
use super::scan::{Catalog, each_transcript, found};
use super::writer::find_record;
use super::{submissions, transcripts};

/// What people call a match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeptName<'a> {
    /// The name under which the robot was submitted last; the first digits of its digest if it was
    /// not.
    pub robot: GuestStr<'a>,
    /// The name of the maze.
    pub maze: GuestStr<'a>,
    /// The seed.
    pub seed: u64,
}

/// A match whose transcript is kept.
#[derive(Clone, Debug)]
pub struct KeptMatch {
    /// The name under which the robot was submitted.
    pub robot: GuestText,
    /// The name of the maze.
    pub maze_name: GuestText,
    /// The maze.
    pub maze: Maze,
    /// The rules.
    pub rules: Ruleset,
    /// The record.
    pub record: MatchRecord,
    /// The robot's actions.
    pub transcript: Transcript,
}

impl Store {
    /// Passes the matches whose transcript is kept to `visit`, if `is_wanted` by their name, robots
    /// one after the other. Ends early when `visit` returns `false`.
    ///
    /// # Errors
    ///
    /// When the store cannot be read, or a transcript is not the one of its record.
    pub fn kept_matches(
        &self,
        is_wanted: &mut dyn FnMut(KeptName<'_>) -> bool,
        visit: &mut dyn FnMut(KeptMatch) -> bool,
    ) -> Result<(), StoreError> {
        match self.read(|connection| Ok(kept(connection, is_wanted, visit))) {
            Ok(Ok(()) | Err(Stop::Early)) => Ok(()),
            Ok(Err(Stop::Error(kind))) => Err(kind.at(self.path())),
            Err(error) => Err(error),
        }
    }
}

/// Why a search ends before its end.
enum Stop {
    Early,
    Error(StoreErrorKind),
}

impl<E: Into<StoreErrorKind>> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Error(error.into())
    }
}

fn kept(
    connection: &Connection,
    is_wanted: &mut dyn FnMut(KeptName<'_>) -> bool,
    visit: &mut dyn FnMut(KeptMatch) -> bool,
) -> Result<(), Stop> {
    let catalog = Catalog::load(connection)?;
    // The last submission of a robot is the one whose name it has.
    let submissions = submissions::all(connection)?.into_iter();
    let names: HashMap<(Digest, u32), GuestText> = submissions
        .map(|it| ((it.robot, it.variant), it.name))
        .collect();
    let mazes = maze_names(connection)?;
    each_transcript(connection, |row| -> Result<(), Stop> {
        let at = &row.at;
        let robot = *found(&catalog.robots, at.robot)?;
        let short = || format!("{:.12}", robot.to_string()).into();
        let robot = names.get(&(robot, at.variant)).cloned();
        let robot = robot.unwrap_or_else(short);
        let (maze_digest, maze_name) = found(&mazes, at.maze)?;
        let name = KeptName {
            robot: robot.as_guest(),
            maze: maze_name.as_guest(),
            seed: at.seed.cast_unsigned(),
        };
        if !is_wanted(name) {
            return Ok(());
        }
        let key = catalog.key(at)?;
        let rules = catalog.rules(at)?;
        let record = find_record(connection, at, &key, rules)?
            .ok_or_else(|| StoreErrorKind::Damaged("a transcript has no match".to_owned()))?;
        let transcript = transcripts::decode(row.bytes, &record.transcript, &key)?;
        let maze = stored_maze(connection, maze_digest)?
            .ok_or_else(|| StoreErrorKind::Damaged("a match has no maze".to_owned()))?;
        let goes_on = visit(KeptMatch {
            robot,
            maze_name: maze.name,
            maze: maze.maze,
            rules: rules.clone(),
            record,
            transcript,
        });
        if goes_on { Ok(()) } else { Err(Stop::Early) }
    })
}

fn maze_names(
    connection: &Connection,
) -> Result<HashMap<i64, (Digest, GuestText)>, StoreErrorKind> {
    let mut statement = connection.prepare("SELECT id, digest, name FROM maze")?;
    let rows = statement.query_map([], |row| {
        Ok((row.get(0)?, (digest_at(row, 1)?, text_at(row, 2)?)))
    })?;
    Ok(rows.collect::<Result<_, _>>()?)
}
