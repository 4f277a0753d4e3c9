//! [`MatchRecord`]: the outcome of a match.

use serde::{Deserialize, Serialize};

use super::{GameResult, MatchKey, Transcript};
use crate::Digest;
use crate::game::{Counts, Steps, Verdict};
use crate::journal::JournalCounts;

/// The fuel that a match used, in units of the engine. Serialises as an object with these
/// fields.
///
/// The fuel of instantiation is limited but not recorded, because it depends on the operating
/// system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FuelUse {
    /// Fuel of `start`.
    pub start: u64,
    /// Fuel of all steps together.
    pub steps: u64,
    /// Fuel of the most expensive step.
    pub step_max: u64,
}

/// The resources that a robot used in a match: what only the engine knows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Usage {
    /// Fuel.
    pub fuel: FuelUse,
    /// Linear memory at the end of the match, of all instances together, in bytes. It is also the
    /// most that there was, because linear memory never shrinks.
    pub memory_bytes: u64,
    /// The size of the robot's journal.
    pub journal: JournalCounts,
}

/// The version of the serialised form of a [`MatchRecord`]. Serialises as the number 2;
/// deserialising another number fails.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "u8", try_from = "u64")]
pub struct RecordVersion;

impl RecordVersion {
    const NUMBER: u8 = 2;
}

impl From<RecordVersion> for u8 {
    fn from(_: RecordVersion) -> Self {
        RecordVersion::NUMBER
    }
}

impl TryFrom<u64> for RecordVersion {
    type Error = String;

    fn try_from(number: u64) -> Result<Self, String> {
        if number == u64::from(Self::NUMBER) {
            return Ok(Self);
        }
        let supported = Self::NUMBER;
        Err(format!(
            "match record of version {number}; only version {supported} is supported"
        ))
    }
}

/// The outcome of a match, from the runner to stores, reports and verification.
///
/// Serialises as an object with these fields, and rejects unknown ones and other versions. A
/// record can so be read by itself, such as from a line of a file.
///
/// ```
/// use wasmouse_core::Digest;
/// use wasmouse_core::game::{Action, GameRules};
/// use wasmouse_core::maze::{Maze, Walls};
/// use wasmouse_core::record::{MatchKey, MatchRecord, Transcript, Usage, replay};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let rules = GameRules { budget: 1, ..GameRules::default() };
/// let mut transcript = Transcript::default();
/// transcript.push(Action::Reset);
/// let result = replay(&maze, &rules, &transcript).expect("a whole match");
/// let part = Digest::of(b"");
/// let key = MatchKey { engine: part, rules: part, robot: part, variant: 0, maze: part, seed: 1 };
/// let usage = Usage { memory_bytes: 65_536, ..Usage::default() };
/// let record = MatchRecord::new(key, result, usage, &transcript);
///
/// let mut json = serde_json::to_value(&record)?;
/// assert_eq!(json["version"], 2);
/// assert_eq!(json["verdict"]["kind"], "budget-used-up");
/// assert_eq!(json["counts"]["resets_before_goal"], 1);
/// assert_eq!(json["transcript"], transcript.digest().to_string());
/// assert_eq!(serde_json::from_value::<MatchRecord>(json.clone())?, record);
///
/// json["version"] = 3.into();
/// let error = serde_json::from_value::<MatchRecord>(json).expect_err("another version");
/// assert!(error.to_string().contains("only version 2 is supported"));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatchRecord {
    /// The version of the serialised form.
    pub version: RecordVersion,
    /// The identity of the match.
    pub key: MatchKey,
    /// How the match ended.
    pub verdict: Verdict,
    /// Steps of both runs.
    pub steps: Steps,
    /// Bumps, clamps and ignored resets.
    pub counts: Counts,
    /// The fuel that the robot used.
    pub fuel: FuelUse,
    /// The linear memory that the robot had at the end, in bytes ([`Usage::memory_bytes`]).
    pub memory_bytes: u64,
    /// The size of the robot's journal.
    pub journal: JournalCounts,
    /// The digest of the transcript ([`Transcript::digest`]).
    pub transcript: Digest,
}

impl MatchRecord {
    /// Combines the result of a match with what the simulation does not know.
    pub fn new(key: MatchKey, result: GameResult, usage: Usage, transcript: &Transcript) -> Self {
        let GameResult {
            verdict,
            steps,
            counts,
        } = result;
        let Usage {
            fuel,
            memory_bytes,
            journal,
        } = usage;
        Self {
            version: RecordVersion,
            key,
            verdict,
            steps,
            counts,
            fuel,
            memory_bytes,
            journal,
            transcript: transcript.digest(),
        }
    }
}
