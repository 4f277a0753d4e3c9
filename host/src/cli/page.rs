//! Writes the web page of a contest that has just been played.

use std::io::{self, Write as _};
use std::path::Path;

use wasmouse_core::Digest;
use wasmouse_engine::engine_id;

use super::failure::Failure;
use super::output::{self, Draft, message};
use crate::contest::{
    BestMatch, BestMatches, Complaints, ContestMatch, ContestMaze, HardestMazes, MatrixBuilder,
    Plan, Player, ScoreMatrix, Scoring, Sink,
};
use crate::report::contest::{
    ContestReport, MatchPicture, PICTURES_MAX, Pictures, Place, Playable, ReportOptions, html,
};
use crate::report::text::Text;

/// Mazes whose matches are shown, at most; fewer of many robots.
const HARDEST_MAX: usize = 6;

/// Collects what the page needs while a contest is played.
pub struct PageBuilder {
    matrix: MatrixBuilder,
    best: BestMatches,
    hardest: HardestMazes,
    played: Played,
}

/// Collects the transcripts of matches, as long as there is room for them in a page.
struct Played {
    players: Vec<Player>,
    first_seed: u64,
    /// The maze in progress.
    maze: Option<ContestMaze>,
    /// How many mazes there were.
    mazes: usize,
    playable: Playable,
}

impl Played {
    /// The matches of all robots that a player stands for, which have the same file and variant.
    fn places(
        players: &[Player],
        player: usize,
        maze: usize,
        seed: u32,
    ) -> impl Iterator<Item = Place> {
        let robots = players[player].entrants.iter();
        robots.map(move |&robot| Place { maze, robot, seed })
    }
}

impl Sink for Played {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.maze = Some(maze.clone());
        self.mazes += 1;
        Ok(())
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        let maze = self.maze.as_ref().expect("a maze comes before its matches");
        let seed = played.record.key.seed.wrapping_sub(self.first_seed) as u32;
        for place in Self::places(&self.players, played.player, self.mazes - 1, seed) {
            self.playable.add(place, &maze.maze, &played.transcript);
        }
        Ok(())
    }
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
            played: Played {
                players: plan.players(),
                first_seed: plan.seeds.first,
                maze: None,
                mazes: 0,
                playable: Playable::default(),
            },
        }
    }

    /// What has to be told about the matches.
    pub fn sinks(&mut self) -> [&mut dyn Sink; 4] {
        [
            &mut self.matrix,
            &mut self.best,
            &mut self.hardest,
            &mut self.played,
        ]
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
        let hardest = self.hardest.into_matches();
        let hardest = hardest.iter().map(|it| (it.played.player, it));
        // What has a picture can be watched, whatever else there is room for.
        let mut playable = Playable::default();
        let shown = best.clone();
        for (player, shown) in shown.chain(hardest.clone()) {
            add(&mut playable, &matrix, &players, player, shown);
        }
        playable.extend(&self.played.playable);
        let best = pictures(&matrix, &players, best)?;
        let hardest = pictures(&matrix, &players, hardest)?;
        let (scoring, engine) = (Scoring::default(), engine_id());
        let options = ReportOptions::default();
        let name = "wasmouse contest";
        let report = ContestReport::new(name, &matrix, &scoring, &engine, plan.matches(), options)
            .with_results_digest(digest)
            .with_pictures(Pictures { best, hardest })
            .with_playable(playable)
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

/// Adds a match of a player; one in a maze that the matrix does not have is left out.
fn add(
    playable: &mut Playable,
    matrix: &ScoreMatrix,
    players: &[Player],
    player: usize,
    shown: &BestMatch,
) {
    let BestMatch { played, maze } = shown;
    let mut mazes = matrix.mazes.iter();
    let Some(index) = mazes.position(|it| it.digest == maze.digest) else {
        return;
    };
    let seed = played.record.key.seed.wrapping_sub(matrix.seeds.first) as u32;
    for place in Played::places(players, player, index, seed) {
        playable.add(place, &maze.maze, &played.transcript);
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
