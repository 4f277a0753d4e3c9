//! Robots by mazes: every match as a cell, warmer the larger its regret.

use maud::{Markup, html};

use super::parts::{caption, label, more};
use super::player::Player;
use super::scale::percentile;
use crate::contest::{MatchScore, Mean, Outcome, worst_score_steps};
use crate::report::contest::address::Addresses;
use crate::report::contest::playable::Place;
use crate::report::contest::view::View;
use crate::report::contest::words::NONE;

/// Cells at most: browsers are slow to lay out larger tables.
const CELLS_MAX: usize = 6000;

/// Columns at most.
const ROBOTS_MAX: usize = 60;

/// Levels of heat above none.
const LEVELS: u64 = 9;

/// The matches of a robot in a maze.
struct Cell {
    /// Average score of the finished ones.
    score: Option<Mean>,
    finished: u32,
    played: u32,
    /// The first that was not finished.
    unfinished: Option<Outcome>,
    /// In thousandths of a step, of those that are finished; `None` without any.
    regret: Option<u64>,
}

/// The table; `None` if no maze is shown or nothing was played.
pub(super) fn scores(view: &View<'_>, player: Option<&Player>) -> Option<Markup> {
    let robots = view.robots.iter().copied();
    let robots = robots.filter(|&robot| view.robot(robot).not_admitted.is_none());
    let robots: Vec<usize> = robots.take(ROBOTS_MAX).collect();
    if robots.is_empty() || view.mazes.is_empty() {
        return None;
    }
    let mazes = mazes(view, &robots);
    let rows: Vec<(usize, Vec<Cell>)> = mazes
        .iter()
        .map(|&maze| {
            (
                maze,
                robots
                    .iter()
                    .map(|&robot| cell(view, robot, maze))
                    .collect(),
            )
        })
        .collect();
    let mut regrets: Vec<u64> = rows
        .iter()
        .flat_map(|(_, cells)| cells)
        .filter_map(|cell| cell.regret)
        .collect();
    regrets.sort_unstable();
    // One bad match must not make all others look alike.
    let hottest = percentile(&regrets, 95).unwrap_or(0).max(1);
    let addresses = (!view.report.options.hide_names).then(|| Addresses::new(view.report));
    let seeds = view.matrix().seeds.count;
    Some(html! {
        p { "Scores; lower is better. The warmer a cell, the larger the regret."
            @if seeds > 1 { " Each is the average of the finished of " (seeds) " matches." } }
        p.key { "Regret:" span { "0" } @for level in 1..=LEVELS {
            @let from = hottest * (level - 1) / LEVELS;
            span class={ "h" (level) } { "over " (from / 1000) "." (from % 1000 / 100) }
        } span.u { "not finished" } }
        div.scroll.tall tabindex="0" role="group" aria-label="Robots by mazes" {
            table.sortable.heat id="scores" data-filter="Show mazes with" {
                (caption("Score of each robot in each maze, in steps. Oracle: the score of a robot \
                           that knows the maze."))
                thead { tr {
                    th.name scope="col" { "Maze" }
                    th scope="col" { "Oracle" }
                    @for &robot in &robots { th scope="col" { (label(view.name(robot))) } }
                } }
                tbody { @for (maze, cells) in &rows { tr {
                    th.name scope="row" { (label(&view.maze(*maze).name)) }
                    td { (view.maze(*maze).oracle.map_or_else(|| NONE.to_owned(), |it| it.to_string())) }
                    @for (&robot, cell) in robots.iter().zip(cells) {
                        @let address = addresses.as_ref().filter(|_| cell.played > 0);
                        @let address = address.map(|it| it.get(robot, *maze, 0));
                        @let place = Place { maze: *maze, robot, seed: 0 };
                        @let play = player.and_then(|it| it.position(place));
                        td class=[class(cell, hottest)] data-match=[address] data-play=[play] { (text(cell)) }
                    }
                } } }
            }
        }
        (more(mazes.len(), view.mazes.len(), "mazes, the hardest ones; the others are in the CSV of the matches"))
        (more(robots.len(), robots_played(view), "robots, the best ones"))
    })
}

fn robots_played(view: &View<'_>) -> usize {
    let robots = view.robots.iter();
    robots
        .filter(|&&robot| view.robot(robot).not_admitted.is_none())
        .count()
}

/// The mazes that have room: all, or the hardest, in the order of the contest.
fn mazes(view: &View<'_>, robots: &[usize]) -> Vec<usize> {
    let max = (CELLS_MAX / robots.len()).max(1);
    let mut mazes = view.mazes.clone();
    if mazes.len() > max {
        let worst = u64::from(worst_score_steps(&view.matrix().rules.game)) * 1000;
        let hardness = |&maze: &usize| {
            let cells = robots.iter().map(|&robot| cell(view, robot, maze));
            let regrets = cells
                .filter(|cell| cell.played > 0)
                .map(|cell| match cell.unfinished {
                    Some(_) => worst,
                    None => cell.regret.unwrap_or(0),
                });
            std::cmp::Reverse(regrets.sum::<u64>())
        };
        mazes.sort_by_cached_key(hardness);
        mazes.truncate(max);
        mazes.sort_unstable();
    }
    mazes
}

fn cell(view: &View<'_>, robot: usize, maze: usize) -> Cell {
    let matrix = view.matrix();
    let seeds = 0..matrix.seeds.count;
    let played: Vec<&MatchScore> = seeds
        .filter_map(|seed| matrix.get(robot, maze, seed))
        .collect();
    let scores = played.iter().filter_map(|it| it.score(&matrix.rules));
    let score: Option<Mean> = scores.map(Mean::from).collect();
    let is_finished = |it: &&&MatchScore| it.outcome == Outcome::Finished;
    let finished = played.iter().filter(is_finished).count();
    let oracle = view.maze(maze).oracle.map(Mean::from);
    let regret = score
        .zip(oracle)
        .map(|(score, oracle)| score.minus(oracle).thousandths());
    Cell {
        score,
        finished: u32::try_from(finished).unwrap_or(u32::MAX),
        played: u32::try_from(played.len()).unwrap_or(u32::MAX),
        unfinished: played
            .iter()
            .map(|it| it.outcome)
            .find(|it| *it != Outcome::Finished),
        regret: regret.map(|it| u64::try_from(it).unwrap_or(0)),
    }
}

fn class(cell: &Cell, hottest: u64) -> Option<String> {
    match cell.regret {
        _ if cell.unfinished.is_some() => Some("u".to_owned()),
        None | Some(0) => None,
        Some(regret) => Some(format!(
            "h{}",
            (regret * LEVELS).div_ceil(hottest).min(LEVELS)
        )),
    }
}

fn text(cell: &Cell) -> String {
    match (cell.score, cell.unfinished) {
        (Some(score), None) => score.to_string(),
        (Some(score), Some(_)) => format!("{score} ({} of {})", cell.finished, cell.played),
        (None, Some(Outcome::Fault(_))) => "fault".to_owned(),
        (None, Some(Outcome::BudgetUsedUp { goal_reached: true })) => "budget, goal".to_owned(),
        (None, Some(_)) => "budget".to_owned(),
        (None, None) => NONE.to_owned(),
    }
}
