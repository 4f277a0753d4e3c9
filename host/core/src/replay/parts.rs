//! [`Replay`] and what it is made of.

use super::error::ReplayFileError;
use crate::game::{Ruleset, Trace};
use crate::guest_text::GuestText;
use crate::journal::{Journal, NoteOf};
use crate::maze::Maze;
use crate::playback::Playback;
use crate::record::{GameResult, MatchRecord, Transcript, trace};
use crate::{Digest, DigestBuilder};

/// The largest replay that programs should read, in bytes. A journal has at most 1 MiB in the
/// rulesets of wasmouse, and a transcript about a byte for each step.
pub const BYTES_MAX: u64 = 16 << 20;

/// Longest name of a robot or a maze, in characters.
pub const NAME_CHARS_MAX: usize = 200;

/// What a replay is made of.
#[derive(Clone, Debug)]
pub struct ReplayParts {
    /// The name of the robot.
    pub robot: GuestText,
    /// The name of the maze.
    pub maze_name: GuestText,
    /// The maze.
    pub maze: Maze,
    /// The rules.
    pub rules: Ruleset,
    /// The record of the match.
    pub record: MatchRecord,
    /// The robot's actions.
    pub transcript: Transcript,
    /// What the robot wrote; empty if nobody kept it.
    pub journal: Journal,
}

/// A match that can be watched without its robot.
///
/// # Format
///
/// Serialises as an object, in JSON in files that end in `.replay.json`:
///
/// | key | value |
/// |---|---|
/// | `format`, `version` | `"wasmouse-replay"`, 1 |
/// | `robot` | the name of the robot |
/// | `maze` | `name`, `start` and `goal` (`x`, `y`, `width`, `height`) in cells, and `columns`: for each column from the left, a hexadecimal digit for each cell from the bottom up, the sum of the sides that are open (1 up, 2 right, 4 down, 8 left) |
/// | `rules` | the [`Ruleset`] |
/// | `record` | the [`MatchRecord`] |
/// | `transcript` | the [bytes](Transcript::to_bytes) of the transcript in Base64 |
/// | `journal` | what the robot wrote, in order; left out if empty |
/// | `digest` | [`Replay::digest`] |
///
/// Reading one checks the digests of maze, rules, transcript and file, plays the transcript, and
/// compares the result with the record.
///
/// ```
/// use wasmouse_core::game::{Action, Ruleset};
/// use wasmouse_core::journal::Journal;
/// use wasmouse_core::maze::{Maze, Turn, Walls};
/// use wasmouse_core::record::{MatchKey, MatchRecord, Transcript, Usage, replay};
/// use wasmouse_core::replay::{Replay, ReplayParts};
/// use wasmouse_core::Digest;
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let mut rules = Ruleset::default();
/// rules.game.budget = 1;
/// let mut transcript = Transcript::default();
/// transcript.push(Action::Move { turn: Turn::Straight, advance: 3 });
/// let result = replay(&maze, &rules.game, &transcript).expect("a whole match");
/// let key = MatchKey {
///     engine: Digest::of(b"an engine"),
///     rules: rules.digest(),
///     robot: Digest::of(b"a robot"),
///     variant: 0,
///     maze: maze.digest(),
///     seed: 0,
/// };
/// let record = MatchRecord::new(key, result, Usage::default(), &transcript);
/// let (robot, maze_name) = ("mouse".into(), "hall".into());
/// let journal = Journal::default();
/// let parts = ReplayParts { robot, maze_name, maze, rules, record, transcript, journal };
/// let replay = Replay::new(parts).expect("it fits together");
///
/// let json = serde_json::to_string(&replay)?;
/// let read: Replay = serde_json::from_str(&json)?;
/// assert_eq!(read.digest(), replay.digest());
/// assert_eq!(read.playback().last(), 1);
/// let error = serde_json::from_str::<Replay>(&json.replace("hall", "wall"));
/// let error = error.expect_err("another name");
/// assert!(error.to_string().contains("the digest of the replay"), "{error}");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Replay {
    parts: ReplayParts,
    trace: Trace,
}

impl Replay {
    /// The replay of a match.
    ///
    /// # Errors
    ///
    /// If the parts contradict each other, or a name is too long.
    pub fn new(parts: ReplayParts) -> Result<Self, ReplayFileError> {
        let ReplayParts {
            robot,
            maze_name,
            maze,
            rules,
            record,
            transcript,
            ..
        } = &parts;
        for (what, name) in [("robot", robot), ("maze", maze_name)] {
            if name.as_guest().cut(NAME_CHARS_MAX).1 {
                return Err(ReplayFileError::LongName(what));
            }
        }
        let digests = [
            ("maze", maze.digest(), record.key.maze),
            ("rules", rules.digest(), record.key.rules),
            ("transcript", transcript.digest(), record.transcript),
        ];
        for (what, found, expected) in digests {
            if found != expected {
                return Err(ReplayFileError::Digest {
                    what,
                    found,
                    expected,
                });
            }
        }
        let (result, trace) = trace(maze, &rules.game, transcript)?;
        check_result(record, &result)?;
        Ok(Self { parts, trace })
    }

    /// What the replay is made of.
    pub const fn parts(&self) -> &ReplayParts {
        &self.parts
    }

    /// Every step, with its readings and effect.
    pub const fn trace(&self) -> &Trace {
        &self.trace
    }

    /// The match to watch.
    pub fn playback(&self) -> Playback {
        let parts = &self.parts;
        Playback::new(
            parts.maze.clone(),
            parts.rules.game,
            self.trace.clone(),
            parts.record.verdict.clone(),
            parts.journal.clone(),
        )
    }

    /// The identity of everything in the replay.
    ///
    /// Canonical encoding `wasmouse.replay.1` ([`DigestBuilder`]): the names of the robot, the maze
    /// and the rules as bytes; the digests of the match key and the transcript; the version of the
    /// rules; fuel of `start`, of all
    /// steps and of the most expensive step, memory in bytes, entries of the journal and entries
    /// that were dropped; then, for each entry that is kept, the step and a code (0 to 3 log, 4
    /// paint, 5 label, 6 wall) with its parts in the order of [`NoteOf`], numbers first.
    pub fn digest(&self) -> Digest {
        let ReplayParts {
            robot,
            maze_name,
            rules,
            record,
            journal,
            ..
        } = &self.parts;
        let builder = DigestBuilder::new("wasmouse.replay.1")
            .bytes(robot.raw().as_bytes())
            .bytes(maze_name.raw().as_bytes())
            .bytes(rules.name.as_bytes())
            .digest(&record.key.digest())
            .digest(&record.transcript)
            .numbers(&[
                rules.version.into(),
                record.fuel.start,
                record.fuel.steps,
                record.fuel.step_max,
                record.memory_bytes,
                record.journal.entries,
                record.journal.dropped,
            ]);
        let builder = journal.entries().fold(builder, |builder, entry| {
            let step = entry.step.into();
            match entry.note {
                NoteOf::Log { level, text } => builder
                    .numbers(&[step, level as u64])
                    .bytes(text.raw().as_bytes()),
                NoteOf::Paint { cell, color } => {
                    builder.numbers(&[step, 4, cell.x.into(), cell.y.into(), color as u64])
                }
                NoteOf::Label { cell, text } => builder
                    .numbers(&[step, 5, cell.x.into(), cell.y.into()])
                    .bytes(text.raw().as_bytes()),
                NoteOf::Wall { cell, side, belief } => builder.numbers(&[
                    step,
                    6,
                    cell.x.into(),
                    cell.y.into(),
                    side as u64,
                    belief as u64,
                ]),
            }
        });
        builder.finish()
    }
}

/// Checks that a record says what came of its transcript.
fn check_result(record: &MatchRecord, result: &GameResult) -> Result<(), ReplayFileError> {
    let what = if record.steps != result.steps {
        "steps"
    } else if record.verdict != result.verdict {
        "verdict"
    } else if record.counts != result.counts {
        "counts"
    } else {
        return Ok(());
    };
    Err(ReplayFileError::Record(what))
}
