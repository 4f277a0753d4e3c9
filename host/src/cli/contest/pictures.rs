//! Matches whose transcripts a store has, for the web page of a contest: as pictures, and to be
//! watched.

use wasmouse_core::record::MatchKey;
use wasmouse_engine::engine_id;

use super::super::failure::Failure;
use super::super::store_failure::store_failure;
use crate::contest::{Mean, ScoreMatrix};
use crate::report::contest::{
    ContestReport, MatchPicture, PICTURES_MAX, Pictures, Place, Playable,
};
use crate::store::Store;

/// Mazes of which all robots are shown.
const HARDEST: usize = 4;

/// Pictures of the best match of each robot, the first robots first, and of all robots in the
/// hardest mazes, as far as transcripts were kept; and these matches to be watched, with all others
/// if `keeps_all` says that the store has them.
///
/// # Errors
///
/// When the store cannot be read.
pub fn pictures(
    store: &Store,
    report: &ContestReport<'_>,
    keeps_all: bool,
) -> Result<(Pictures, Playable), Failure> {
    let mut pictures = Pictures::default();
    let mut playable = Playable::default();
    let (matrix, ranking) = (report.matrix, &report.overall);
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
            let place = Place {
                maze,
                robot: line.robot,
                seed,
            };
            let picture = picture(store, matrix, place, &mut playable)?;
            pictures.best.extend(picture);
        }
    }
    for maze in hardest(matrix) {
        for line in &ranking.lines {
            if pictures.best.len() + pictures.hardest.len() >= PICTURES_MAX {
                break;
            }
            let place = Place {
                maze,
                robot: line.robot,
                seed: 0,
            };
            let picture = picture(store, matrix, place, &mut playable)?;
            pictures.hardest.extend(picture);
        }
    }
    if keeps_all {
        let hides_mazes = report.options.hide_hidden_mazes;
        add_all(store, matrix, hides_mazes, &mut playable)?;
    }
    Ok((pictures, playable))
}

/// Adds all matches, maze by maze, as long as there is room.
fn add_all(
    store: &Store,
    matrix: &ScoreMatrix,
    hides_mazes: bool,
    playable: &mut Playable,
) -> Result<(), Failure> {
    for (index, entry) in matrix.mazes.iter().enumerate() {
        if hides_mazes && matrix.sets[entry.set].is_hidden {
            continue;
        }
        let Some(maze) = store.maze(&entry.digest).map_err(store_failure)? else {
            continue;
        };
        for robot in 0..matrix.robots.len() {
            for seed in 0..matrix.seeds.count {
                if playable.is_full() {
                    return Ok(());
                }
                let place = Place {
                    maze: index,
                    robot,
                    seed,
                };
                if matrix.get(robot, index, seed).is_none() {
                    continue;
                }
                let transcript = store.transcript(&key(matrix, place));
                if let Some(transcript) = transcript.map_err(store_failure)? {
                    playable.add(place, &maze.maze, &transcript);
                }
            }
        }
    }
    Ok(())
}

/// The identity of a match.
fn key(matrix: &ScoreMatrix, place: Place) -> MatchKey {
    let robot = &matrix.robots[place.robot];
    MatchKey {
        engine: engine_id().digest(),
        rules: matrix.rules.digest(),
        robot: robot.digest,
        variant: robot.variant,
        maze: matrix.mazes[place.maze].digest,
        seed: matrix.seeds.get(place.seed),
    }
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

/// The picture of a match, which can then be watched, too; `None` when its transcript was not kept.
fn picture(
    store: &Store,
    matrix: &ScoreMatrix,
    place: Place,
    playable: &mut Playable,
) -> Result<Option<MatchPicture>, Failure> {
    let key = key(matrix, place);
    let Some(transcript) = store.transcript(&key).map_err(store_failure)? else {
        return Ok(None);
    };
    let Some(stored) = store.maze(&key.maze).map_err(store_failure)? else {
        return Ok(None);
    };
    playable.add(place, &stored.maze, &transcript);
    let indices = (place.robot, place.maze, place.seed);
    MatchPicture::new(indices, &stored.maze, &matrix.rules.game, &transcript)
        .map(Some)
        .map_err(|error| {
            Failure::internal(format!("the transcript of match {}: {error}", key.digest()))
        })
}
