//! [`Survey`]: counts over many mazes.
//!
//! What a collection of maze files is like, before anyone runs a contest on it.
//! Pure: whoever reads the files tells the survey about each of them.

use std::collections::BTreeMap;

use super::legality::{goal_entrances, is_contest_legal, unreachable_cells};
use super::{Cell, Maze};

/// Counts over the maze files seen so far. Unit of every number: files.
///
/// ```
/// use wasmouse_core::maze::{Maze, Survey, Walls};
/// let mut survey = Survey::default();
/// survey.add(&Maze::contest(Walls::open(12)).expect("start and goal fit"));
/// survey.add_refused();
/// assert_eq!((survey.files, survey.parsed, survey.solvable), (2, 1, 1));
/// assert_eq!(survey.several_entrances(), 1);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Survey {
    /// All files, those that are no mazes included.
    pub files: usize,
    /// Files that hold a maze; the counts below are about these.
    pub parsed: usize,
    /// Mazes that keep all contest rules.
    pub contest_legal: usize,
    /// Mazes in which a goal cell can be reached from the start.
    pub solvable: usize,
    /// Mazes with cells, in the goal or elsewhere, that cannot be reached.
    pub with_unreachable: usize,
    /// Mazes by the number of open edges into their goal.
    pub by_entrances: BTreeMap<usize, usize>,
}

impl Survey {
    /// Counts a maze.
    pub fn add(&mut self, maze: &Maze) {
        let unreachable = unreachable_cells(maze);
        let is_reached = |cell: &Cell| unreachable.binary_search(cell).is_err();
        self.files += 1;
        self.parsed += 1;
        self.contest_legal += usize::from(is_contest_legal(maze));
        self.solvable += usize::from(maze.goal().cells().any(|cell| is_reached(&cell)));
        self.with_unreachable += usize::from(!unreachable.is_empty());
        *self
            .by_entrances
            .entry(goal_entrances(maze).len())
            .or_default() += 1;
    }

    /// Counts a file that holds no maze.
    pub fn add_refused(&mut self) {
        self.files += 1;
    }

    /// Mazes with two or more entrances to their goal.
    pub fn several_entrances(&self) -> usize {
        self.by_entrances.range(2..).map(|(_, count)| count).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Heading, Walls};
    use super::*;

    #[test]
    fn a_closed_goal_cell_does_not_make_a_maze_unsolvable() {
        let mut walls = Walls::open(12);
        for heading in Heading::ALL {
            walls.set(Cell::new(5, 5), heading, false);
        }
        let mut survey = Survey::default();
        survey.add(&Maze::contest(walls).expect("start and goal fit"));
        assert_eq!((survey.solvable, survey.with_unreachable), (1, 1));
        assert_eq!(survey.by_entrances, BTreeMap::from([(6, 1)]));
    }

    #[test]
    fn a_closed_goal_does() {
        let mut survey = Survey::default();
        survey.add(&Maze::contest(Walls::closed(12)).expect("start and goal fit"));
        assert_eq!((survey.parsed, survey.solvable), (1, 0));
        assert_eq!(survey.several_entrances(), 0);
    }
}
