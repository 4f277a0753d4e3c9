//! `run --watch`: what a contest has just played.

use std::time::Duration;

use wasmouse_core::maze::Maze;
use wasmouse_core::playback::Playback;
use wasmouse_core::record::{MatchRecord, trace};
use wasmouse_engine::Executor;

use super::super::again::play_again;
use super::super::exit::Exit;
use super::super::failure::Failure;
use super::show::Show;
use super::start::{Options, play};
use crate::contest::{Plan, Player, Results};

/// Shows the only match of a contest, or the matches of two robots in the same maze, until the
/// viewer quits.
///
/// # Errors
///
/// When there are other matches, or standard output is not a terminal.
pub fn watch(
    plan: &Plan,
    players: &[Player],
    executor: &dyn Executor,
    results: &Results,
    delay: Duration,
    ascii: bool,
) -> Result<Exit, Failure> {
    let records: Vec<&MatchRecord> = match &results.matches[..] {
        [only] => vec![only],
        [a, b] if a.key.maze == b.key.maze => vec![a, b],
        matches => {
            let count = matches.len();
            let message = format!(
                "--watch shows one match, or two in the same maze, and this contest has {count}"
            );
            return Err(Failure::usage(message).hint("name one robot or two, and one maze"));
        }
    };
    let mut shows = Vec::new();
    for record in records {
        let replayed = play_again(plan, players, executor, record).map_err(Failure::internal)?;
        let Some(replayed) = replayed else {
            return Ok(Exit::Success);
        };
        let maze = &replayed.maze.maze;
        let recording = replayed.detailed.recording;
        let rules = plan.rules.game;
        let (_, trace) = trace(maze, &rules, &recording.transcript).map_err(Failure::internal)?;
        let verdict = replayed.detailed.record.verdict;
        let maze = Maze::clone(maze);
        let playback = Playback::new(maze, rules, trace, verdict, recording.journal);
        let robot = &plan.entrants[replayed.player.entrants[0]].name;
        shows.push(Show::new(robot, &replayed.maze.name, playback));
    }
    let options = Options {
        delay,
        position: 0,
        playing: true,
        ascii,
        what: "--watch",
        hint: "leave it out",
    };
    play(shows, &options)
}
