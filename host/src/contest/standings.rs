//! [`standings`]: who did how well.

use std::cmp::Reverse;

use super::{Contest, MatchResult, Mean, Tally};

/// One line of the standings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Standing {
    /// Counted from 1; entrants that did equally well share a rank. `None` for
    /// an entrant that was refused.
    pub rank: Option<u32>,
    /// Index into [`Contest::entrants`].
    pub entrant: usize,
    /// Matches played.
    pub matches: u32,
    /// Matches finished with a score.
    pub finished: u32,
    /// Matches whose budget ran out after run 1 had reached the goal.
    pub goal_reached: u32,
    /// Matches that ended in a fault.
    pub faults: u32,
    /// Average score of the finished matches.
    pub score: Option<Mean>,
    /// Average of score minus floor over the finished matches: how much worse
    /// than a robot that knows the maze.
    pub regret: Option<Mean>,
}

/// The standings of a contest, best first.
///
/// More finished matches rank higher; among as many, the lower average score
/// over the finished ones. Refused entrants come last, in the contest's order.
pub fn standings(contest: &Contest, results: &[MatchResult]) -> Vec<Standing> {
    let mut lines: Vec<Standing> = (0..contest.entrants.len())
        .map(|entrant| standing(contest, entrant, &[]))
        .collect();
    // Results come in the contest's order, so those of an entrant are together.
    for own in results.chunk_by(|a, b| a.entrant == b.entrant) {
        let entrant = own[0].entrant;
        lines[entrant] = standing(contest, entrant, own);
    }
    lines.sort_by_key(|line| {
        let refused = contest.entrants[line.entrant].admission.is_err();
        (refused, key(line), line.entrant)
    });
    let mut rank = 0;
    for place in 0..lines.len() {
        if contest.entrants[lines[place].entrant].admission.is_err() {
            break;
        }
        if place == 0 || key(&lines[place]) != key(&lines[place - 1]) {
            rank = u32::try_from(place + 1).unwrap_or(u32::MAX);
        }
        lines[place].rank = Some(rank);
    }
    lines
}

/// What entrants are ranked by, the best smallest. `None` scores only meet each
/// other: they belong to 0 finished matches.
fn key(line: &Standing) -> (Reverse<u32>, Option<Mean>) {
    (Reverse(line.finished), line.score)
}

fn standing(contest: &Contest, entrant: usize, results: &[MatchResult]) -> Standing {
    let tally = Tally::of(contest, results);
    Standing {
        rank: None,
        entrant,
        matches: tally.matches,
        finished: tally.finished,
        goal_reached: tally.goal_reached,
        faults: tally.faults,
        score: tally.score,
        regret: tally.regret.map(|regret| regret.total),
    }
}
