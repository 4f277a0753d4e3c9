//! [`Ranking`]: who did how well.

use std::cmp::Ordering;

use wasmouse_core::guest_text::GuestStr;

use super::line::RankingLine;
use super::order::RankKey;
use super::percentiles::{Percentiles, percentile_scores};
use super::points::Points;
use super::rank_points::{RankPoints, UNFINISHED};
use super::selection::{MazeFilter, RobotState, Selection};
use super::totals::Totals;
use crate::contest::matrix::ScoreMatrix;
use crate::contest::mean::Mean;
use crate::contest::scoring::{Method, Scoring};
use crate::contest::tally::Regret;

/// The ranking of robots by what they did in some mazes.
///
/// A maze counts when every robot has played it with every seed. Robots with matches that the host
/// could not play have no rank, and neither they nor those that have not started take part in
/// deciding which mazes count: one robot cannot keep the others from being ranked. Mazes whose goal
/// cannot be reached count for nothing, because nobody can finish them.
///
/// Ranks are decided by exact numbers: they depend neither on the order of robots and mazes nor on
/// rounding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ranking {
    /// How many mazes count.
    pub mazes: u64,
    /// How many mazes of the filter have a goal that cannot be reached.
    pub mazes_unreachable: u64,
    /// How many mazes the filter leaves of the matrix.
    pub mazes_total: u64,
    /// Whether some maze of the matrix whose goal can be reached does not count yet. Mazes that a
    /// contest has still to prepare are in no matrix.
    pub partial: bool,
    /// What an unfinished match counts as, in steps.
    pub penalty_steps: u32,
    /// One line for each robot: those with a rank, best first, then by state; equal ones by name.
    pub lines: Vec<RankingLine>,
}

impl Ranking {
    /// Ranks the robots of a class, or all, by what they did in the mazes of a filter.
    pub fn new(
        matrix: &ScoreMatrix,
        scoring: &Scoring,
        filter: MazeFilter,
        class: Option<GuestStr<'_>>,
    ) -> Self {
        let selection = Selection::new(matrix, filter, class);
        let points = Points::new(&matrix.rules, scoring);
        let (mut totals, rank_points) = add_up(matrix, &selection, &points);
        let mut robots = Vec::with_capacity(totals.len());
        for (position, totals) in totals.iter_mut().enumerate() {
            let percentiles = percentile_scores(&mut totals.scores);
            let key = RankKey {
                totals,
                median: percentiles.map(|[_, _, median, _, _]| median),
                half_points: rank_points.half_points[position],
            };
            robots.push((position, key, percentiles));
        }
        let state = |position: usize| selection.states[position];
        let name = |position: usize| &matrix.robots[selection.robots[position]].name;
        robots.sort_by(|(a, a_key, _), (b, b_key, _)| {
            let by_state = state(*a).cmp(&state(*b));
            let by_result = || match state(*a) {
                RobotState::Ranked => a_key.compare(b_key, scoring),
                _ => Ordering::Equal,
            };
            let by_name = || name(*a).cmp(name(*b));
            by_state.then_with(by_result).then_with(by_name)
        });
        let mut lines: Vec<RankingLine> = Vec::with_capacity(robots.len());
        for (place, (position, key, percentiles)) in robots.iter().enumerate() {
            let mut line = line(*position, key, *percentiles, (&selection, &points, scoring));
            if line.state == RobotState::Ranked && !selection.mazes.is_empty() {
                let last = place.checked_sub(1).map(|it| &robots[it].1);
                let is_tie = last.is_some_and(|it| it.compare(key, scoring).is_eq());
                let place = u32::try_from(place + 1).unwrap_or(u32::MAX);
                line.rank = match lines.last() {
                    Some(last) if is_tie => last.rank,
                    _ => Some(place),
                };
            }
            lines.push(line);
        }
        let mazes = selection.mazes.len() as u64;
        Self {
            mazes,
            mazes_unreachable: selection.mazes_unreachable,
            mazes_total: selection.mazes_total,
            partial: mazes + selection.mazes_unreachable < selection.mazes_total,
            penalty_steps: scoring.penalty_steps(&matrix.rules.game),
            lines,
        }
    }
}

/// Adds up the matches of every robot in the mazes that count.
fn add_up(
    matrix: &ScoreMatrix,
    selection: &Selection,
    points: &Points,
) -> (Vec<Totals>, RankPoints) {
    let count = selection.robots.len();
    let mut totals = vec![Totals::default(); count];
    let mut rank_points = RankPoints::new(count);
    let seeds = matrix.seeds.count;
    for totals in &mut totals {
        let matches = selection.mazes.len() * seeds as usize;
        totals.scores.reserve_exact(matches);
    }
    for (place, &maze) in selection.mazes.iter().enumerate() {
        let has_played = selection.has_played(place);
        let weight = matrix.weight(maze);
        let Some(oracle) = matrix.mazes[maze].oracle else {
            continue;
        };
        for seed in 0..seeds {
            let row = matrix.row(maze, seed);
            for (position, &robot) in selection.robots.iter().enumerate() {
                let played = row[robot].as_ref().filter(|_| has_played[position]);
                let Some(played) = played else {
                    continue;
                };
                if selection.states[position] == RobotState::Ranked {
                    rank_points.push(position, points.score(played).unwrap_or(UNFINISHED));
                }
                totals[position].add(played, oracle, weight, points);
            }
            rank_points.end_match(weight);
        }
    }
    (totals, rank_points)
}

fn line(
    position: usize,
    key: &RankKey<'_>,
    percentiles: Option<[u64; 5]>,
    (selection, points, scoring): (&Selection, &Points, &Scoring),
) -> RankingLine {
    let state = selection.states[position];
    let totals = key.totals;
    let (weight, finished) = (totals.weight, totals.weight_finished);
    let mean_score = points.mean(totals.score, weight);
    let mean_regret = points.mean(totals.score - totals.oracle, weight);
    let (exploration, speed) = (totals.exploration_regret, totals.speed_regret);
    let divisor = i128::from(points.divisor);
    let is_ranked = state == RobotState::Ranked && weight > 0;
    let rank_points = is_ranked.then(|| Mean::fraction(key.half_points.into(), 2));
    let finished_regret = (finished > 0).then(|| Regret {
        total: Mean::fraction(
            exploration + speed * divisor,
            divisor * i128::from(finished),
        ),
        exploration: Mean::fraction(exploration, divisor * i128::from(finished)),
        speed: Mean::fraction(speed, finished.into()),
    });
    RankingLine {
        robot: selection.robots[position],
        rank: None,
        state,
        value: match scoring.method {
            Method::MeanScore => mean_score,
            Method::Regret => mean_regret,
            Method::RankPoints => rank_points,
        },
        matches: totals.matches,
        finished: totals.finished,
        budget_used_up: totals.budget_used_up,
        goal_reached: totals.goal_reached,
        faults: totals.faults,
        unplayed: selection.unplayed[position],
        optimal_speed_runs: totals.optimal,
        finish_rate: (weight > 0).then(|| Mean::fraction(finished.into(), weight.into())),
        mean_score,
        mean_finished_score: points.mean(totals.finished_score, finished),
        percentiles: percentiles.map(|it| Percentiles::new(points, it)),
        rank_points,
        mean_regret,
        finished_regret,
        mean_exploration_steps: totals.mean_exploration_steps(),
        step_fuel_mean: totals.step_fuel(),
        step_fuel_max: totals.step_fuel_max,
        memory_bytes_max: totals.memory_bytes_max,
    }
}
