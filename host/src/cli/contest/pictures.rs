//! Pictures of matches whose transcripts a store has, for the web page of a contest.

use wasmouse_core::maze::Maze;
use wasmouse_core::record::MatchKey;
use wasmouse_engine::engine_id;

use super::super::failure::Failure;
use super::super::store_failure::store_failure;
use crate::contest::{Mean, Ranking, ScoreMatrix};
use crate::report::contest::{MatchPicture, PICTURES_MAX, Pictures};
use crate::store::Store;

/// Mazes of which all robots are shown.
const HARDEST: usize = 4;

/// Pictures of the best match of each robot, the first robots first, and of all robots in the
/// hardest mazes, as far as transcripts were kept.
///
/// # Errors
///
/// When the store cannot be read.
pub fn pictures(
    store: &Store,
    matrix: &ScoreMatrix,
    ranking: &Ranking,
) -> Result<Pictures, Failure> {
    let mut pictures = Pictures::default();
    for line in ranking.lines.iter().take(PICTURES_MAX / 2) {
        let robot = &matrix.robots[line.robot];
        let best = store.best_match(
            &engine_id().digest(),
            &matrix.rules,
            &robot.digest,
            robot.variant,
        );
        let Some((record, _)) = best.map_err(store_failure)? else {
            continue;
        };
        let maze = matrix
            .mazes
            .iter()
            .position(|it| it.digest == record.key.maze);
        let seed = record.key.seed.wrapping_sub(matrix.seeds.first);
        let seed = u32::try_from(seed)
            .ok()
            .filter(|it| *it < matrix.seeds.count);
        if let (Some(maze), Some(seed)) = (maze, seed) {
            pictures
                .best
                .extend(picture(store, matrix, (line.robot, maze, seed))?);
        }
    }
    for maze in hardest(matrix) {
        for line in &ranking.lines {
            if pictures.best.len() + pictures.hardest.len() >= PICTURES_MAX {
                break;
            }
            pictures
                .hardest
                .extend(picture(store, matrix, (line.robot, maze, 0))?);
        }
    }
    Ok(pictures)
}

/// The mazes in which robots did worst on average, compared with the oracle: the hardest first.
/// Those of hidden sets are not among them.
fn hardest(matrix: &ScoreMatrix) -> Vec<usize> {
    let mut mazes: Vec<(u64, Option<Mean>, usize)> = Vec::new();
    for (index, maze) in matrix.mazes.iter().enumerate() {
        let Some(oracle) = maze.oracle.filter(|_| !matrix.sets[maze.set].is_hidden) else {
            continue;
        };
        let row = matrix.row(index, 0).iter().flatten();
        let scores = row.clone().filter_map(|it| it.score(&matrix.rules));
        let unfinished = row.count() - scores.clone().count();
        let regret = scores.map(|it| Mean::from(it).minus(Mean::from(oracle)));
        mazes.push((unfinished as u64, regret.collect::<Option<Mean>>(), index));
    }
    mazes.sort_by(|a, b| (b.0, b.1).cmp(&(a.0, a.1)).then(a.2.cmp(&b.2)));
    mazes.into_iter().take(HARDEST).map(|it| it.2).collect()
}

/// The picture of a match; `None` when its transcript was not kept.
fn picture(
    store: &Store,
    matrix: &ScoreMatrix,
    (robot, maze_index, seed): (usize, usize, u32),
) -> Result<Option<MatchPicture>, Failure> {
    let (entry, digest) = (&matrix.robots[robot], matrix.mazes[maze_index].digest);
    let key = MatchKey {
        engine: engine_id().digest(),
        rules: matrix.rules.digest(),
        robot: entry.digest,
        variant: entry.variant,
        maze: digest,
        seed: matrix.seeds.get(seed),
    };
    let Some(transcript) = store.transcript(&key).map_err(store_failure)? else {
        return Ok(None);
    };
    let maze: Option<Maze> = store
        .maze(&digest)
        .map_err(store_failure)?
        .map(|it| it.maze);
    let Some(maze) = maze else { return Ok(None) };
    let place = (robot, maze_index, seed);
    MatchPicture::new(place, &maze, &matrix.rules.game, &transcript)
        .map(Some)
        .map_err(|error| {
            Failure::internal(format!("the transcript of match {}: {error}", key.digest()))
        })
}
