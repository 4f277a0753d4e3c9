//! `--log`: what robots wrote to their journals, for the people who debug them.

use super::failure::Failure;
use crate::contest::{Contest, MatchResult};
use crate::report::escape::for_terminal as visible;
use crate::robot::{Level, Note, Recorder, Referee};

/// Replays every match with a journal and prints its log lines on standard error.
///
/// # Errors
///
/// When the host fails.
pub fn print(contest: &Contest, referee: &Referee, results: &[MatchResult]) -> Result<(), Failure> {
    let mut recorder = Recorder::default();
    for result in results.iter().filter(|result| result.journal != (0, 0)) {
        contest
            .replay(referee, result, &mut recorder)
            .map_err(Failure::internal)?;
        let robot = visible(&contest.entrants[result.entrant].name);
        let maze = visible(&contest.mazes[result.maze].name);
        message!("journal of `{robot}` in `{maze}`, seed {}:", result.seed);
        for entry in recorder.journal.entries() {
            if let Note::Log { level, text } = entry.note {
                let level = level_name(level);
                message!("{:>6} {level:<7} {}", entry.step, visible(text));
            }
        }
        let dropped = recorder.journal.dropped();
        if dropped > 0 {
            message!("       {dropped} more entries did not fit the journal's limit");
        }
    }
    Ok(())
}

const fn level_name(level: Level) -> &'static str {
    match level {
        Level::Debug => "debug",
        Level::Info => "info",
        Level::Warning => "warning",
        Level::Error => "error",
    }
}
