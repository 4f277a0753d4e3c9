//! [`HardestMazes`]: the matches in the hardest mazes, with what it takes to show them.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::io;

use wasmouse_core::game::Ruleset;

use super::best::BestMatch;
use super::maze_source::ContestMaze;
use super::scoring::worst_score_steps;
use super::sink::{ContestMatch, Sink};

/// Keeps the matches with the first seed in the mazes in which the players' regrets add up to
/// most; of equal ones the first. An unfinished match counts as the worst score.
#[derive(Debug)]
pub struct HardestMazes {
    mazes_max: usize,
    first_seed: u64,
    unfinished_thousandths: u64,
    current: Vec<BestMatch>,
    maze: Option<ContestMaze>,
    mazes: u64,
    /// By regret, then by the negative position of the maze: the least hard one is first.
    kept: BTreeMap<(u64, Reverse<u64>), Vec<BestMatch>>,
}

impl HardestMazes {
    /// Keeps the matches of at most `mazes_max` mazes.
    pub fn new(mazes_max: usize, rules: &Ruleset, first_seed: u64) -> Self {
        Self {
            mazes_max,
            first_seed,
            unfinished_thousandths: u64::from(worst_score_steps(&rules.game)) * 1000,
            current: Vec::new(),
            maze: None,
            mazes: 0,
            kept: BTreeMap::new(),
        }
    }

    /// The matches, maze by maze in the order of the plan, each maze with its players in theirs.
    pub fn into_matches(mut self) -> Vec<BestMatch> {
        self.end_maze();
        let mut kept: Vec<_> = self.kept.into_iter().collect();
        kept.sort_by_key(|((_, Reverse(position)), _)| *position);
        kept.into_iter().flat_map(|(_, matches)| matches).collect()
    }

    fn end_maze(&mut self) {
        let matches = std::mem::take(&mut self.current);
        if matches.is_empty() || self.mazes_max == 0 {
            return;
        }
        let regrets = matches.iter().map(|it| self.regret(it));
        self.kept
            .insert((regrets.sum(), Reverse(self.mazes)), matches);
        if self.kept.len() > self.mazes_max {
            self.kept.pop_first();
        }
    }

    fn regret(&self, shown: &BestMatch) -> u64 {
        let oracle = shown.maze.oracle.map_or(0, |oracle| oracle.thousandths());
        let score = shown.played.record.verdict.score();
        let score = score.map_or(self.unfinished_thousandths, |it| it.thousandths());
        score.saturating_sub(oracle)
    }
}

impl Sink for HardestMazes {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.end_maze();
        self.mazes += 1;
        self.maze = Some(maze.clone());
        Ok(())
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        // Nobody can finish a maze without a way to the goal, which makes it not hard.
        let maze = self.maze.as_ref().filter(|maze| maze.oracle.is_some());
        if let Some(maze) = maze.filter(|_| played.record.key.seed == self.first_seed) {
            self.current.push(BestMatch {
                played: played.clone(),
                maze: maze.clone(),
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use wasmouse_core::game::{FaultKind, Score};
    use wasmouse_core::maze::{Maze, Walls};
    use wasmouse_core::record::Transcript;

    use super::super::tally::tests::{fault, finished};
    use super::*;

    #[test]
    fn the_hardest_mazes_are_kept_in_their_order() {
        let maze = Arc::new(Maze::contest(Walls::open(12)).expect("start and goal fit"));
        let rules = Ruleset::default();
        let seed = finished(1, 1).key.seed;
        let mut hardest = HardestMazes::new(2, &rules, seed);
        for (name, records) in [
            ("two", vec![finished(30, 30), finished(30, 20)]),
            ("easy", vec![finished(30, 20), finished(30, 20)]),
            ("as easy", vec![finished(30, 20), finished(30, 20)]),
            ("one", vec![fault(FaultKind::Panic), finished(30, 20)]),
            (
                "no way",
                vec![fault(FaultKind::Panic), fault(FaultKind::Panic)],
            ),
        ] {
            let maze = ContestMaze {
                is_generated: false,
                name: name.into(),
                maze: Arc::clone(&maze),
                digest: maze.digest(),
                oracle: (name != "no way").then(|| Score::new(9, 10, 30)),
            };
            hardest.maze(&maze).expect("it only keeps");
            for (player, record) in records.into_iter().enumerate() {
                let mut other_seed = record.clone();
                other_seed.key.seed = seed + 1;
                for record in [record, other_seed] {
                    let transcript = Transcript::default();
                    let played = ContestMatch {
                        player,
                        record,
                        transcript,
                    };
                    hardest.played(&played).expect("it only keeps");
                }
            }
        }
        let matches = hardest.into_matches();
        let kept: Vec<_> = matches
            .iter()
            .map(|it| (it.maze.name.as_guest(), it.played.player))
            .collect();
        let expected = [("two", 0), ("two", 1), ("one", 0), ("one", 1)];
        assert_eq!(kept, expected.map(|(maze, player)| (maze.into(), player)));
    }
}
