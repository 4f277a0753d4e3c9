//! The JSON of `wasmouse maze check`.
//!
//! ```json
//! {
//!   "version": 2,
//!   "mazes": [
//!     {"source": "a.txt", "format": "udacity", "digest": "...", "dimension": 12,
//!      "legal": true, "violations": []},
//!     {"source": "b.txt", "error": "failed to parse maze `b.txt`: the text is empty"}
//!   ],
//!   "summary": {
//!     "files": 2, "mazes": 1, "contest_legal": 1, "solvable": 1,
//!     "with_unreachable_cells": 0, "with_several_entrances": 0,
//!     "by_entrances": {"1": 1}
//!   }
//! }
//! ```
//!
//! `mazes` is left out when only a summary is wanted. `format` is null for a generated maze.

use std::collections::BTreeMap;

use serde::Serialize;
use wasmouse_core::maze::format::Format;
use wasmouse_core::maze::{Cell, Maze, Survey, Violation};
use wasmouse_core::{Digest, GuestText};

use super::json;

/// The version of this document; raised when a reader of the old one would go wrong.
const VERSION: u32 = 2;

/// The whole document.
#[derive(Serialize)]
pub struct MazeCheck {
    version: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    mazes: Option<Vec<CheckedMaze>>,
    summary: Summary,
}

impl MazeCheck {
    /// The document for these mazes, or for a summary alone.
    pub fn new(mazes: Option<Vec<CheckedMaze>>, survey: &Survey) -> Self {
        Self {
            version: VERSION,
            mazes,
            summary: Summary::new(survey),
        }
    }

    /// The document as text, indented, with a newline at the end.
    pub fn to_json(&self) -> String {
        json::document(self)
    }
}

/// The findings about one maze.
#[derive(Serialize)]
pub struct CheckedMaze {
    source: GuestText,
    #[serde(flatten)]
    finding: Finding,
}

impl CheckedMaze {
    /// A maze that could be read, and the contest rules that it breaks.
    /// `format` is `None` when it did not come from text.
    pub fn read(
        source: GuestText,
        maze: &Maze,
        format: Option<Format>,
        violations: &[Violation],
    ) -> Self {
        let finding = Finding::Read {
            format: format.map(Format::name),
            digest: maze.digest(),
            dimension: maze.dimension(),
            legal: violations.is_empty(),
            violations: violations.iter().map(BrokenRule::new).collect(),
        };
        Self { source, finding }
    }

    /// A source that could not be read, or does not hold a maze.
    pub fn unreadable(source: GuestText, error: String) -> Self {
        let finding = Finding::Unreadable { error };
        Self { source, finding }
    }
}

#[derive(Serialize)]
#[serde(untagged)]
enum Finding {
    Read {
        format: Option<&'static str>,
        digest: Digest,
        dimension: u8,
        legal: bool,
        violations: Vec<BrokenRule>,
    },
    Unreadable {
        error: String,
    },
}

#[derive(Serialize)]
struct BrokenRule {
    rule: &'static str,
    message: String,
    cells: Vec<Cell>,
}

impl BrokenRule {
    fn new(violation: &Violation) -> Self {
        Self {
            rule: violation.rule(),
            message: violation.to_string(),
            cells: violation.cells(),
        }
    }
}

#[derive(Serialize)]
struct Summary {
    files: usize,
    mazes: usize,
    contest_legal: usize,
    solvable: usize,
    with_unreachable_cells: usize,
    with_several_entrances: usize,
    by_entrances: BTreeMap<usize, usize>,
}

impl Summary {
    fn new(survey: &Survey) -> Self {
        Self {
            files: survey.files,
            mazes: survey.parsed,
            contest_legal: survey.contest_legal,
            solvable: survey.solvable,
            with_unreachable_cells: survey.with_unreachable,
            with_several_entrances: survey.several_entrances(),
            by_entrances: survey.by_entrances.clone(),
        }
    }
}
