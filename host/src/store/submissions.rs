//! Submissions: who submitted which robot, with its history.

use std::collections::BTreeMap;

use rusqlite::{Connection, OptionalExtension as _, params};
use wasmouse_core::{Digest, GuestText};

use super::columns::{column, optional_text_at, text_at};
use super::error::{StoreError, StoreErrorKind};
use super::ids::{self, digest_at};
use super::open::Store;
use super::seal::unseal;
use crate::contest::RejectionEntry;

/// A robot that was submitted. The last one of a name counts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// What the standings call it.
    pub name: GuestText,
    /// Who submitted it, if that is known.
    pub author: Option<GuestText>,
    /// The class that it competes in, such as a fuel class.
    pub class: Option<GuestText>,
    /// The digest of its file.
    pub robot: Digest,
    /// The number that chooses its mode.
    pub variant: u32,
    /// Why it plays no match, if its file is rejected.
    pub rejection: Option<RejectionEntry>,
}

impl Store {
    /// Adds submissions, and returns how many were new: one that equals the last one of its name
    /// is not added again. What they supersede stays in the store.
    ///
    /// # Errors
    ///
    /// When the store cannot be written.
    pub fn submit(&mut self, submissions: &[Submission]) -> Result<usize, StoreError> {
        self.write(|transaction| {
            let mut added = 0;
            for submission in submissions {
                if last(transaction, &submission.name)?.as_ref() != Some(submission) {
                    append(transaction, submission)?;
                    added += 1;
                }
            }
            if added > 0 {
                unseal(transaction)?;
            }
            Ok(added)
        })
    }

    /// All submissions, the oldest first.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn submissions(&self) -> Result<Vec<Submission>, StoreError> {
        self.read(all)
    }

    /// The last submission of each name, in the order in which the names came.
    ///
    /// # Errors
    ///
    /// When the store cannot be read.
    pub fn current_submissions(&self) -> Result<Vec<Submission>, StoreError> {
        let mut places = BTreeMap::new();
        let mut current: Vec<Submission> = Vec::new();
        for submission in self.submissions()? {
            match places.get(&submission.name) {
                Some(&place) => current[place] = submission,
                None => {
                    places.insert(submission.name.clone(), current.len());
                    current.push(submission);
                }
            }
        }
        Ok(current)
    }
}

const SELECT: &str = "SELECT s.name, s.author, s.class, r.digest, s.variant, s.rejection_kind, \
     s.rejection_reason, s.rejection_hint FROM submission s JOIN robot r ON r.id = s.robot";

fn read(row: &rusqlite::Row<'_>) -> rusqlite::Result<Submission> {
    let rejection = match optional_text_at(row, 5)? {
        Some(kind) => Some(RejectionEntry {
            kind,
            reason: text_at(row, 6)?,
            hint: text_at(row, 7)?,
        }),
        None => None,
    };
    Ok(Submission {
        name: text_at(row, 0)?,
        author: optional_text_at(row, 1)?,
        class: optional_text_at(row, 2)?,
        robot: digest_at(row, 3)?,
        variant: row.get(4)?,
        rejection,
    })
}

/// All submissions, the oldest first.
pub(super) fn all(connection: &Connection) -> Result<Vec<Submission>, StoreErrorKind> {
    let mut statement = connection.prepare(&format!("{SELECT} ORDER BY s.ordinal"))?;
    let rows = statement.query_map([], read)?;
    Ok(rows.collect::<Result<_, _>>()?)
}

fn last(connection: &Connection, name: &GuestText) -> Result<Option<Submission>, StoreErrorKind> {
    let sql = format!("{SELECT} WHERE s.name = ?1 ORDER BY s.ordinal DESC LIMIT 1");
    let mut statement = connection.prepare_cached(&sql)?;
    Ok(statement.query_row([column(name)], read).optional()?)
}

/// Adds a submission.
pub(super) fn append(
    connection: &Connection,
    submission: &Submission,
) -> Result<(), StoreErrorKind> {
    let robot = ids::robot(connection, &submission.robot)?;
    let rejection = submission.rejection.as_ref();
    let mut statement = connection.prepare_cached(
        "INSERT INTO submission(name, author, class, robot, variant, rejection_kind, \
         rejection_reason, rejection_hint) VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)",
    )?;
    statement.execute(params![
        column(&submission.name),
        submission.author.as_ref().map(column),
        submission.class.as_ref().map(column),
        robot,
        submission.variant,
        rejection.map(|it| column(&it.kind)),
        rejection.map(|it| column(&it.reason)),
        rejection.map(|it| column(&it.hint)),
    ])?;
    Ok(())
}

/// What the last submission of that robot is called; the beginning of its digest if it has none.
pub(super) fn robot_name(
    connection: &Connection,
    robot: &Digest,
    variant: u32,
) -> Result<GuestText, StoreErrorKind> {
    let mut statement = connection.prepare_cached(
        "SELECT s.name FROM submission s JOIN robot r ON r.id = s.robot \
         WHERE r.digest = ?1 AND s.variant = ?2 ORDER BY s.ordinal DESC LIMIT 1",
    )?;
    let name = statement.query_row(params![robot.as_bytes(), variant], |row| text_at(row, 0));
    let name: Option<GuestText> = name.optional()?;
    Ok(name.unwrap_or_else(|| robot.to_string()[..12].into()))
}
