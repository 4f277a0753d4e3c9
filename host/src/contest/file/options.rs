//! The smaller tables of a contest file: `[[classes]]`, `[seeds]`, `[run]`, `[report]` and
//! `[outputs]`.

use std::time::Duration;

use serde::Deserialize;

use super::super::config::{FilePath, Integer, Name};
use super::super::plan::Seeds;

/// A class of robots, with standings of its own. One without limits holds every robot.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct ClassEntry {
    /// What reports call it. No other class has the name.
    pub name: Name,
    /// The most fuel that a robot of the class uses in a step of any match. Default: no limit.
    pub step_fuel_max: Option<Integer<1, FUEL_MAX>>,
    /// The most linear memory that a robot of the class has in any match, in bytes. Default: no
    /// limit.
    pub memory_bytes_max: Option<Integer<0, MEMORY_BYTES_MAX>>,
}

/// The largest limit on fuel that can be set.
pub(super) const FUEL_MAX: u64 = 1_000_000_000_000_000;

/// The largest limit on linear memory that can be set: what 32 bits address.
pub(super) const MEMORY_BYTES_MAX: u64 = 4 << 30;

impl ClassEntry {
    /// Whether a robot that used so much keeps its limits.
    pub fn holds(&self, step_fuel: u64, memory_bytes: u64) -> bool {
        let fuel = self.step_fuel_max.is_none_or(|max| step_fuel <= max.get());
        let memory = self.memory_bytes_max.map(Integer::get);
        fuel && memory.is_none_or(|max| memory_bytes <= max)
    }
}

/// The seeds of every maze: consecutive ones.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub struct SeedsEntry {
    /// The first seed. Default 0.
    pub first: Integer<0, { u64::MAX }>,
    /// How many there are. Default 1.
    pub count: Integer<1, 1_000_000>,
}

impl Default for SeedsEntry {
    fn default() -> Self {
        Self {
            first: Integer::new(0).expect("it is in the range"),
            count: Integer::new(1).expect("it is in the range"),
        }
    }
}

impl From<SeedsEntry> for Seeds {
    fn from(seeds: SeedsEntry) -> Self {
        Self {
            first: seeds.first.get(),
            count: seeds.count.get_u32(),
        }
    }
}

/// How matches are played. None of it changes a result.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub struct RunOptions {
    /// Matches to play in parallel. Default: the number of cores.
    pub jobs: Option<Integer<1, 1024>>,
    /// Processor time of each robot in all its matches, in seconds, before it is withdrawn.
    /// Default: 300, and 2 more for each of its matches; as many times more as `match_time_seconds`.
    pub robot_time_seconds: Option<Integer<1, 31_536_000>>,
    /// Processor time of a match, in seconds. Default 60 for each 20,000,000,000 units of match
    /// fuel, so 600 by interpreted rules.
    pub match_time_seconds: Option<Integer<1, 86_400>>,
    /// Which transcripts are kept.
    pub keep_transcripts: KeepTranscripts,
}

impl RunOptions {
    /// Processor time of each robot; `None` is the default.
    pub fn robot_time(&self) -> Option<Duration> {
        self.robot_time_seconds
            .map(|it| Duration::from_secs(it.get()))
    }

    /// Processor time of a match; `None` is the default.
    pub fn match_time(&self) -> Option<Duration> {
        self.match_time_seconds
            .map(|it| Duration::from_secs(it.get()))
    }
}

/// Which transcripts of matches a contest keeps. The others can be made again by playing the
/// match.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum KeepTranscripts {
    /// None.
    None,
    /// That of the best match of each robot in each of its variants, over all mazes.
    #[default]
    Best,
    /// Those of all matches: about one byte a step.
    All,
}

/// What reports show. The names and pictures of the mazes in hidden sets are never shown.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub struct ReportOptions {
    /// How many robots the standings show, from the top. Default: all.
    pub show_top: Option<Integer<1, 1_000_000>>,
    /// Whether robots and authors are shown by numbers instead of names.
    pub hide_names: bool,
    /// Whether reports that exist stay as they are, whatever is played meanwhile.
    pub freeze: bool,
}

/// The reports that are written after a run. Default: none.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub struct Outputs {
    /// The web page.
    pub html: Option<FilePath>,
    /// The standings as comma-separated values.
    pub csv: Option<FilePath>,
    /// The results as one JSON document.
    pub json: Option<FilePath>,
    /// The matches, one JSON object a line.
    pub jsonl: Option<FilePath>,
    /// The standings as a Markdown table.
    pub markdown: Option<FilePath>,
}

impl Outputs {
    /// Key and path of each output.
    pub fn paths(&self) -> Vec<(&'static str, &FilePath)> {
        let Self {
            html,
            csv,
            json,
            jsonl,
            markdown,
        } = self;
        let outputs = [
            ("html", html),
            ("csv", csv),
            ("json", json),
            ("jsonl", jsonl),
            ("markdown", markdown),
        ];
        let given = outputs.into_iter();
        given
            .filter_map(|(key, path)| Some((key, path.as_ref()?)))
            .collect()
    }
}
