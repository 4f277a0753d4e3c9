//! [`Sink`]: what becomes of the matches of a contest as they end.

use std::io;

use serde::{Deserialize, Serialize};
use wasmouse_core::GuestText;
use wasmouse_core::record::{MatchKey, MatchRecord, Transcript};

use super::maze_source::ContestMaze;

/// A match of a contest that was played.
#[derive(Clone, Debug)]
pub struct ContestMatch {
    /// Index of the player, in the order of [`Plan::players`](super::Plan::players).
    pub player: usize,
    /// What came of it.
    pub record: MatchRecord,
    /// The robot's actions.
    pub transcript: Transcript,
}

/// A match that the host could not play, even when tried again. It says nothing about the
/// robot, counts for nothing, and has to be played another time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatchFailure {
    /// Which match.
    pub key: MatchKey,
    /// What went wrong.
    pub reason: GuestText,
}

/// What came of a match of a contest.
#[derive(Clone, Debug)]
pub enum Ended {
    /// It was played.
    Played(ContestMatch),
    /// The host could not play it.
    Failed(MatchFailure),
    /// It was not played because its robot was withdrawn, and why.
    Withdrawn(MatchFailure),
}

/// Receives the matches of a contest in the order of its plan, whatever the number of threads.
pub trait Sink: Send {
    /// A maze, before the first of its matches.
    ///
    /// # Errors
    ///
    /// When the sink cannot go on.
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        let _ = maze;
        Ok(())
    }

    /// A match that was played.
    ///
    /// # Errors
    ///
    /// When the sink cannot go on: a full disk, say.
    fn played(&mut self, played: &ContestMatch) -> io::Result<()>;

    /// A match that the host could not play.
    ///
    /// # Errors
    ///
    /// When the sink cannot go on.
    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        let _ = failure;
        Ok(())
    }

    /// A match that was not played because its robot was withdrawn, and why.
    ///
    /// # Errors
    ///
    /// When the sink cannot go on.
    fn withdrawn(&mut self, failure: &MatchFailure) -> io::Result<()> {
        let _ = failure;
        Ok(())
    }
}

/// Passes everything on to several sinks, in their order.
pub struct Tee<'a>(pub Vec<&'a mut dyn Sink>);

impl Tee<'_> {
    fn each(&mut self, mut call: impl FnMut(&mut dyn Sink) -> io::Result<()>) -> io::Result<()> {
        self.0.iter_mut().try_for_each(|sink| call(&mut **sink))
    }
}

impl Sink for Tee<'_> {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.each(|sink| sink.maze(maze))
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        self.each(|sink| sink.played(played))
    }

    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.each(|sink| sink.failed(failure))
    }

    fn withdrawn(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.each(|sink| sink.withdrawn(failure))
    }
}

/// Keeps the records, up to a number, and counts the rest.
#[derive(Debug, Default)]
pub struct RecordList {
    max: u64,
    records: Vec<MatchRecord>,
    count: u64,
}

impl RecordList {
    /// A list of at most `max` records.
    pub const fn new(max: u64) -> Self {
        Self {
            max,
            records: Vec::new(),
            count: 0,
        }
    }

    /// The records; `None` when there were too many.
    pub fn into_records(self) -> Option<Vec<MatchRecord>> {
        (self.count <= self.max).then_some(self.records)
    }
}

impl Sink for RecordList {
    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        self.count += 1;
        if self.count <= self.max {
            self.records.push(played.record.clone());
        } else {
            // What does not fit is not worth its memory any more.
            self.records = Vec::new();
        }
        Ok(())
    }
}
