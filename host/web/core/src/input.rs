//! Reads what a page opens.

use wasmouse_core::game::{BudgetScope, GameRules};
use wasmouse_core::journal::Journal;
use wasmouse_core::maze::Maze;
use wasmouse_core::playback::Playback;
use wasmouse_core::record::{Transcript, trace};
use wasmouse_core::replay::Replay;

use crate::about::Origin;
use crate::open::OpenMatch;

/// Steps at most. No bundled ruleset allows more than 2,000; memory is computed for each step.
pub const STEPS_MAX: usize = 200_000;

/// Reads a match of a page:
///
/// | bytes | meaning |
/// |---|---|
/// | 4, 1, 1, 4 | the rules: budget, budget scope (0 both runs, 1 each run), longest move, divisor |
/// | 4, n | the length and the [identity bytes](Maze::identity_bytes) of the maze |
/// | rest | the [transcript](Transcript) |
///
/// Numbers are little endian.
///
/// # Errors
///
/// A message that says which part is invalid.
pub fn read_match(bytes: &[u8]) -> Result<OpenMatch, String> {
    let mut rest = bytes;
    let budget = number(&mut rest)?;
    let budget_scope = match byte(&mut rest)? {
        0 => BudgetScope::BothRuns,
        1 => BudgetScope::EachRun,
        other => return Err(format!("unknown budget scope {other}")),
    };
    let longest_move = byte(&mut rest)?;
    let exploration_divisor = number(&mut rest)?;
    if budget == 0 || longest_move == 0 || exploration_divisor == 0 {
        return Err("a number of the rules is 0".to_owned());
    }
    let rules = GameRules {
        budget,
        budget_scope,
        longest_move,
        exploration_divisor,
    };
    let length = number(&mut rest)? as usize;
    let (maze, transcript) = rest.split_at_checked(length).ok_or_else(truncated)?;
    let maze = Maze::from_identity_bytes(maze).ok_or("the maze is damaged")?;
    let transcript = Transcript::from_bytes(transcript).map_err(|error| error.to_string())?;
    check_length(&transcript)?;
    let (result, trace) = trace(&maze, &rules, &transcript).map_err(|error| error.to_string())?;
    let playback = Playback::new(maze, rules, trace, result.verdict, Journal::default());
    Ok(OpenMatch::new(playback, None))
}

/// Reads a replay file, which is checked by that: its digests, and its record by playing it.
///
/// # Errors
///
/// A message that says where the file is damaged.
pub fn read_replay(bytes: &[u8]) -> Result<OpenMatch, String> {
    let replay: Replay = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
    let parts = replay.parts();
    check_length(&parts.transcript)?;
    let origin = Origin {
        robot: parts.robot.clone(),
        maze: parts.maze_name.clone(),
        seed: parts.record.key.seed.to_string(),
    };
    Ok(OpenMatch::new(replay.playback(), Some(origin)))
}

fn check_length(transcript: &Transcript) -> Result<(), String> {
    if transcript.actions().take(STEPS_MAX + 1).count() > STEPS_MAX {
        return Err(format!("the match has more than {STEPS_MAX} steps"));
    }
    Ok(())
}

fn byte(rest: &mut &[u8]) -> Result<u8, String> {
    let (&first, others) = rest.split_first().ok_or_else(truncated)?;
    *rest = others;
    Ok(first)
}

fn number(rest: &mut &[u8]) -> Result<u32, String> {
    let (&bytes, others) = rest.split_first_chunk().ok_or_else(truncated)?;
    *rest = others;
    Ok(u32::from_le_bytes(bytes))
}

fn truncated() -> String {
    "the match is truncated".to_owned()
}
