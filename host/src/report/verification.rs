//! What `wasmouse verify` prints, as text and as JSON.
//!
//! ```json
//! {
//!   "schema": 1, "wasmouse": "0.1.0", "engine": "wasmtime-48.0.8+wasmouse.1",
//!   "verified": false,
//!   "results": [{
//!     "file": "results.json", "status": "differs",
//!     "matches": 140, "matches_expected": 140,
//!     "differences_count": 1,
//!     "differences": [{
//!       "path": "matches[17].steps_fuel", "recorded": 267289,
//!       "source": "played", "found": 267290,
//!       "match": {"robot": "flood", "maze": "tree-16", "seed": 3}
//!     }],
//!     "not_at_hand": [{"path": "robots[3]", "name": "bot", "sha256": "..."}],
//!     "problem": null
//!   }]
//! }
//! ```
//!
//! `status` is `verified`, `differs`, or `unclear` when the document could not be
//! read, not all was at hand, or not all matches could be played: `problem` says why.
//! `source` says where `found` comes from. At most 10,000 differences are listed.

use std::fmt;

use serde::Serialize;

use super::result::{ContestReport, Difference, Differences};
use super::{json, visible};
use crate::robot::engine_id;

/// The version of this JSON; raised when a reader of the old one would go wrong.
const SCHEMA: u32 = 1;

/// Differences that the text lists.
const LISTED_MAX: usize = 20;

/// What came of verifying one document.
#[derive(Debug, Default, Serialize)]
pub struct FileReport {
    file: String,
    status: Status,
    matches: usize,
    matches_expected: u128,
    #[serde(skip)]
    robots: usize,
    #[serde(skip)]
    mazes: usize,
    differences_count: usize,
    differences: Vec<Difference>,
    not_at_hand: Vec<NotAtHand>,
    problem: Option<String>,
}

/// A robot or maze that would be needed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotAtHand {
    /// Its place in the document, such as `robots[3]`.
    pub path: String,
    /// Its name in the document.
    pub name: String,
    /// Its digest in the document.
    pub sha256: String,
}

/// The result for one document.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Status {
    Verified,
    Differs,
    #[default]
    Unclear,
}

impl FileReport {
    /// A document that could not be read.
    pub fn unreadable(file: &str, problem: &str) -> Self {
        Self {
            file: file.to_owned(),
            problem: Some(problem.to_owned()),
            ..Self::default()
        }
    }

    /// A document that was read: what is wrong with it, and what kept it from being
    /// verified.
    pub fn new(
        file: &str,
        report: &ContestReport<'_>,
        differences: &Differences,
        not_at_hand: Vec<NotAtHand>,
        problem: Option<String>,
    ) -> Self {
        let status = if differences.count() > 0 {
            Status::Differs
        } else if not_at_hand.is_empty() && problem.is_none() {
            Status::Verified
        } else {
            Status::Unclear
        };
        Self {
            file: file.to_owned(),
            status,
            matches: report.matches(),
            matches_expected: report.matches_expected(),
            robots: report.robots().len(),
            mazes: report.mazes().len(),
            differences_count: differences.count(),
            differences: differences.kept().to_vec(),
            not_at_hand,
            problem,
        }
    }

    /// Whether something is wrong with it.
    pub fn differs(&self) -> bool {
        self.status == Status::Differs
    }
}

impl fmt::Display for FileReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = visible(&self.file);
        match self.status {
            Status::Unclear => writeln!(f, "{file}: not verified"),
            Status::Verified => {
                write!(f, "{file}: verified, {}", counted(self.matches, "match"))?;
                let (robots, mazes) = (counted(self.robots, "robot"), counted(self.mazes, "maze"));
                write!(f, " of {robots} in {mazes}")?;
                if self.matches as u128 != self.matches_expected {
                    write!(
                        f,
                        ", all that the document has of {}",
                        self.matches_expected
                    )?;
                }
                writeln!(f)
            }
            Status::Differs => {
                let count = counted(self.differences_count, "difference");
                writeln!(f, "{file}: {count}")?;
                for difference in self.differences.iter().take(LISTED_MAX) {
                    writeln!(f, "  {difference}")?;
                }
                match self.differences_count.saturating_sub(LISTED_MAX) {
                    0 => Ok(()),
                    rest => writeln!(f, "  and {rest} more; --json lists them"),
                }
            }
        }
    }
}

/// A number with the word for it.
fn counted(number: usize, word: &str) -> String {
    let ending = match (number, word) {
        (1, _) => "",
        (_, "match") => "es",
        _ => "s",
    };
    format!("{number} {word}{ending}")
}

#[derive(Serialize)]
struct Wire<'a> {
    schema: u32,
    wasmouse: &'static str,
    engine: String,
    verified: bool,
    results: &'a [FileReport],
}

/// The JSON for all documents, with a newline at the end.
pub fn to_json(results: &[FileReport]) -> String {
    let wire = Wire {
        schema: SCHEMA,
        wasmouse: env!("CARGO_PKG_VERSION"),
        engine: engine_id(),
        verified: results.iter().all(|it| it.status == Status::Verified),
        results,
    };
    json::document(&wire)
}
