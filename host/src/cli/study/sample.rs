//! Slow robots play a sample of a study's generated mazes.
//!
//! A robot that thinks for a second a match would take an hour for all of them. It
//! plays the first few of every family and size, so that each counts as much as in
//! the whole, and all official and competition mazes. The page says who plays a
//! sample, and every table of how many.

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::run;
use crate::contest::{Contest, Group, Played};
use crate::report::reference::Competitor;
use crate::robot::Referee;

/// The bundled robots that are slow, with their settings.
const SLOW: &[(&str, &str)] = &[("champion", "deep")];

/// How many mazes of each family and size they play.
const MAZES: usize = 10;

/// Plays a study: slow robots a sample, and the others all of it. The exit code says
/// whether everything that was to be played was.
pub(super) fn play(
    contest: &Contest,
    groups: &[Group],
    competitors: &[Competitor],
    referee: &Referee,
    threads: usize,
) -> Result<(Played, Exit), Failure> {
    let (slow, quick): (Vec<usize>, Vec<usize>) =
        (0..competitors.len()).partition(|&entrant| is_slow(&competitors[entrant]));
    let mazes = 0..contest.mazes.len();
    let all: Vec<usize> = mazes.clone().collect();
    let sampled: Vec<usize> = mazes
        .filter(|&maze| is_in_sample(contest, groups, maze))
        .collect();
    let mut whole = Played::default();
    let mut exit = Exit::Success;
    for (entrants, mazes) in [(quick, &all), (slow, &sampled)] {
        if entrants.is_empty() {
            continue;
        }
        let part = part(contest, &entrants, mazes);
        let mut played = run::play(&part, referee, threads)?;
        let part_exit = run::exit(&part, &played);
        for result in &mut played.results {
            result.entrant = entrants[result.entrant];
            result.maze = mazes[result.maze];
        }
        for failed in &mut played.failed {
            failed.entrant = entrants[failed.entrant];
            failed.maze = mazes[failed.maze];
        }
        whole.results.append(&mut played.results);
        whole.failed.append(&mut played.failed);
        if part_exit != Exit::Success {
            exit = part_exit;
        }
        if !super::is_whole(exit) {
            break;
        }
    }
    whole.results.sort_by_key(|it| (it.entrant, it.maze));
    Ok((whole, exit))
}

fn is_slow(competitor: &Competitor) -> bool {
    let is_it = |&(robot, setting): &(&str, &str)| competitor.is(robot, Some(setting));
    SLOW.iter().any(is_it)
}

/// Whether slow robots play a maze: all but the later ones of a family and size.
fn is_in_sample(contest: &Contest, groups: &[Group], maze: usize) -> bool {
    let Some(group) = groups.iter().find(|group| group.mazes.contains(&maze)) else {
        return true;
    };
    let size = |maze: usize| contest.mazes[maze].maze.dimension();
    // Groups are ordered by size.
    let is_alike = |&it: &usize| size(it) == size(maze);
    (group.mazes.start..maze).filter(is_alike).count() < MAZES
}

/// Some entrants in some mazes.
fn part(contest: &Contest, entrants: &[usize], mazes: &[usize]) -> Contest {
    Contest {
        entrants: entrants
            .iter()
            .map(|&it| contest.entrants[it].clone())
            .collect(),
        mazes: mazes.iter().map(|&it| contest.mazes[it].clone()).collect(),
        seeds: contest.seeds.clone(),
        rules: contest.rules,
    }
}
