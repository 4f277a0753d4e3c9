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

/// The outcome of a match, from the runner to stores, reports and verification.
///
/// Serialises as an object with these fields, and rejects unknown ones. It has no version of
/// its own: a document or store that contains records has one.
///
/// ```
/// use wasmouse_core::Digest;
/// use wasmouse_core::game::{Action, GameRules};
/// use wasmouse_core::journal::JournalCounts;
/// use wasmouse_core::maze::{Maze, Walls};
/// use wasmouse_core::record::{FuelUse, MatchKey, MatchRecord, Transcript, replay};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let rules = GameRules { budget: 1, ..GameRules::default() };
/// let mut transcript = Transcript::default();
/// transcript.push(Action::Reset);
/// let result = replay(&maze, &rules, &transcript).expect("a whole match");
/// let part = Digest::of(b"");
/// let key = MatchKey { engine: part, rules: part, robot: part, variant: 0, maze: part, seed: 1 };
/// let (fuel, journal) = (FuelUse::default(), JournalCounts::default());
/// let record = MatchRecord::new(key, result, fuel, journal, &transcript);
///
/// let json = serde_json::to_value(&record)?;
/// assert_eq!(json["verdict"]["kind"], "budget-used-up");
/// assert_eq!(json["counts"]["resets_before_goal"], 1);
/// assert_eq!(json["transcript"], transcript.digest().to_string());
/// assert_eq!(serde_json::from_value::<MatchRecord>(json)?, record);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatchRecord {
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
    /// The size of the robot's journal.
    pub journal: JournalCounts,
    /// The digest of the transcript ([`Transcript::digest`]).
    pub transcript: Digest,
}

impl MatchRecord {
    /// Combines the result of a match with what the simulation does not know.
    pub fn new(
        key: MatchKey,
        result: GameResult,
        fuel: FuelUse,
        journal: JournalCounts,
        transcript: &Transcript,
    ) -> Self {
        let GameResult {
            verdict,
            steps,
            counts,
        } = result;
        Self {
            key,
            verdict,
            steps,
            counts,
            fuel,
            journal,
            transcript: transcript.digest(),
        }
    }
}
