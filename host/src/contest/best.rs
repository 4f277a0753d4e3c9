//! [`BestMatches`]: the best match of each robot, with what it takes to show it.

use std::cmp::Reverse;
use std::io;

use wasmouse_core::game::Verdict;
use wasmouse_core::record::MatchRecord;

use super::maze_source::ContestMaze;
use super::sink::{ContestMatch, Sink};

/// A match that is worth showing.
#[derive(Clone, Debug)]
pub struct BestMatch {
    /// The match.
    pub played: ContestMatch,
    /// Its maze.
    pub maze: ContestMaze,
}

/// Keeps the best match of each player, the first of equals: the one with the smallest regret;
/// without a score, the one that reached the goal, or else took the most steps.
#[derive(Debug, Default)]
pub struct BestMatches {
    best: Vec<Option<BestMatch>>,
    maze: Option<ContestMaze>,
}

impl BestMatches {
    /// By player; `None` for one that has played no match.
    pub fn best(&self) -> &[Option<BestMatch>] {
        &self.best
    }

    /// By player; `None` for one that has played no match.
    pub fn into_best(self) -> Vec<Option<BestMatch>> {
        self.best
    }
}

impl Sink for BestMatches {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.maze = Some(maze.clone());
        Ok(())
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        let maze = self.maze.as_ref().expect("a maze comes before its matches");
        if self.best.len() <= played.player {
            self.best.resize(played.player + 1, None);
        }
        let best = &mut self.best[played.player];
        let is_better = best
            .as_ref()
            .is_none_or(|best| key(&played.record, maze) < key(&best.played.record, &best.maze));
        if is_better {
            *best = Some(BestMatch {
                played: played.clone(),
                maze: maze.clone(),
            });
        }
        Ok(())
    }
}

/// The better a match, the smaller.
fn key(record: &MatchRecord, maze: &ContestMaze) -> (u8, u64, Reverse<u32>) {
    let steps = Reverse(record.steps.total());
    match &record.verdict {
        Verdict::Finished { score } => {
            let oracle = maze.oracle.map_or(0, |oracle| oracle.thousandths());
            (0, score.thousandths().saturating_sub(oracle), steps)
        }
        Verdict::BudgetUsedUp { goal_reached: true } => (1, 0, steps),
        Verdict::BudgetUsedUp { .. } | Verdict::Fault { .. } => (2, 0, steps),
    }
}
