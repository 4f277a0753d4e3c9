//! Writes the web page of a contest, with a picture of each robot's best match.

use std::path::Path;

use super::failure::Failure;
use super::output::{self, Existing};
use crate::contest::{Contest, MatchResult, Mean, Standing};
use crate::report::page::{Portrait, page};
use crate::report::replay;
use crate::robot::{Recorder, Referee, Verdict};

/// More pictures than this make a page slow to load.
const PORTRAITS_MAX: usize = 60;

/// Replays the best matches for their pictures and writes the page.
///
/// # Errors
///
/// When the host fails or the file cannot be written.
pub fn write(
    path: &Path,
    existing: Existing,
    contest: &Contest,
    referee: &Referee,
    results: &[MatchResult],
    standings: &[Standing],
) -> Result<(), Failure> {
    let mut recorder = Recorder::default();
    let mut portraits = Vec::new();
    for line in standings.iter().take(PORTRAITS_MAX) {
        let Some(result) = best_match(contest, results, line.entrant) else {
            continue;
        };
        let replayed = contest.replay(referee, &results[result], &mut recorder);
        if replayed.map_err(Failure::internal)?.is_some() {
            let maze = &contest.mazes[results[result].maze];
            let mut picture = replay::ways(&maze.maze, &recorder.trace);
            let robot = &contest.entrants[line.entrant].name;
            picture.set_title(&format!("{robot} in {}", maze.name));
            let svg = picture.to_svg();
            portraits.push(Portrait { result, svg });
        }
    }
    let page = page(contest, results, standings, &portraits);
    output::save(path, page.as_bytes(), existing)?;
    message!("wrote {}", path.display());
    Ok(())
}

/// The match in which an entrant came nearest to the floor; without a finished
/// one, its first.
pub fn best_match(contest: &Contest, results: &[MatchResult], entrant: usize) -> Option<usize> {
    let own = || {
        let numbered = results.iter().enumerate();
        numbered.filter(move |(_, result)| result.entrant == entrant)
    };
    let regret = |result: &MatchResult| -> Option<Mean> {
        let Verdict::Finished(score) = &result.outcome.verdict else {
            return None;
        };
        let floor = contest.mazes[result.maze].floor?;
        Some(Mean::from(*score).minus(Mean::from(floor)))
    };
    let finished = own().filter_map(|(index, result)| Some((regret(result)?, index)));
    finished
        .min()
        .map(|(_, index)| index)
        .or_else(|| own().next().map(|(index, _)| index))
}
