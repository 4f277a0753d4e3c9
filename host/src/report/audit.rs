//! What a robot could have known in a match, as text and as JSON.
//!
//! ```json
//! {
//!   "version": 1,
//!   "matches": [
//!     {
//!       "robot": "flood", "maze": "test_maze_01", "seed": 0, "match": "...",
//!       "verdict": "finished", "steps": {"exploration": 144, "speed": 17},
//!       "trace": "...",
//!       "certain_at": 92, "at_reset": {"optimistic": 17, "pessimistic": 17, "proven": true},
//!       "idle_steps": 41,
//!       "regret": {"exploration_steps": 126, "speed_steps": 0},
//!       "contradictions": [],
//!       "outlook": [{"position": 0, "optimistic": 5, "pessimistic": null}]
//!     }
//!   ]
//! }
//! ```
//!
//! `certain_at` is the first position (a number of steps) at which the best known path was proven
//! to be optimal, or null; `outlook` has the bounds of the optimal speed run in steps, at each
//! position where they changed; `trace` is the digest of all steps with their readings.

use serde::Serialize;
use wasmouse_core::game::Steps;
use wasmouse_core::journal::Belief;
use wasmouse_core::knowledge::{Audit, Outlook};
use wasmouse_core::maze::{Cell, Heading};
use wasmouse_core::playback::Playback;
use wasmouse_core::replay::Replay;
use wasmouse_core::{Digest, GuestText};

use super::escape::for_terminal;
use super::json;

/// The version of this document; raised when a reader of the old one would go wrong.
const VERSION: u32 = 1;

/// Contradictions that the text lists, at most.
const CONTRADICTIONS_MAX: usize = 10;

/// The audits of matches as JSON, with a newline at the end.
pub fn to_json(replays: &[Replay]) -> String {
    json::document(&Document {
        version: VERSION,
        matches: replays.iter().map(Entry::new).collect(),
    })
}

/// The audit of a match in a few lines of text.
pub fn to_text(replay: &Replay) -> String {
    let parts = replay.parts();
    let playback = replay.playback();
    let audit = playback.audit();
    let (robot, maze) = (for_terminal(&parts.robot), for_terminal(&parts.maze_name));
    let steps = parts.record.steps;
    let mut lines = vec![format!(
        "`{robot}` in `{maze}`, seed {}: {}, {} + {} steps",
        parts.record.key.seed,
        parts.record.verdict.title(),
        steps.exploration,
        steps.speed
    )];
    lines.push(match audit.certain_at {
        Some(0) => "  The best path was certain before the first step.".to_owned(),
        Some(step) => format!("  The best path was certain after step {step}."),
        None => "  The best path was never certain.".to_owned(),
    });
    if let Some(outlook) = audit.at_reset {
        lines.push(format!("  At the reset: {}.", sentence(outlook)));
    } else if let Some(last) = audit.steps.last() {
        lines.push(format!("  At the end: {}.", sentence(last.outlook)));
    }
    lines.push(format!(
        "  {} of {} steps of the exploration run showed nothing new.",
        audit.idle_steps, steps.exploration
    ));
    if let Some(regret) = audit.regret {
        let divisor = parts.rules.game.exploration_divisor;
        lines.push(format!(
            "  Beyond the oracle: {} steps of exploration (each counts 1/{divisor}) and {} of the \
             speed run.",
            regret.exploration_steps, regret.speed_steps
        ));
    }
    contradictions(audit, &mut lines);
    lines.push(String::new());
    lines.join("\n")
}

/// What is known of the best path.
pub fn sentence(outlook: Outlook) -> String {
    match (
        outlook.optimistic,
        outlook.pessimistic,
        outlook.might_save(),
    ) {
        (None, _, _) => "the goal cannot be reached".to_owned(),
        (Some(best), None, _) => {
            format!("no path to the goal is known; none has fewer than {best} steps")
        }
        (_, Some(known), Some(0)) => {
            format!("the best known path, {known} steps, is proven optimal")
        }
        (_, Some(known), Some(1)) => {
            format!("the best known path has {known} steps; 1 step might still be saved")
        }
        (_, Some(known), save) => format!(
            "the best known path has {known} steps; {} steps might still be saved",
            save.unwrap_or_default()
        ),
    }
}

fn contradictions(audit: &Audit, lines: &mut Vec<String>) {
    let all = &audit.contradictions;
    if all.is_empty() {
        return;
    }
    lines.push(format!("  False beliefs about walls: {}.", all.len()));
    for it in all.iter().take(CONTRADICTIONS_MAX) {
        let belief = match it.belief {
            Belief::Closed => "a wall",
            Belief::Open | Belief::Unknown => "no wall",
        };
        let known = if it.was_known {
            ", against its readings"
        } else {
            ""
        };
        lines.push(format!(
            "    step {}: {belief} at {}, {}{known}",
            it.step, it.cell, it.side
        ));
    }
    if all.len() > CONTRADICTIONS_MAX {
        lines.push(format!("    and {} more", all.len() - CONTRADICTIONS_MAX));
    }
}

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    matches: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Entry<'a> {
    robot: &'a GuestText,
    maze: &'a GuestText,
    seed: u64,
    r#match: Digest,
    verdict: String,
    steps: Steps,
    trace: Digest,
    certain_at: Option<usize>,
    at_reset: Option<OutlookEntry>,
    idle_steps: u32,
    regret: Option<RegretEntry>,
    contradictions: Vec<ContradictionEntry>,
    outlook: Vec<PositionEntry>,
}

#[derive(Serialize)]
struct OutlookEntry {
    optimistic: Option<u32>,
    pessimistic: Option<u32>,
    proven: bool,
}

#[derive(Serialize)]
struct RegretEntry {
    exploration_steps: u32,
    speed_steps: u32,
}

#[derive(Serialize)]
struct ContradictionEntry {
    step: u32,
    cell: Cell,
    side: Heading,
    belief: Belief,
    was_known: bool,
}

#[derive(Serialize)]
struct PositionEntry {
    position: usize,
    optimistic: Option<u32>,
    pessimistic: Option<u32>,
}

impl<'a> Entry<'a> {
    fn new(replay: &'a Replay) -> Self {
        let parts = replay.parts();
        let playback: Playback = replay.playback();
        let audit = playback.audit();
        let at_reset = audit.at_reset.map(|outlook| OutlookEntry {
            optimistic: outlook.optimistic,
            pessimistic: outlook.pessimistic,
            proven: outlook.is_certain(),
        });
        let contradictions = audit.contradictions.iter().map(|it| ContradictionEntry {
            step: it.step,
            cell: it.cell,
            side: it.side,
            belief: it.belief,
            was_known: it.was_known,
        });
        Self {
            robot: &parts.robot,
            maze: &parts.maze_name,
            seed: parts.record.key.seed,
            r#match: parts.record.key.digest(),
            verdict: parts.record.verdict.title().into_owned(),
            steps: parts.record.steps,
            trace: playback.trace_digest(),
            certain_at: audit.certain_at,
            at_reset,
            idle_steps: audit.idle_steps,
            regret: audit.regret.map(|it| RegretEntry {
                exploration_steps: it.exploration_steps,
                speed_steps: it.speed_steps,
            }),
            contradictions: contradictions.collect(),
            outlook: changes(audit),
        }
    }
}

/// The outlook at each position where it changed.
fn changes(audit: &Audit) -> Vec<PositionEntry> {
    let mut last = None;
    let mut changes = Vec::new();
    for (position, step) in audit.steps.iter().enumerate() {
        if last.replace(step.outlook) != Some(step.outlook) {
            changes.push(PositionEntry {
                position,
                optimistic: step.outlook.optimistic,
                pessimistic: step.outlook.pessimistic,
            });
        }
    }
    changes
}
