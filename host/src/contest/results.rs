//! [`Results`]: everything about a contest that was played, as one document.
//!
//! The document is what `wasmouse run` writes and what every report is made of. It can be read
//! back completely: [`Results`] deserialises from it. Its JSON Schema is
//! `host/schema/results.schema.json`.

use std::collections::HashMap;
use std::io;

use serde::{Deserialize, Serialize};
use wasmouse_core::game::{Ruleset, Score};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::record::{EngineId, MatchKey, MatchRecord};
use wasmouse_core::{Digest, DigestBuilder, GuestText};
use wasmouse_engine::admission::Rejection;
use wasmouse_engine::engine_id;

use super::maze_source::ContestMaze;
use super::plan::{NotAdmitted, Plan, Seeds};
use super::sink::{ContestMatch, MatchFailure, Sink};
use super::standings::Standings;

/// The version of the document; raised when a reader of the old one would go wrong.
pub const RESULTS_VERSION: u32 = 4;

/// The results of a contest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Results {
    /// [`RESULTS_VERSION`].
    pub version: u32,
    /// What is played; known before the first match.
    pub contest: ContestInfo,
    /// What was played by now, in the order of the plan: mazes, then seeds, then robots.
    pub matches: Vec<MatchRecord>,
    /// Everything that is known when the contest has ended.
    pub summary: Summary,
}

/// The part of a document that comes before the matches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContestInfo {
    /// The version of wasmouse.
    pub wasmouse: String,
    /// The engine. Fuel and faults can only be compared within one engine.
    pub engine: EngineId,
    /// The rules, with all their numbers.
    pub rules: Ruleset,
    /// The seeds.
    pub seeds: Seeds,
    /// The robots, in the order in which they were given.
    pub robots: Vec<RobotEntry>,
    /// How many matches the contest has.
    pub matches_planned: u64,
}

/// A robot in a document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotEntry {
    /// What the standings call it.
    pub name: GuestText,
    /// The SHA-256 of its file.
    pub digest: Digest,
    /// The number that chooses its mode.
    pub variant: u32,
    /// Why it was rejected and played no match.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rejection: Option<RejectionEntry>,
    /// Why the host could not admit it, so that it played no match; says nothing about the robot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failure: Option<GuestText>,
}

impl RobotEntry {
    /// Whether it plays.
    pub const fn is_admitted(&self) -> bool {
        self.rejection.is_none() && self.failure.is_none()
    }
}

/// A rejection in a document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RejectionEntry {
    /// A short name: lowercase letters and hyphens.
    pub kind: GuestText,
    /// Why.
    pub reason: GuestText,
    /// What to do.
    pub hint: GuestText,
}

impl From<&Rejection> for RejectionEntry {
    fn from(rejection: &Rejection) -> Self {
        Self {
            kind: rejection.name().into(),
            reason: rejection.reason(),
            hint: rejection.hint().into(),
        }
    }
}

impl From<RejectionEntry> for Rejection {
    fn from(entry: RejectionEntry) -> Self {
        let RejectionEntry { kind, reason, hint } = entry;
        Self::Reported {
            name: kind,
            reason,
            hint,
        }
    }
}

/// The part of a document that comes after the matches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// Matches played: the length of `matches`.
    pub matches: u64,
    /// Whether every planned match was played.
    pub complete: bool,
    /// The mazes that have matches, in the order of the plan.
    pub mazes: Vec<MazeEntry>,
    /// Matches that the host could not play.
    pub failures: Vec<MatchFailure>,
    /// Robots that were withdrawn because they took too long.
    pub withdrawn: Vec<WithdrawalEntry>,
    /// The ranking.
    pub standings: Standings,
    /// [`records_digest`] of the matches: names the whole contest in one line.
    pub digest: Digest,
}

/// A robot that was withdrawn, in a document. The matches that it had played by then are among
/// the others.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WithdrawalEntry {
    /// The digest of the robot.
    pub robot: Digest,
    /// Its variant.
    pub variant: u32,
    /// Why.
    pub reason: GuestText,
    /// How many of its matches were not played for that.
    pub matches: u64,
}

/// A maze in a document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MazeEntry {
    /// What results call it.
    pub name: GuestText,
    /// Its digest.
    pub digest: Digest,
    /// Cells along a side.
    pub dimension: u8,
    /// The score of a robot that knows the maze; `null` when the goal cannot be reached.
    pub oracle: Option<Score>,
}

impl ContestInfo {
    /// The description of a plan.
    pub fn new(plan: &Plan) -> Self {
        let robots = plan.entrants.iter().map(|entrant| {
            let (rejection, failure) = match &entrant.admission {
                Ok(_) => (None, None),
                Err(NotAdmitted::Rejected(it)) => (Some(RejectionEntry::from(&**it)), None),
                Err(NotAdmitted::Failed(reason)) => (None, Some(reason.clone())),
            };
            RobotEntry {
                name: entrant.name.clone(),
                digest: entrant.digest,
                variant: entrant.variant,
                rejection,
                failure,
            }
        });
        Self {
            wasmouse: env!("CARGO_PKG_VERSION").to_owned(),
            engine: engine_id(),
            rules: Ruleset::clone(&plan.rules),
            seeds: plan.seeds,
            robots: robots.collect(),
            matches_planned: plan.matches(),
        }
    }
}

impl Results {
    /// The names of robots and mazes by what match keys call them.
    pub fn names(&self) -> Names<'_> {
        Names::new(&self.contest.robots, &self.summary.mazes)
    }
}

/// The names of robots and mazes, found by the parts of a match key.
#[derive(Clone, Debug, Default)]
pub struct Names<'a> {
    robots: HashMap<(Digest, u32), GuestStr<'a>>,
    mazes: HashMap<Digest, &'a MazeEntry>,
}

impl<'a> Names<'a> {
    /// The names in these lists. What is listed twice is called by its first name.
    pub fn new(robots: &'a [RobotEntry], mazes: &'a [MazeEntry]) -> Self {
        let mut names = Self::default();
        for robot in robots {
            let key = (robot.digest, robot.variant);
            names.robots.entry(key).or_insert(robot.name.as_guest());
        }
        for maze in mazes {
            names.mazes.entry(maze.digest).or_insert(maze);
        }
        names
    }

    /// The name of the robot of a match; `?` when it is not listed.
    pub fn robot(&self, key: &MatchKey) -> GuestStr<'a> {
        let robot = (key.robot, key.variant);
        self.robots.get(&robot).copied().unwrap_or("?".into())
    }

    /// The maze of a match; `None` when it is not listed.
    pub fn maze(&self, key: &MatchKey) -> Option<&'a MazeEntry> {
        self.mazes.get(&key.maze).copied()
    }

    /// The name of the maze of a match; `?` when it is not listed.
    pub fn maze_name(&self, key: &MatchKey) -> GuestStr<'a> {
        self.maze(key)
            .map_or("?".into(), |maze| maze.name.as_guest())
    }
}

/// The identity of some records.
///
/// Canonical encoding `wasmouse.results.2` ([`DigestBuilder`]): for each record the digests of
/// its key and its transcript, then the numbers fuel of the start, fuel of all steps, fuel of
/// the most expensive step, linear memory in bytes, journal entries kept and dropped. Verdict, steps and counts follow
/// from key and transcript.
pub fn records_digest<'a>(records: impl IntoIterator<Item = &'a MatchRecord>) -> Digest {
    let builder = DigestBuilder::new("wasmouse.results.2");
    records.into_iter().fold(builder, add_record).finish()
}

fn add_record(builder: DigestBuilder, record: &MatchRecord) -> DigestBuilder {
    builder
        .digest(&record.key.digest())
        .digest(&record.transcript)
        .numbers(&[
            record.fuel.start,
            record.fuel.steps,
            record.fuel.step_max,
            record.memory_bytes,
            record.journal.entries,
            record.journal.dropped,
        ])
}

/// Collects what the summary needs while a contest is played.
#[derive(Clone, Debug)]
pub struct SummaryBuilder {
    digest: DigestBuilder,
    mazes: Vec<MazeEntry>,
    failures: Vec<MatchFailure>,
    withdrawn: Vec<WithdrawalEntry>,
    matches: u64,
}

impl SummaryBuilder {
    /// The summary of a contest without matches.
    pub fn new() -> Self {
        Self {
            digest: DigestBuilder::new("wasmouse.results.2"),
            mazes: Vec::new(),
            failures: Vec::new(),
            withdrawn: Vec::new(),
            matches: 0,
        }
    }

    /// The summary of everything that has arrived.
    pub fn finish(self, plan: &Plan, standings: Standings) -> Summary {
        Summary {
            matches: self.matches,
            complete: self.matches == plan.matches(),
            mazes: self.mazes,
            failures: self.failures,
            withdrawn: self.withdrawn,
            standings,
            digest: self.digest.finish(),
        }
    }
}

impl Default for SummaryBuilder {
    fn default() -> Self {
        Self::new()
    }
}

impl Sink for SummaryBuilder {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.mazes.push(MazeEntry {
            name: maze.name.clone(),
            digest: maze.digest,
            dimension: maze.maze.dimension(),
            oracle: maze.oracle,
        });
        Ok(())
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        self.matches += 1;
        self.digest = add_record(self.digest.clone(), &played.record);
        Ok(())
    }

    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.failures.push(failure.clone());
        Ok(())
    }

    fn withdrawn(&mut self, failure: &MatchFailure) -> io::Result<()> {
        let key = &failure.key;
        let is_same =
            |it: &&mut WithdrawalEntry| it.robot == key.robot && it.variant == key.variant;
        match self.withdrawn.iter_mut().find(is_same) {
            Some(entry) => entry.matches += 1,
            None => self.withdrawn.push(WithdrawalEntry {
                robot: key.robot,
                variant: key.variant,
                reason: failure.reason.clone(),
                matches: 1,
            }),
        }
        Ok(())
    }
}
