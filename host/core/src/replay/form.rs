//! [`Replay`] is serialised as an object and checked when it is deserialised.

use data_encoding::BASE64;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::error::ReplayFileError;
use super::parts::{Replay, ReplayParts};
use crate::Digest;
use crate::game::Ruleset;
use crate::guest_text::GuestText;
use crate::journal::{Belief, Color, Journal, Level, Note, NoteOf};
use crate::maze::{Cell, Heading, Maze};
use crate::record::{MatchRecord, Transcript};

const FORMAT: &str = "wasmouse-replay";
const VERSION: u32 = 1;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Form {
    format: String,
    version: u32,
    robot: GuestText,
    maze: MazeForm,
    rules: Ruleset,
    record: MatchRecord,
    transcript: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    journal: Vec<EntryForm>,
    digest: Digest,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct MazeForm {
    name: GuestText,
    start: Cell,
    goal: GoalForm,
    columns: Vec<String>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GoalForm {
    x: u8,
    y: u8,
    width: u8,
    height: u8,
}

/// An entry of the journal, by the kind of its note.
#[derive(Serialize, Deserialize)]
#[serde(tag = "note", rename_all = "kebab-case", deny_unknown_fields)]
enum EntryForm {
    Log {
        step: u32,
        level: Level,
        text: GuestText,
    },
    Paint {
        step: u32,
        x: u8,
        y: u8,
        color: Color,
    },
    Label {
        step: u32,
        x: u8,
        y: u8,
        text: GuestText,
    },
    Wall {
        step: u32,
        x: u8,
        y: u8,
        side: Heading,
        belief: Belief,
    },
}

impl Serialize for Replay {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Form::from(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Replay {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let form = Form::deserialize(deserializer)?;
        Self::try_from(form).map_err(D::Error::custom)
    }
}

impl From<&Replay> for Form {
    fn from(replay: &Replay) -> Self {
        let parts = replay.parts();
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            robot: parts.robot.clone(),
            maze: MazeForm::new(parts.maze_name.clone(), &parts.maze),
            rules: parts.rules.clone(),
            record: parts.record.clone(),
            transcript: BASE64.encode(&parts.transcript.to_bytes()),
            journal: entries(&parts.journal),
            digest: replay.digest(),
        }
    }
}

impl TryFrom<Form> for Replay {
    type Error = ReplayFileError;

    fn try_from(form: Form) -> Result<Self, ReplayFileError> {
        if form.format != FORMAT {
            return Err(ReplayFileError::Format);
        }
        if form.version != VERSION {
            return Err(ReplayFileError::Version(form.version));
        }
        let maze = form.maze.maze()?;
        let bytes = BASE64
            .decode(form.transcript.as_bytes())
            .map_err(|error| ReplayFileError::Base64(error.position))?;
        let replay = Self::new(ReplayParts {
            robot: form.robot,
            maze_name: form.maze.name,
            maze,
            rules: form.rules,
            record: form.record,
            transcript: Transcript::from_bytes(&bytes)?,
            journal: journal(form.journal),
        })?;
        let (found, expected) = (replay.digest(), form.digest);
        if found != expected {
            return Err(ReplayFileError::Changed { found, expected });
        }
        Ok(replay)
    }
}

impl MazeForm {
    fn new(name: GuestText, maze: &Maze) -> Self {
        let (n, goal) = (maze.dimension(), maze.goal());
        let digit = |x, y| char::from_digit(maze.walls().value(Cell::new(x, y)).into(), 16);
        let digit = |x, y| digit(x, y).expect("the value of a cell is below 16");
        Self {
            name,
            start: maze.start(),
            goal: GoalForm {
                x: goal.origin().x,
                y: goal.origin().y,
                width: goal.width(),
                height: goal.height(),
            },
            columns: (0..n)
                .map(|x| (0..n).map(|y| digit(x, y)).collect())
                .collect(),
        }
    }

    fn maze(&self) -> Result<Maze, ReplayFileError> {
        let (start, goal, columns) = (self.start, &self.goal, self.columns.len());
        let dimension = u8::try_from(columns).map_err(|_| ReplayFileError::Maze)?;
        let goal = [goal.x, goal.y, goal.width, goal.height];
        let mut bytes = vec![dimension, start.x, start.y];
        bytes.extend_from_slice(&goal);
        for (column, text) in self.columns.iter().enumerate() {
            let cells = text.chars().count();
            if cells != columns {
                return Err(ReplayFileError::Column {
                    column,
                    cells,
                    columns,
                });
            }
            for (row, character) in text.chars().enumerate() {
                // A maze has one form.
                let digit = character.to_digit(16).filter(|_| !character.is_uppercase());
                let value = digit.and_then(|digit| u8::try_from(digit).ok());
                bytes.push(value.ok_or(ReplayFileError::Cell { column, row })?);
            }
        }
        Maze::from_identity_bytes(&bytes).ok_or(ReplayFileError::Maze)
    }
}

fn entries(journal: &Journal) -> Vec<EntryForm> {
    let form = |step, note: Note<'_>| match note {
        NoteOf::Log { level, text } => EntryForm::Log {
            step,
            level,
            text: text.into(),
        },
        NoteOf::Paint { cell, color } => EntryForm::Paint {
            step,
            x: cell.x,
            y: cell.y,
            color,
        },
        NoteOf::Label { cell, text } => EntryForm::Label {
            step,
            x: cell.x,
            y: cell.y,
            text: text.into(),
        },
        NoteOf::Wall { cell, side, belief } => EntryForm::Wall {
            step,
            x: cell.x,
            y: cell.y,
            side,
            belief,
        },
    };
    let entries = journal.entries();
    entries.map(|entry| form(entry.step, entry.note)).collect()
}

fn journal(entries: Vec<EntryForm>) -> Journal {
    let mut journal = Journal::default();
    // The size of the file is what limits it.
    journal.clear(u64::MAX);
    for entry in &entries {
        match *entry {
            EntryForm::Log {
                step,
                level,
                ref text,
            } => {
                let text = text.as_guest();
                journal.push(step, Note::Log { level, text });
            }
            EntryForm::Paint { step, x, y, color } => {
                let cell = Cell::new(x, y);
                journal.push(step, Note::Paint { cell, color });
            }
            EntryForm::Label {
                step,
                x,
                y,
                ref text,
            } => {
                let (cell, text) = (Cell::new(x, y), text.as_guest());
                journal.push(step, Note::Label { cell, text });
            }
            EntryForm::Wall {
                step,
                x,
                y,
                side,
                belief,
            } => {
                let cell = Cell::new(x, y);
                journal.push(step, Note::Wall { cell, side, belief });
            }
        }
    }
    journal
}
