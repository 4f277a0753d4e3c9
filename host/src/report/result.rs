//! The JSON of a contest: every match with everything that is needed to play it
//! again, and the standings.
//!
//! ```json
//! {
//!   "schema": 1,
//!   "wasmouse": "0.1.0",
//!   "engine": "wasmtime-48.0.8+wasmouse.3",
//!   "ruleset": {"name": "udacity", "version": 1, "sha256": "..."},
//!   "seeds": [0],
//!   "complete": true,
//!   "robots": [{"name": "flood", "sha256": "...", "setting": 0}],
//!   "mazes": [{"name": "test_maze_01", "sha256": "...", "dimension": 12, "floor": 17.6}],
//!   "matches": [{
//!     "robot": "flood", "maze": "test_maze_01", "seed": 0,
//!     "verdict": "finished", "score": 22.1,
//!     "exploration_steps": 63, "speed_steps": 20,
//!     "bumps": 0, "clamps": 0, "resets_before_goal": 0, "resets_in_speed_run": 0,
//!     "start_fuel": 5210, "steps_fuel": 912345, "step_fuel_max": 30123,
//!     "journal_entries": 0, "journal_dropped": 0,
//!     "trace_sha256": "..."
//!   }],
//!   "failed": [],
//!   "standings": [{
//!     "rank": 1, "robot": "flood", "matches": 1, "finished": 1, "goal_reached": 0,
//!     "faults": 0, "mean_score": 22.1, "mean_regret": 4.5
//!   }],
//!   "sha256": "..."
//! }
//! ```
//!
//! A match in `failed` (`robot`, `maze`, `seed`, `reason`) could not be played
//! because the host failed; it says nothing about the robot.
//!
//! Steps are counted in steps, fuel in wasmtime's units, scores in steps with
//! three decimals. The same contest on the same engine gives the same bytes,
//! whatever the number of threads. `sha256` at the end is the digest of the text
//! with nothing between its quotes: it shows damage, and names a whole contest in
//! one line. Who writes a false document can write a fitting digest: only playing
//! the matches again shows that.
//!
//! [`ContestReport::read`] reads such a document strictly, and [`Verification`]
//! holds it against matches that were played again.

mod difference;
mod finder;
#[doc(hidden)]
pub mod fuzz;
mod place;
mod read;
#[cfg(test)]
mod tests;
mod verification;

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

pub use difference::{Difference, Differences, MatchName};
pub use read::{ReadError, RecordedMaze, RecordedRobot};
pub use verification::{Schedule, Unplayed, Verification};

use super::json;
use crate::contest::{
    Contest, ContestMaze, Entrant, FailedMatch, MatchResult, Mean, Played, Standing,
};
use crate::robot::{Digest, Fault, Verdict, engine_id};
use crate::sim::{Ruleset, Score};

/// The version of this JSON; raised when a reader of the old one would go wrong.
const SCHEMA: u32 = 1;

/// The whole document.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "the JSON of a contest")]
pub struct ContestReport<'a> {
    schema: u32,
    #[serde(borrow)]
    wasmouse: Cow<'a, str>,
    #[serde(borrow)]
    engine: Cow<'a, str>,
    #[serde(borrow)]
    ruleset: WireRuleset<'a>,
    seeds: Vec<u64>,
    /// False when the contest was interrupted or the host failed in a match:
    /// `matches` then holds what has been played.
    complete: bool,
    #[serde(borrow)]
    robots: Vec<WireRobot<'a>>,
    #[serde(borrow)]
    mazes: Vec<WireMaze<'a>>,
    #[serde(borrow)]
    matches: Vec<WireMatch<'a>>,
    #[serde(borrow)]
    failed: Vec<WireFailed<'a>>,
    #[serde(borrow)]
    standings: Vec<WireStanding<'a>>,
    /// Empty until the document is written.
    #[serde(borrow)]
    sha256: Cow<'a, str>,
}

impl<'a> ContestReport<'a> {
    /// The document for a contest and what has been played of it.
    pub fn new(contest: &'a Contest, played: &'a Played, standings: &'a [Standing]) -> Self {
        let results = &played.results;
        Self {
            schema: SCHEMA,
            wasmouse: env!("CARGO_PKG_VERSION").into(),
            engine: engine_id().into(),
            ruleset: WireRuleset::new(&contest.rules),
            seeds: contest.seeds.clone(),
            complete: results.len() == contest.matches(),
            robots: contest.entrants.iter().map(WireRobot::new).collect(),
            mazes: contest.mazes.iter().map(WireMaze::new).collect(),
            matches: results
                .iter()
                .map(|result| WireMatch::new(contest, result))
                .collect(),
            failed: played
                .failed
                .iter()
                .map(|failed| WireFailed::new(contest, failed))
                .collect(),
            standings: standings
                .iter()
                .map(|line| WireStanding::new(contest, line))
                .collect(),
            sha256: Cow::Borrowed(""),
        }
    }

    /// The document as text, indented, with its digest and a newline at the end.
    pub fn to_json(&self) -> String {
        const END: &str = "\"\n}\n";
        let mut text = json::document(self);
        let digest = Digest::of(text.as_bytes());
        let place = text.len() - END.len();
        assert!(text[place..] == *END, "the digest is the last field");
        text.insert_str(place, &digest.hex());
        text
    }
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireRuleset<'a> {
    #[serde(borrow)]
    name: Cow<'a, str>,
    version: u32,
    #[serde(borrow)]
    sha256: Cow<'a, str>,
}

impl WireRuleset<'_> {
    fn new(rules: &Ruleset) -> Self {
        Self {
            name: rules.name.into(),
            version: rules.version,
            sha256: Digest::of(&rules.identity_bytes()).hex().into(),
        }
    }
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireRobot<'a> {
    #[serde(borrow)]
    name: Cow<'a, str>,
    #[serde(borrow)]
    sha256: Cow<'a, str>,
    setting: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[serde(borrow)]
    refusal: Option<WireRefusal<'a>>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireRefusal<'a> {
    #[serde(borrow)]
    kind: Cow<'a, str>,
    #[serde(borrow)]
    reason: Cow<'a, str>,
    #[serde(borrow)]
    hint: Cow<'a, str>,
}

impl<'a> WireRobot<'a> {
    fn new(entrant: &'a Entrant) -> Self {
        let refusal = entrant.admission.as_ref().err();
        Self {
            name: Cow::Borrowed(&entrant.name),
            sha256: entrant.digest.hex().into(),
            setting: entrant.setting,
            refusal: refusal.map(|refusal| WireRefusal {
                kind: refusal.name().into(),
                reason: refusal.to_string().into(),
                hint: refusal.hint().into(),
            }),
        }
    }
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireMaze<'a> {
    #[serde(borrow)]
    name: Cow<'a, str>,
    #[serde(borrow)]
    sha256: Cow<'a, str>,
    dimension: u8,
    floor: Option<f64>,
}

impl<'a> WireMaze<'a> {
    fn new(maze: &'a ContestMaze) -> Self {
        Self {
            name: Cow::Borrowed(&maze.name),
            sha256: maze.digest.hex().into(),
            dimension: maze.maze.dimension(),
            floor: maze.floor.map(score_number),
        }
    }
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireMatch<'a> {
    #[serde(borrow)]
    robot: Cow<'a, str>,
    #[serde(borrow)]
    maze: Cow<'a, str>,
    seed: u64,
    #[serde(borrow)]
    verdict: Cow<'a, str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    score: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[serde(borrow)]
    fault: Option<WireFault<'a>>,
    exploration_steps: u32,
    speed_steps: u32,
    bumps: u32,
    clamps: u32,
    resets_before_goal: u32,
    resets_in_speed_run: u32,
    start_fuel: u64,
    steps_fuel: u64,
    step_fuel_max: u64,
    journal_entries: u64,
    journal_dropped: u64,
    #[serde(borrow)]
    trace_sha256: Cow<'a, str>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireFault<'a> {
    #[serde(borrow)]
    kind: Cow<'a, str>,
    #[serde(borrow)]
    phase: Cow<'a, str>,
    run: u8,
    step: u32,
    x: u8,
    y: u8,
    #[serde(borrow)]
    detail: Cow<'a, str>,
}

impl<'a> WireFault<'a> {
    fn new(fault: &'a Fault) -> Self {
        Self {
            kind: fault.kind.name().into(),
            phase: fault.phase.name().into(),
            run: fault.run.number(),
            step: fault.step,
            x: fault.cell.x,
            y: fault.cell.y,
            detail: Cow::Borrowed(&fault.detail),
        }
    }
}

impl<'a> WireMatch<'a> {
    fn new(contest: &'a Contest, result: &'a MatchResult) -> Self {
        let outcome = &result.outcome;
        let (score, fault) = match &outcome.verdict {
            Verdict::Finished(score) => (Some(score_number(*score)), None),
            Verdict::BudgetUsedUp { .. } => (None, None),
            Verdict::Fault(fault) => (None, Some(WireFault::new(fault))),
        };
        let [exploration_steps, speed_steps] = outcome.steps;
        let (journal_entries, journal_dropped) = result.journal;
        Self {
            robot: Cow::Borrowed(&contest.entrants[result.entrant].name),
            maze: Cow::Borrowed(&contest.mazes[result.maze].name),
            seed: result.seed,
            verdict: outcome.verdict.name().into(),
            score,
            fault,
            exploration_steps,
            speed_steps,
            bumps: outcome.counts.bumps,
            clamps: outcome.counts.clamps,
            resets_before_goal: outcome.counts.resets_before_goal,
            resets_in_speed_run: outcome.counts.resets_in_speed_run,
            start_fuel: outcome.fuel.start,
            steps_fuel: outcome.fuel.steps,
            step_fuel_max: outcome.fuel.step_max,
            journal_entries,
            journal_dropped,
            trace_sha256: result.trace.hex().into(),
        }
    }
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireFailed<'a> {
    #[serde(borrow)]
    robot: Cow<'a, str>,
    #[serde(borrow)]
    maze: Cow<'a, str>,
    seed: u64,
    #[serde(borrow)]
    reason: Cow<'a, str>,
}

impl<'a> WireFailed<'a> {
    fn new(contest: &'a Contest, failed: &FailedMatch) -> Self {
        Self {
            robot: Cow::Borrowed(&contest.entrants[failed.entrant].name),
            maze: Cow::Borrowed(&contest.mazes[failed.maze].name),
            seed: failed.seed,
            reason: failed.error.to_string().into(),
        }
    }
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WireStanding<'a> {
    rank: Option<u32>,
    #[serde(borrow)]
    robot: Cow<'a, str>,
    matches: u32,
    finished: u32,
    goal_reached: u32,
    faults: u32,
    mean_score: Option<f64>,
    mean_regret: Option<f64>,
}

impl<'a> WireStanding<'a> {
    fn new(contest: &'a Contest, line: &Standing) -> Self {
        Self {
            rank: line.rank,
            robot: Cow::Borrowed(&contest.entrants[line.entrant].name),
            matches: line.matches,
            finished: line.finished,
            goal_reached: line.goal_reached,
            faults: line.faults,
            mean_score: line.score.map(mean_number),
            mean_regret: line.regret.map(mean_number),
        }
    }
}

#[expect(clippy::cast_precision_loss, reason = "below 2 to the 53 by far")]
fn score_number(score: Score) -> f64 {
    score.thousandths() as f64 / 1000.0
}

#[expect(clippy::cast_precision_loss, reason = "below 2 to the 53 by far")]
fn mean_number(mean: Mean) -> f64 {
    mean.thousandths() as f64 / 1000.0
}
