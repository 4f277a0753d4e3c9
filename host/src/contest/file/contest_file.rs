//! [`ContestFile`]: everything that a contest file says.

use serde::Deserialize;

use super::super::config::{FilePath, Integer, Name, table, tables};
use super::super::scoring::Scoring;
use super::mazes::MazesEntry;
use super::options::{ClassEntry, Outputs, ReportOptions, RunOptions, SeedsEntry};
use super::robots::RobotsEntry;
use super::rules::RulesEntry;

/// The version of contest files.
pub const CONTEST_FILE_VERSION: u64 = 1;

/// A contest file. Paths in it are relative to the folder of the file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContestFile {
    /// [`CONTEST_FILE_VERSION`].
    pub version: Integer<1, CONTEST_FILE_VERSION>,
    /// What reports call the contest. Default: `contest`.
    #[serde(default = "contest")]
    pub name: Name,
    /// The database with the results. Default: the contest file's own name, with the ending `.db`.
    pub store: Option<FilePath>,
    /// Who takes part. At least one entry.
    #[serde(default, deserialize_with = "tables")]
    pub robots: Vec<RobotsEntry>,
    /// Classes of robots. Default: none.
    #[serde(default, deserialize_with = "tables")]
    pub classes: Vec<ClassEntry>,
    /// Sets of mazes. At least one.
    #[serde(default, deserialize_with = "tables")]
    pub mazes: Vec<MazesEntry>,
    /// The seeds of every maze.
    #[serde(default, deserialize_with = "table")]
    pub seeds: SeedsEntry,
    /// The rules of all matches.
    #[serde(default, deserialize_with = "table")]
    pub rules: RulesEntry,
    /// How matches become ranks.
    #[serde(default, deserialize_with = "table")]
    pub scoring: Scoring,
    /// How matches are played.
    #[serde(default, deserialize_with = "table")]
    pub run: RunOptions,
    /// What reports show.
    #[serde(default, deserialize_with = "table")]
    pub report: ReportOptions,
    /// The reports to write.
    #[serde(default, deserialize_with = "table")]
    pub outputs: Outputs,
}

impl ContestFile {
    /// The first class whose limits were kept by a robot that declares none, by what it used at
    /// most in any match: fuel in a step, and linear memory in bytes.
    pub fn class_by_usage(&self, step_fuel: u64, memory_bytes: u64) -> Option<&str> {
        let mut classes = self.classes.iter();
        let class = classes.find(|it| it.holds(step_fuel, memory_bytes));
        class.map(|it| it.name.as_str())
    }
}

fn contest() -> Name {
    Name::new("contest").expect("it is a name")
}
