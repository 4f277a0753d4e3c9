//! Writes the web page of a contest, with a picture of each robot's best match.

use std::io::Write as _;
use std::path::Path;

use super::failure::Failure;
use super::output::{self, Draft, message};
use crate::contest::{BestMatch, Player, Results};
use crate::report::page::{BestRun, Page};
use crate::report::text::Text;

/// More pictures than this make a page slow to load.
const PICTURES_MAX: usize = 60;

/// Draws the best matches, those of the best robots first, and writes the page. `matches` says
/// whether the results have them all.
///
/// # Errors
///
/// When the file cannot be written.
pub fn write(
    mut draft: Draft,
    path: &Path,
    results: &Results,
    players: &[Player],
    best: &[Option<BestMatch>],
) -> Result<(), Failure> {
    let lines = &results.summary.standings.lines;
    let place = |player: &Player| {
        let robot = &results.contest.robots[player.entrants[0]].name;
        lines.iter().position(|line| line.robot == *robot)
    };
    let mut best: Vec<(Option<usize>, &BestMatch)> = players
        .iter()
        .zip(best)
        .filter_map(|(player, best)| Some((place(player), best.as_ref()?)))
        .collect();
    best.sort_by_key(|(place, _)| *place);
    let runs = best.iter().take(PICTURES_MAX);
    let runs = runs.map(|(_, best)| BestRun::new(&results.contest, best));
    let runs: Vec<BestRun> = runs.collect::<Result<_, _>>().map_err(Failure::internal)?;
    let has_matches = results.matches.len() as u64 == results.summary.matches;
    let page = Page {
        contest: &results.contest,
        matches: has_matches.then_some(&results.matches[..]),
        matches_played: results.summary.matches,
        summary: &results.summary,
        best: &runs,
    };
    // Names are escaped where they are put into the page; this is for one that was forgotten.
    let html = Text::of_lines(&page.to_html());
    let written = draft.write_all(html.as_str().as_bytes());
    written.map_err(|error| output::failure(path, &error))?;
    draft.commit()?;
    message!("wrote {}", Text::of_path(path));
    Ok(())
}
