//! What `wasmouse verify` prints, as text and as JSON.
//!
//! ```json
//! {
//!   "version": 2, "wasmouse": "0.1.0", "engine": "wasmtime-48.0.8+wasmouse.5.x86-64-v2",
//!   "verified": false,
//!   "files": [{
//!     "file": "results.json", "matches": 140, "matches_planned": 140,
//!     "status": "changed",
//!     "differences_count": 1,
//!     "differences": [{
//!       "match": {"robot": "flood", "maze": "tree-16", "seed": 3},
//!       "field": "fuel.steps", "recorded": 267289, "found": 267290
//!     }],
//!     "not_found": [{"kind": "robot", "name": "bot", "digest": "..."}],
//!     "reason": null
//!   }]
//! }
//! ```
//!
//! `status` is `verified`, `reformatted` (with `line`), `changed`, `different-engine` (with
//! `recorded_engine` and `found_engine`) or `incomplete`. At most 10,000 differences are listed.

use std::fmt;

use serde::Serialize;
use serde_json::Value;
use wasmouse_core::record::{EngineId, MatchKey};
use wasmouse_core::{Digest, GuestText};
use wasmouse_engine::engine_id;

use super::engine_hint::engine_hint;
use super::escape::for_terminal;
use super::json;
use crate::contest::{FieldDifference, Names};

/// The version of this document; raised when a reader of the old one would go wrong.
const VERSION: u32 = 2;

/// Differences that are kept. More are only counted, so that a document in which everything is
/// wrong takes no more memory than others.
const KEPT_MAX: usize = 10_000;

/// Differences that the text lists.
const LISTED_MAX: usize = 20;

/// Characters of a value that the text shows.
const VALUE_CHARS_MAX: usize = 100;

/// The outcome for one document.
#[derive(Clone, Debug, Serialize)]
pub struct FileReport {
    /// The file.
    pub file: String,
    /// Matches in the document.
    pub matches: u64,
    /// Matches that its contest has.
    pub matches_planned: u64,
    /// Whether the document is as it would be written now.
    #[serde(flatten)]
    pub status: Status,
    /// What differs.
    #[serde(flatten)]
    pub differences: Differences,
    /// Robots and mazes that would be needed.
    pub not_found: Vec<NotFound>,
    /// Why the document was not verified, or not all of it.
    pub reason: Option<GuestText>,
}

/// The result for one document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "status", rename_all = "kebab-case")]
pub enum Status {
    /// Every byte is as it would be written now.
    Verified,
    /// Every value is as it would be written now, but the formatting differs.
    Reformatted {
        /// The first line that differs, counted from 1.
        line: usize,
    },
    /// Something is not as it would be written now.
    Changed,
    /// Another engine recorded it. Fuel and faults cannot be compared, so no match was played.
    DifferentEngine {
        /// The engine that recorded it.
        recorded_engine: EngineId,
        /// The engine of this program.
        found_engine: EngineId,
    },
    /// It could not be read, robots or mazes were not found, or not every match could be
    /// played.
    Incomplete,
}

/// A robot or maze that would be needed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotFound {
    /// Which of both.
    pub kind: NeededKind,
    /// Its name in the document.
    pub name: GuestText,
    /// Its digest in the document.
    pub digest: Digest,
}

/// What replaying a match needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum NeededKind {
    /// A robot.
    Robot,
    /// A maze.
    Maze,
}

/// A field of a document that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The match that the field belongs to; `None` for other parts of the document.
    #[serde(rename = "match")]
    pub of: Option<MatchName>,
    /// The field with both values.
    #[serde(flatten)]
    pub field: FieldDifference,
}

/// A match by the names in the document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MatchName {
    /// The robot.
    pub robot: GuestText,
    /// The maze.
    pub maze: GuestText,
    /// The seed.
    pub seed: u64,
}

impl MatchName {
    /// The name of the match with that key.
    pub fn new(names: &Names<'_>, key: &MatchKey) -> Self {
        Self {
            robot: names.robot(key).into(),
            maze: names.maze_name(key).into(),
            seed: key.seed,
        }
    }
}

/// What differs in a document, in the order in which it was found.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Differences {
    #[serde(rename = "differences_count")]
    count: usize,
    #[serde(rename = "differences")]
    kept: Vec<Difference>,
}

impl Differences {
    /// How many there are.
    pub const fn count(&self) -> usize {
        self.count
    }

    /// Those that are kept: the first 10,000.
    pub fn kept(&self) -> &[Difference] {
        &self.kept
    }

    /// Adds fields of a match, or of another part of the document.
    pub fn add(
        &mut self,
        of: Option<&MatchName>,
        fields: impl IntoIterator<Item = FieldDifference>,
    ) {
        for field in fields {
            self.count += 1;
            if self.kept.len() < KEPT_MAX {
                let of = of.cloned();
                self.kept.push(Difference { of, field });
            }
        }
    }
}

impl FileReport {
    /// A document that could not be read.
    pub fn unreadable(file: &str, reason: &str) -> Self {
        Self {
            file: file.to_owned(),
            matches: 0,
            matches_planned: 0,
            status: Status::Incomplete,
            differences: Differences::default(),
            not_found: Vec::new(),
            reason: Some(reason.into()),
        }
    }

    /// Whether every value is as it would be written now.
    pub const fn is_verified(&self) -> bool {
        matches!(self.status, Status::Verified | Status::Reformatted { .. })
    }
}

impl fmt::Display for FileReport {
    /// The report for people; ends with a newline.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", for_terminal(&self.file))?;
        match &self.status {
            Status::Verified => writeln!(f, "{}", self.verified())?,
            Status::Reformatted { line } => writeln!(
                f,
                "{}, but the formatting differs at line {line}\n\
                 hint: pass the unmodified output of `wasmouse run --json` to compare every byte",
                self.verified()
            )?,
            Status::Changed => self.write_differences(f)?,
            Status::DifferentEngine {
                recorded_engine,
                found_engine,
            } => writeln!(
                f,
                "not verified: recorded by engine `{}`, this is engine `{found_engine}`\n\
                 hint: {}",
                for_terminal(recorded_engine.as_str()),
                engine_hint(recorded_engine, found_engine),
            )?,
            Status::Incomplete => match (&self.reason, self.not_found.is_empty()) {
                (Some(reason), _) => writeln!(f, "not verified: {}", for_terminal(reason))?,
                (None, _) => writeln!(f, "not verified: required robots or mazes were not found")?,
            },
        }
        self.write_not_found(f)
    }
}

impl FileReport {
    fn verified(&self) -> String {
        let (matches, planned) = (self.matches, self.matches_planned);
        if matches == planned {
            format!("verified {}", counted(matches, "match", "matches"))
        } else {
            format!("verified {matches} of {planned} matches (the contest is incomplete)")
        }
    }

    fn write_differences(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.differences.count;
        writeln!(f, "{}", counted(count as u64, "difference", "differences"))?;
        for difference in self.differences.kept.iter().take(LISTED_MAX) {
            writeln!(f, "  {difference}")?;
        }
        match count.saturating_sub(LISTED_MAX) {
            0 => Ok(()),
            rest => writeln!(f, "  and {rest} more (--json lists them)"),
        }
    }

    fn write_not_found(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for NotFound { kind, name, digest } in self.not_found.iter().take(LISTED_MAX) {
            let kind = match kind {
                NeededKind::Robot => "robot",
                NeededKind::Maze => "maze",
            };
            writeln!(
                f,
                "  {kind} `{}` was not found (SHA-256 {digest})",
                for_terminal(name)
            )?;
        }
        match self.not_found.len().saturating_sub(LISTED_MAX) {
            0 => Ok(()),
            rest => writeln!(f, "  and {rest} more (--json lists them)"),
        }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(MatchName { robot, maze, seed }) = &self.of {
            let (robot, maze) = (for_terminal(robot), for_terminal(maze));
            write!(f, "`{robot}` in `{maze}`, seed {seed}: ")?;
        }
        let FieldDifference {
            field,
            recorded,
            found,
        } = &self.field;
        let (field, recorded, found) = (for_terminal(field), shown(recorded), shown(found));
        write!(f, "{field}: recorded {recorded}, found {found}")
    }
}

fn shown(value: &Option<Value>) -> String {
    let Some(value) = value else {
        return "nothing".to_owned();
    };
    let text = for_terminal(&value.to_string());
    match text.char_indices().nth(VALUE_CHARS_MAX) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

fn counted(count: u64, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    wasmouse: &'static str,
    engine: EngineId,
    verified: bool,
    files: &'a [FileReport],
}

/// The JSON for all documents, with a newline at the end.
pub fn to_json(files: &[FileReport]) -> String {
    json::document(&Document {
        version: VERSION,
        wasmouse: env!("CARGO_PKG_VERSION"),
        engine: engine_id(),
        verified: files.iter().all(FileReport::is_verified),
        files,
    })
}

#[cfg(test)]
mod tests {
    use super::super::sample::{HOSTILE, results};
    use super::*;
    use crate::contest::differences;

    fn report(status: Status) -> FileReport {
        FileReport {
            file: "results.json".to_owned(),
            matches: 4,
            matches_planned: 4,
            status,
            differences: Differences::default(),
            not_found: Vec::new(),
            reason: None,
        }
    }

    #[track_caller]
    fn check(report: &FileReport, text: &str, status: &str) {
        assert_eq!(report.to_string(), text);
        let json: Value =
            serde_json::from_str(&to_json(std::slice::from_ref(report))).expect("it is JSON");
        assert_eq!(json["files"][0]["status"], status);
        assert_eq!(json["verified"], report.is_verified());
    }

    #[test]
    fn every_status_has_its_text() {
        let mut verified = report(Status::Verified);
        check(&verified, "results.json: verified 4 matches\n", "verified");
        verified.matches_planned = 200;
        let text = "results.json: verified 4 of 200 matches (the contest is incomplete)\n";
        check(&verified, text, "verified");
        let text = "results.json: verified 4 matches, but the formatting differs at line 7\n\
                    hint: pass the unmodified output of `wasmouse run --json` to compare every byte\n";
        check(
            &report(Status::Reformatted { line: 7 }),
            text,
            "reformatted",
        );
        let status = Status::DifferentEngine {
            recorded_engine: EngineId::new("wasmtime-1"),
            found_engine: EngineId::new("wasmtime-2"),
        };
        let text = "results.json: not verified: recorded by engine `wasmtime-1`, this is engine \
                    `wasmtime-2`\nhint: verify it with the version of wasmouse that recorded it\n";
        check(&report(status), text, "different-engine");
        let unreadable = FileReport::unreadable("a\u{1b}", "no such file");
        check(
            &unreadable,
            "a\\u{1b}: not verified: no such file\n",
            "incomplete",
        );
        let mut incomplete = report(Status::Incomplete);
        let digest = Digest::of(b"bot");
        incomplete.not_found = vec![NotFound {
            kind: NeededKind::Robot,
            name: "bot".into(),
            digest,
        }];
        let text = format!(
            "results.json: not verified: required robots or mazes were not found\n  \
             robot `bot` was not found (SHA-256 {digest})\n"
        );
        check(&incomplete, &text, "incomplete");
    }

    #[test]
    fn differences_name_match_and_field() {
        let results = results();
        let recorded = &results.matches[1];
        let mut found = recorded.clone();
        found.fuel.steps = 7;
        let name = MatchName::new(&results.names(), &found.key);
        let mut report = report(Status::Changed);
        let fields = differences(recorded, &found);
        report.differences.add(Some(&name), fields.clone());
        let lines = &results.summary.standings.lines;
        report
            .differences
            .add(None, differences(&lines[0].rank, &lines[1].rank));
        let robot = for_terminal(HOSTILE);
        let text = format!(
            "results.json: 2 differences\n  `{robot}` in `test_maze_01`, seed {}: fuel.steps: \
             recorded {}, found 7\n  : recorded 1, found 2\n",
            u64::MAX,
            u64::MAX - 1
        );
        check(&report, &text, "changed");
        report
            .differences
            .add(Some(&name), fields.into_iter().cycle().take(20_000));
        assert_eq!(report.differences.count(), 20_002);
        assert_eq!(report.differences.kept().len(), KEPT_MAX);
        let text = report.to_string();
        assert!(
            text.ends_with("\n  and 19982 more (--json lists them)\n"),
            "{text}"
        );
    }

    #[test]
    fn long_values_are_cut() {
        assert_eq!(shown(&None), "nothing");
        let text = shown(&Some("\u{202e}".repeat(200).into()));
        assert!(
            text.starts_with("\"\\u{202e}") && text.ends_with("..."),
            "{text}"
        );
        assert_eq!(text.chars().count(), VALUE_CHARS_MAX + 3);
    }
}
