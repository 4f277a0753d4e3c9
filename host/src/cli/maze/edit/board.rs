//! [`Board`]: the maze that is edited, and its history.

use wasmouse_core::maze::{Cell, Heading, Maze, Walls};

/// A wall between two cells, named by either of them.
type Wall = (Cell, Heading);

/// A maze, every change since it was read, and those that were undone.
pub struct Board {
    maze: Maze,
    /// Each toggles its walls, so it is its own inverse.
    done: Vec<Vec<Wall>>,
    undone: Vec<Vec<Wall>>,
    /// How many changes there were when it was last saved; `None` if that cannot come back.
    saved: Option<usize>,
}

impl Board {
    /// A board with that maze on it; `is_saved` says whether a file has it.
    pub const fn new(maze: Maze, is_saved: bool) -> Self {
        Self {
            maze,
            done: Vec::new(),
            undone: Vec::new(),
            saved: if is_saved { Some(0) } else { None },
        }
    }

    /// The maze as it is now.
    pub const fn maze(&self) -> &Maze {
        &self.maze
    }

    /// Whether the maze differs from what was saved.
    pub fn is_modified(&self) -> bool {
        self.saved != Some(self.done.len())
    }

    /// Notes that a file has the maze as it is now.
    pub fn set_saved(&mut self) {
        self.saved = Some(self.done.len());
    }

    /// How many changes can be undone, and how many can be done again.
    pub fn history(&self) -> (usize, usize) {
        (self.done.len(), self.undone.len())
    }

    /// Whether there is a cell on that side of a cell, so that the wall can be opened.
    pub fn is_inner(&self, (cell, side): Wall) -> bool {
        self.maze.walls().neighbor(cell, side).is_some()
    }

    /// Opens or closes walls in one change; those of the perimeter and those that are so already
    /// stay as they are. A change that is `joined` is undone with the one before. Returns whether
    /// anything changed.
    pub fn set(&mut self, walls: &[Wall], open: bool, joined: bool) -> bool {
        let is_other = |&(cell, side): &Wall| self.maze.walls().is_open(cell, side) != open;
        let changed: Vec<Wall> = walls
            .iter()
            .copied()
            .filter(|&wall| self.is_inner(wall))
            .filter(is_other)
            .collect();
        if changed.is_empty() {
            return false;
        }
        self.toggle_all(&changed);
        self.undone.clear();
        if self.saved > Some(self.done.len()) {
            // What was saved has been undone, and now it cannot be done again.
            self.saved = None;
        }
        // What was saved stays a step of its own.
        let joins = joined && self.saved != Some(self.done.len());
        match self.done.last_mut().filter(|_| joins) {
            Some(before) => before.extend(changed),
            None => self.done.push(changed),
        }
        true
    }

    /// Undoes the last change; returns whether there was one.
    pub fn undo(&mut self) -> bool {
        let change = self.done.pop();
        change.is_some_and(|change| {
            self.toggle_all(&change);
            self.undone.push(change);
            true
        })
    }

    /// Does again what was undone last; returns whether there was anything.
    pub fn redo(&mut self) -> bool {
        let change = self.undone.pop();
        change.is_some_and(|change| {
            self.toggle_all(&change);
            self.done.push(change);
            true
        })
    }

    fn toggle_all(&mut self, changed: &[Wall]) {
        let mut walls: Walls = self.maze.walls().clone();
        for &(cell, side) in changed {
            let open = walls.is_open(cell, side);
            walls.set(cell, side, !open);
        }
        let (start, goal) = (self.maze.start(), self.maze.goal());
        self.maze = Maze::new(walls, start, goal).expect("start and goal are as before");
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn board() -> Board {
        let maze = Maze::contest(Walls::open(4)).expect("start and goal fit");
        Board::new(maze, true)
    }

    #[test]
    fn changes_are_undone_and_done_again_one_by_one() {
        let mut board = board();
        let before = board.maze().clone();
        let around = Heading::ALL.map(|side| (Cell::new(1, 1), side));
        assert!(board.set(&around, false, false));
        assert!(!board.set(&around, false, false), "they are closed already");
        assert!(board.set(&around[..1], true, false));
        let after = board.maze().clone();
        assert_eq!(after.walls().value(Cell::new(1, 1)), 1);
        assert_eq!(board.history(), (2, 0));
        assert!(board.undo() && board.undo() && !board.undo());
        assert_eq!(board.maze(), &before);
        assert!(!board.is_modified());
        assert!(board.redo() && board.redo() && !board.redo());
        assert_eq!(board.maze(), &after);
        assert!(board.is_modified());
    }

    #[test]
    fn the_perimeter_stays_closed() {
        let mut board = board();
        assert!(!board.set(&[(Cell::new(0, 0), Heading::Left)], true, false));
        assert!(!board.is_modified());
    }

    #[test]
    fn what_was_saved_can_be_lost() {
        let mut board = board();
        let wall = |x| [(Cell::new(x, 0), Heading::Up)];
        board.set(&wall(0), false, false);
        board.set_saved();
        board.undo();
        assert!(board.is_modified(), "the file has the wall");
        board.redo();
        assert!(!board.is_modified());
        board.undo();
        board.set(&wall(1), false, false);
        assert!(board.is_modified(), "another wall, after as many changes");
        board.set(&wall(2), false, true);
        assert_eq!(board.history(), (1, 0), "joined");
        board.set_saved();
        board.set(&wall(3), false, true);
        assert_eq!(board.history(), (2, 0), "what was saved stays a step");
    }

    proptest! {
        /// Whatever was done: undoing all of it gives the maze that was read, and doing all of it
        /// again gives the maze that was left.
        #[test]
        fn undo_and_redo_are_inverse(
            changes in prop::collection::vec((0..4u8, 0..4u8, 0..4usize, any::<bool>(), any::<bool>()), 0..30)
        ) {
            let mut board = board();
            let before = board.maze().clone();
            for (x, y, side, open, joined) in changes {
                board.set(&[(Cell::new(x, y), Heading::ALL[side])], open, joined);
            }
            let after = board.maze().clone();
            while board.undo() {}
            prop_assert_eq!(board.maze(), &before);
            prop_assert!(!board.is_modified());
            while board.redo() {}
            prop_assert_eq!(board.maze(), &after);
        }
    }
}
