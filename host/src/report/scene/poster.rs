//! [`poster`]: the [best match of each maze](best_of_mazes).

use std::collections::HashMap;

use wasmouse_core::game::Score;
use wasmouse_core::replay::Replay;
use wasmouse_core::{Digest, guest_text};

use super::caption;
use super::overlays::{Overlays, scene};
use super::sequence::columns;
use super::shot::Shot;
use crate::report::picture::{Caption, Sheet};

/// Matches of a poster, at most.
pub const POSTER_MAX: usize = 60;

/// The best finished match of each maze, in the order of the mazes: the one with the lowest score,
/// and of equal ones the first. Mazes that nobody finished are left out.
pub fn best_of_mazes(replays: &[Replay]) -> Vec<&Replay> {
    let mut best: Vec<(&Replay, Score)> = Vec::new();
    let mut places: HashMap<Digest, usize> = HashMap::new();
    for replay in replays {
        let record = &replay.parts().record;
        let Some(score) = record.verdict.score() else {
            continue;
        };
        let place = *places.entry(record.key.maze).or_insert(best.len());
        match best.get_mut(place) {
            Some(other) if score < other.1 => *other = (replay, score),
            Some(_) => {}
            None => best.push((replay, score)),
        }
    }
    best.into_iter().map(|it| it.0).collect()
}

/// Matches at their end in a grid, at most [`POSTER_MAX`] of them, with maze, robot and result
/// below each.
pub fn poster(title: &str, shots: &[Shot<'_>], overlays: &Overlays) -> Sheet {
    let shots = &shots[..shots.len().min(POSTER_MAX)];
    let mut sheet = Sheet::new(title, columns(shots.len()));
    for shot in shots {
        let last = shot.playback.last();
        let caption = Caption {
            name: guest_text!("{}: {}", shot.maze, shot.robot),
            detail: caption::ending(shot.playback),
        };
        sheet.push(scene(shot.playback, last, overlays), caption);
    }
    sheet
}

#[cfg(test)]
mod tests {
    use wasmouse_core::GuestText;
    use wasmouse_core::game::{Action, Ruleset};
    use wasmouse_core::journal::Journal;
    use wasmouse_core::maze::{Maze, Turn, Walls};
    use wasmouse_core::record::{MatchKey, MatchRecord, Transcript, Usage, replay};
    use wasmouse_core::replay::ReplayParts;

    use super::*;

    /// A match in an open maze of that size, with so many steps that lead nowhere before the goal.
    fn match_in(dimension: u8, robot: &str, idle: usize, reaches_goal: bool) -> Replay {
        let maze = Maze::contest(Walls::open(dimension)).expect("start and goal fit");
        let mut rules = Ruleset::default();
        let mut transcript = Transcript::default();
        let drive = |turn, advance| Action::Move { turn, advance };
        for _ in 0..idle {
            transcript.push(drive(Turn::Straight, 0));
        }
        for _ in 0..2 {
            transcript.push(drive(Turn::Straight, 1));
            transcript.push(drive(Turn::Right, if reaches_goal { 1 } else { 0 }));
            if reaches_goal && transcript.actions().count() == idle + 2 {
                transcript.push(Action::Reset);
            }
        }
        if !reaches_goal {
            rules.game.budget = u32::try_from(idle + 4).expect("few");
        }
        let result = replay(&maze, &rules.game, &transcript).expect("a whole match");
        let key = MatchKey {
            engine: Digest::of(b"an engine"),
            rules: rules.digest(),
            robot: Digest::of(robot.as_bytes()),
            variant: 0,
            maze: maze.digest(),
            seed: 0,
        };
        let record = MatchRecord::new(key, result, Usage::default(), &transcript);
        Replay::new(ReplayParts {
            robot: robot.into(),
            maze_name: format!("open-{dimension}").into(),
            maze,
            rules,
            record,
            transcript,
            journal: Journal::default(),
        })
        .expect("it fits together")
    }

    #[test]
    fn the_best_match_of_each_maze_is_the_first_with_the_lowest_score() {
        let replays = [
            match_in(4, "unfinished", 0, false),
            match_in(4, "slow", 9, true),
            match_in(4, "fast", 2, true),
            match_in(4, "as fast", 2, true),
        ];
        let best = best_of_mazes(&replays);
        let names: Vec<_> = best.iter().map(|it| &it.parts().robot).collect();
        assert_eq!(names, [&GuestText::from("fast")]);
        assert!(best_of_mazes(&replays[..1]).is_empty());
    }
}
