//! Writes the web page of a contest that has just been played.

use std::io::Write as _;
use std::path::Path;

use wasmouse_core::Digest;
use wasmouse_engine::engine_id;

use super::failure::Failure;
use super::output::{self, Draft, message};
use crate::contest::{
    BestMatch, BestMatches, Complaints, HardestMazes, MatrixBuilder, Plan, Player, ScoreMatrix,
    Scoring, Sink,
};
use crate::report::contest::{
    ContestReport, MatchPicture, PICTURES_MAX, Pictures, ReportOptions, html,
};
use crate::report::text::Text;

/// Mazes whose matches are shown, at most; fewer of many robots.
const HARDEST_MAX: usize = 6;

/// Collects what the page needs while a contest is played.
pub struct PageBuilder {
    matrix: MatrixBuilder,
    best: BestMatches,
    hardest: HardestMazes,
}

impl PageBuilder {
    /// The page of a plan, without matches.
    pub fn new(plan: &Plan) -> Self {
        let players = plan.players().len().max(1);
        let mazes = (PICTURES_MAX / players).clamp(1, HARDEST_MAX);
        Self {
            matrix: MatrixBuilder::new(plan),
            best: BestMatches::default(),
            hardest: HardestMazes::new(mazes, &plan.rules, plan.seeds.first),
        }
    }

    /// What has to be told about the matches.
    pub fn sinks(&mut self) -> [&mut dyn Sink; 3] {
        [&mut self.matrix, &mut self.best, &mut self.hardest]
    }

    /// The best match of each player; `None` for one that has played no match.
    pub fn best(&self) -> &[Option<BestMatch>] {
        self.best.best()
    }

    /// Draws the pictures and writes the page. `digest` is that of the results; complaints go with
    /// the faults.
    ///
    /// # Errors
    ///
    /// When the file cannot be written.
    pub fn write(
        self,
        mut draft: Draft,
        path: &Path,
        plan: &Plan,
        (digest, complaints): (Digest, &Complaints),
    ) -> Result<(), Failure> {
        let players = plan.players();
        let matrix = self.matrix.finish();
        let best = self.best.into_best();
        let best = best.iter().enumerate();
        let best = best.filter_map(|(player, best)| Some((player, best.as_ref()?)));
        let best = pictures(&matrix, &players, best)?;
        let hardest = self.hardest.into_matches();
        let hardest = hardest.iter().map(|it| (it.played.player, it));
        let hardest = pictures(&matrix, &players, hardest)?;
        let (scoring, engine) = (Scoring::default(), engine_id());
        let options = ReportOptions::default();
        let name = "wasmouse contest";
        let report = ContestReport::new(name, &matrix, &scoring, &engine, plan.matches(), options)
            .with_results_digest(digest)
            .with_pictures(Pictures { best, hardest })
            .with_complaints(complaints.iter().flat_map(|(player, kind, complaint)| {
                let robots = players[player].entrants.iter();
                robots.map(move |&robot| ((robot, kind), complaint.clone()))
            }));
        // Names are escaped where they are put into the page; this is for one that was forgotten.
        let page = Text::of_lines(&html(&report));
        let written = draft.write_all(page.as_str().as_bytes());
        written.map_err(|error| output::failure(path, &error))?;
        draft.commit()?;
        message!("wrote {}", Text::of_path(path));
        Ok(())
    }
}

/// The pictures of matches, each with the index of its player.
fn pictures<'a>(
    matrix: &ScoreMatrix,
    players: &[Player],
    matches: impl Iterator<Item = (usize, &'a BestMatch)>,
) -> Result<Vec<MatchPicture>, Failure> {
    let matches = matches.take(PICTURES_MAX);
    let pictures = matches.map(|(player, shown)| {
        let robot = players[player].entrants[0];
        MatchPicture::of_match(matrix, robot, shown)
    });
    let pictures: Result<Vec<Option<MatchPicture>>, _> = pictures.collect();
    Ok(pictures
        .map_err(Failure::internal)?
        .into_iter()
        .flatten()
        .collect())
}
