//! [`MatchRecord`]: what came of a match.

use serde::{Deserialize, Serialize};

use super::{GameResult, MatchKey, Transcript};
use crate::Digest;
use crate::game::{Counts, Steps, Verdict};
use crate::journal::JournalCounts;

/// Fuel that a match used, in units of the engine. The fuel of instantiation is limited but
/// not recorded: it depends on the operating system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FuelUse {
    /// In `start`.
    pub start: u64,
    /// In all steps together.
    pub steps: u64,
    /// In the most expensive step.
    pub step_max: u64,
}

/// What came of a match: one type from the runner to the store, the JSON, `verify` and the
/// reports.
///
/// The serialised form is described by the JSON Schema in `host/schema`; its version is that
/// of the results document. Steps are counted in steps, fuel in units of the engine, scores
/// in thousandths of a step.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatchRecord {
    /// Which match.
    pub key: MatchKey,
    /// How it ended.
    pub verdict: Verdict,
    /// Steps of both runs.
    pub steps: Steps,
    /// Bumps, clamps, ignored resets.
    pub counts: Counts,
    /// Fuel.
    pub fuel: FuelUse,
    /// How much the robot wrote to its journal.
    pub journal: JournalCounts,
    /// The digest of the transcript: the robot's actions and how the match ended.
    pub transcript: Digest,
}

impl MatchRecord {
    /// The record of a match.
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
