//! [`Standings`]: who did how well.

use std::cmp::Reverse;
use std::collections::HashMap;
use std::io;

use serde::{Deserialize, Serialize};
use wasmouse_core::game::Score;
use wasmouse_core::{Digest, GuestText};

use super::maze_source::ContestMaze;
use super::mean::Mean;
use super::plan::{Plan, Player};
use super::sink::{ContestMatch, MatchFailure, Sink};
use super::tally::Tally;

/// The ranking of a contest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Standings {
    /// Mazes that the ranks are about: those that every robot has played with every seed. Robots
    /// with matches that the host could not play do not count.
    pub mazes: u64,
    /// Whether there are other mazes in the contest: the ranking is then a partial one.
    pub partial: bool,
    /// One line for each entrant, best first.
    pub lines: Vec<Standing>,
}

/// One line of the standings.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Standing {
    /// Counted from 1; robots that did equally well share a rank. `None` for a robot that was
    /// not admitted or has matches that the host could not play, and for all while no maze was
    /// played by every robot.
    pub rank: Option<u32>,
    /// The entrant's name.
    pub robot: GuestText,
    /// Matches played in the ranked mazes.
    pub matches: u64,
    /// Matches finished with a score.
    pub finished: u64,
    /// Matches whose budget ran out after the exploration run had reached the goal.
    pub goal_reached: u64,
    /// Matches that ended in a fault.
    pub faults: u64,
    /// Average score of the finished matches, in thousandths of a step.
    pub mean_score_thousandths: Option<i64>,
    /// Average of score minus oracle score over the finished matches, in thousandths of a step.
    pub mean_regret_thousandths: Option<i64>,
}

/// Counts matches maze by maze, as they arrive.
///
/// One robot with matches that the host could not play does not keep the others from being
/// ranked: it has no rank, and which mazes count does not depend on it.
#[derive(Debug)]
pub struct StandingsBuilder {
    /// Matches of one player in a maze that it has played.
    matches_per_maze: u64,
    mazes_planned: u64,
    mazes: u64,
    /// The players by robot and variant.
    players: HashMap<(Digest, u32), usize>,
    /// By player, whether the host could not play all of its matches.
    incomplete: Vec<bool>,
    /// By player, over the mazes that count.
    tallies: Vec<Tally>,
    /// By player, of the maze in progress.
    current: Vec<Tally>,
    /// Mazes that are not known to count: only when some player turns out to be incomplete.
    /// There are few, because only an interrupted contest leaves such mazes.
    pending: Vec<Vec<Tally>>,
    oracle: Option<Score>,
}

impl StandingsBuilder {
    /// Standings without matches.
    pub fn new(plan: &Plan, players: &[Player]) -> Self {
        let by_key = players.iter().enumerate();
        Self {
            matches_per_maze: u64::from(plan.seeds.count),
            mazes_planned: plan.mazes.len() as u64,
            mazes: 0,
            players: by_key
                .map(|(index, it)| ((*it.robot.digest(), it.variant), index))
                .collect(),
            incomplete: vec![false; players.len()],
            tallies: vec![Tally::default(); players.len()],
            current: vec![Tally::default(); players.len()],
            pending: Vec::new(),
            oracle: None,
        }
    }

    /// Says that the host could not play all matches of a robot.
    pub fn set_incomplete(&mut self, robot: Digest, variant: u32) {
        if let Some(&player) = self.players.get(&(robot, variant)) {
            self.incomplete[player] = true;
        }
    }

    /// Takes the maze in progress into account when every robot has played it.
    fn end_maze(&mut self) {
        let empty = vec![Tally::default(); self.current.len()];
        let maze = std::mem::replace(&mut self.current, empty);
        if !self.count_maze(&maze) && maze.iter().any(|tally| tally.matches > 0) {
            self.pending.push(maze);
        }
    }

    /// Counts a maze if every robot has played it that is not known to be incomplete.
    fn count_maze(&mut self, maze: &[Tally]) -> bool {
        let has_played = |tally: &Tally| tally.matches == self.matches_per_maze;
        let mut players = maze.iter().zip(&self.incomplete);
        let counts = players.all(|(tally, &is_incomplete)| is_incomplete || has_played(tally))
            && maze.iter().any(has_played);
        if counts {
            self.mazes += 1;
            for (tally, current) in self.tallies.iter_mut().zip(maze) {
                if current.matches == self.matches_per_maze {
                    tally.merge(current);
                }
            }
        }
        counts
    }

    /// The standings of everything that has arrived.
    ///
    /// More finished matches rank higher; among as many, the lower average score of those.
    /// Robots whose matches could not all be played come next, and last those that were not
    /// admitted, in the order of the plan.
    pub fn finish(mut self, plan: &Plan, players: &[Player]) -> Standings {
        self.end_maze();
        for maze in std::mem::take(&mut self.pending) {
            self.count_maze(&maze);
        }
        let mut by_entrant: Vec<Option<(bool, &Tally)>> = vec![None; plan.entrants.len()];
        for (player, tally) in players
            .iter()
            .zip(self.incomplete.iter().zip(&self.tallies))
        {
            for &entrant in &player.entrants {
                by_entrant[entrant] = Some((*tally.0, tally.1));
            }
        }
        let mut order: Vec<usize> = (0..plan.entrants.len()).collect();
        let key = |(is_incomplete, tally): (bool, &Tally)| (is_incomplete, key(tally));
        order.sort_by_key(|&entrant| (by_entrant[entrant].is_none(), by_entrant[entrant].map(key)));
        let mut lines = Vec::with_capacity(order.len());
        let (mut rank, mut last) = (0, None);
        for (place, &entrant) in order.iter().enumerate() {
            let tally = by_entrant[entrant];
            let key = tally.map(key);
            if key != last {
                rank = u32::try_from(place + 1).unwrap_or(u32::MAX);
                last = key;
            }
            let is_ranked = tally.is_some_and(|it| !it.0) && self.mazes > 0;
            let tally = tally.map(|it| *it.1).unwrap_or_default();
            lines.push(Standing {
                rank: is_ranked.then_some(rank),
                robot: plan.entrants[entrant].name.clone(),
                matches: tally.matches,
                finished: tally.finished,
                goal_reached: tally.goal_reached,
                faults: tally.faults,
                mean_score_thousandths: tally.mean_score().map(Mean::thousandths),
                mean_regret_thousandths: tally.mean_regret().map(|it| it.total.thousandths()),
            });
        }
        Standings {
            mazes: self.mazes,
            partial: self.mazes < self.mazes_planned,
            lines,
        }
    }
}

/// What robots are ranked by, the best smallest. A missing average only meets other missing
/// ones: it belongs to 0 finished matches.
fn key(tally: &Tally) -> (Reverse<u64>, Option<Mean>) {
    (Reverse(tally.finished), tally.mean_score())
}

impl Sink for StandingsBuilder {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.end_maze();
        self.oracle = maze.oracle;
        Ok(())
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        self.current[played.player].add(&played.record, self.oracle);
        Ok(())
    }

    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.set_incomplete(failure.key.robot, failure.key.variant);
        Ok(())
    }

    fn withdrawn(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.failed(failure)
    }
}
