//! [`Survey`]: counts over many mazes.
//!
//! A summary of a collection of maze files. The caller reads the files.

use std::collections::BTreeMap;

use super::legality::{goal_entrances, is_contest_legal, unreachable_cells};
use super::{Cell, Maze};

/// Counts over the maze files that were added. All numbers are numbers of files.
///
/// ```
/// use wasmouse_core::maze::{Maze, Survey, Walls};
/// let mut survey = Survey::default();
/// survey.add(&Maze::contest(Walls::open(12)).expect("start and goal fit"));
/// survey.add_rejected();
/// assert_eq!((survey.files, survey.parsed, survey.solvable), (2, 1, 1));
/// assert_eq!(survey.several_entrances(), 1);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Survey {
    /// All files, including those that are not mazes.
    pub files: usize,
    /// Files that are mazes; the counts below are about these.
    pub parsed: usize,
    /// Mazes that follow all contest rules.
    pub contest_legal: usize,
    /// Mazes with a goal cell that is reachable from the start.
    pub solvable: usize,
    /// Mazes with unreachable cells, in the goal or elsewhere.
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

    /// Counts a file that is not a maze.
    pub fn add_rejected(&mut self) {
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
    fn a_maze_with_one_closed_goal_cell_is_solvable() {
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
    fn a_maze_with_a_closed_goal_is_not_solvable() {
        let mut survey = Survey::default();
        survey.add(&Maze::contest(Walls::closed(12)).expect("start and goal fit"));
        assert_eq!((survey.parsed, survey.solvable), (1, 0));
        assert_eq!(survey.several_entrances(), 0);
    }
}
