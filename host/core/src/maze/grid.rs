//! The walls of a square grid ([`Walls`]) and a playable [`Maze`] made of them.
//!
//! A wall belongs to the two cells that it separates. Both cells have a bit for it, and
//! [`Walls::set`] writes both, so that reading is one load and the two never disagree. The
//! perimeter is always closed: the formats reject a file with a gap in it, because a robot
//! could leave the maze there.

use std::fmt;
use std::ops::RangeInclusive;

use super::{Area, Cell, Heading};
use crate::Digest;

/// The supported maze sizes, in cells along each side.
///
/// Contest mazes have 12 to 16 cells (up to 20 in the reports), half-size contest mazes 32;
/// 64 leaves some room and still bounds the memory that a file can claim.
pub const DIMENSIONS: RangeInclusive<u8> = 2..=64;

/// The walls of a square grid of cells with a closed perimeter.
///
/// ```
/// use wasmouse_core::maze::{Cell, Heading, Walls};
/// let mut walls = Walls::closed(12);
/// walls.set(Cell::new(0, 0), Heading::Up, true);
/// assert!(walls.is_open(Cell::new(0, 1), Heading::Down));
/// assert!(!walls.is_open(Cell::new(0, 0), Heading::Left));
/// ```
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Walls {
    dimension: u8,
    /// One Udacity value per cell, column by column: bit set = side open.
    open: Box<[u8]>,
}

impl Walls {
    /// A grid of `dimension` x `dimension` cells with all walls.
    ///
    /// # Panics
    ///
    /// If `dimension` is outside [`DIMENSIONS`].
    pub fn closed(dimension: u8) -> Self {
        assert!(
            DIMENSIONS.contains(&dimension),
            "dimension {dimension} is outside 2..=64"
        );
        Self {
            dimension,
            open: vec![0; usize::from(dimension) * usize::from(dimension)].into(),
        }
    }

    /// A grid with no walls but the perimeter.
    ///
    /// # Panics
    ///
    /// If `dimension` is outside [`DIMENSIONS`].
    pub fn open(dimension: u8) -> Self {
        let mut walls = Self::closed(dimension);
        for (cell, heading) in walls.edges() {
            walls.set(cell, heading, true);
        }
        walls
    }

    /// The grid whose cells have these [values](Walls::value), in the order of [`Walls::cells`].
    /// `None` unless there are as many as cells, the two cells of every edge agree about it, and
    /// the perimeter is closed.
    fn from_values(dimension: u8, values: &[u8]) -> Option<Self> {
        let column = usize::from(dimension);
        if !DIMENSIONS.contains(&dimension) || values.len() != column * column {
            return None;
        }
        // Workers read a maze for every few matches, so all cells are compared without a branch:
        // a bit of `wrong` is set where two cells disagree, or where there can be no opening.
        let side = |value: u8, heading: Heading| value >> heading as u8 & 1;
        let mut wrong = values.iter().fold(0, |all, value| all | value & 0xf0);
        for cells in values.chunks_exact(column) {
            wrong |= side(cells[0], Heading::Down) | side(cells[column - 1], Heading::Up);
            for (below, above) in cells.iter().zip(&cells[1..]) {
                wrong |= side(*below, Heading::Up) ^ side(*above, Heading::Down);
            }
        }
        let (first, last) = (&values[..column], &values[values.len() - column..]);
        for (left, right) in first.iter().zip(last) {
            wrong |= side(*left, Heading::Left) | side(*right, Heading::Right);
        }
        for (left, right) in values.iter().zip(&values[column..]) {
            wrong |= side(*left, Heading::Right) ^ side(*right, Heading::Left);
        }
        if wrong != 0 {
            return None;
        }
        Some(Self {
            dimension,
            open: values.into(),
        })
    }

    /// Cells along each side, in [`DIMENSIONS`].
    pub const fn dimension(&self) -> u8 {
        self.dimension
    }

    /// All cells, column by column from the left, each from the bottom up.
    pub fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let n = self.dimension;
        (0..n).flat_map(move |x| (0..n).map(move |y| Cell::new(x, y)))
    }

    /// The edges between two cells, each once: the cell below or to the left of the edge, and
    /// its side, up or right. In the order of [`Walls::cells`], up first.
    pub fn edges(&self) -> impl Iterator<Item = (Cell, Heading)> + use<> {
        let n = self.dimension;
        self.cells().flat_map(move |cell| {
            let up = (cell.y + 1 < n).then_some((cell, Heading::Up));
            let right = (cell.x + 1 < n).then_some((cell, Heading::Right));
            [up, right].into_iter().flatten()
        })
    }

    /// Whether `cell` is in the grid.
    pub const fn contains(&self, cell: Cell) -> bool {
        cell.x < self.dimension && cell.y < self.dimension
    }

    /// The position of `cell` in the order of [`Walls::cells`]. Range: 0 to dimension² - 1.
    pub const fn index(&self, cell: Cell) -> usize {
        cell.x as usize * self.dimension as usize + cell.y as usize
    }

    /// The cell on that side, whether there is a wall or not; `None` outside the grid.
    pub fn neighbor(&self, cell: Cell, heading: Heading) -> Option<Cell> {
        cell.step(heading).filter(|&cell| self.contains(cell))
    }

    /// Whether `cell` has no wall on that side. The perimeter is never open.
    ///
    /// # Panics
    ///
    /// If `cell` is outside the grid.
    pub fn is_open(&self, cell: Cell, heading: Heading) -> bool {
        self.value(cell) & heading.bit() != 0
    }

    /// The sides of `cell` as a Udacity value: the sum of 1 up, 2 right, 4 down
    /// and 8 left, for the sides that are open. Range: 0 to 15.
    ///
    /// # Panics
    ///
    /// If `cell` is outside the grid.
    pub fn value(&self, cell: Cell) -> u8 {
        assert!(self.contains(cell), "{cell} is outside the maze");
        self.open[self.index(cell)]
    }

    /// Opens or closes that side of `cell`, and the same side of its neighbour.
    ///
    /// # Panics
    ///
    /// If `cell` is outside the grid, or if the call would open the perimeter.
    pub fn set(&mut self, cell: Cell, heading: Heading, open: bool) {
        assert!(self.contains(cell), "{cell} is outside the maze");
        let Some(neighbor) = self.neighbor(cell, heading) else {
            assert!(!open, "the perimeter cannot be opened at {cell}, {heading}");
            return;
        };
        for (cell, heading) in [(cell, heading), (neighbor, heading.opposite())] {
            let value = &mut self.open[self.index(cell)];
            *value = *value & !heading.bit() | u8::from(open) << heading as u8;
        }
    }
}

impl fmt::Debug for Walls {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Walls")
            .field("dimension", &self.dimension)
            .finish_non_exhaustive()
    }
}

/// Why walls, a start and a goal do not form a maze.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MazeError {
    /// The start is outside the grid.
    #[error("start {start} is outside the {dimension} x {dimension} maze")]
    StartOutside {
        /// The requested start.
        start: Cell,
        /// Cells along each side.
        dimension: u8,
    },
    /// A goal cell is outside the grid.
    #[error("goal cell {cell} is outside the {dimension} x {dimension} maze")]
    GoalOutside {
        /// The first goal cell outside.
        cell: Cell,
        /// Cells along each side.
        dimension: u8,
    },
    /// The start is in the goal, which leaves nothing to find.
    #[error("start {start} is in the goal")]
    StartInGoal {
        /// The requested start.
        start: Cell,
    },
}

/// A maze for a match: walls, a start and a goal.
///
/// A maze is immutable: it also stores the distance to the nearest wall from every cell in
/// every direction, so that a sensor reading is one load. It need not follow the contest
/// rules: see [`violations`](super::violations).
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Maze {
    walls: Walls,
    start: Cell,
    goal: Area,
    /// Open cells to the nearest wall, by cell index and heading.
    reach: Box<[[u8; 4]]>,
}

impl Maze {
    /// The maze with these walls, start and goal.
    ///
    /// # Errors
    ///
    /// If the start or a goal cell is outside the grid, or the start is in the goal.
    pub fn new(walls: Walls, start: Cell, goal: Area) -> Result<Self, MazeError> {
        let dimension = walls.dimension();
        if !walls.contains(start) {
            return Err(MazeError::StartOutside { start, dimension });
        }
        if let Some(cell) = goal.cells().find(|&cell| !walls.contains(cell)) {
            return Err(MazeError::GoalOutside { cell, dimension });
        }
        if goal.contains(start) {
            return Err(MazeError::StartInGoal { start });
        }
        Ok(Self {
            reach: reaches(&walls),
            walls,
            start,
            goal,
        })
    }

    /// The maze with the start at (0, 0) and the goal in the centre.
    ///
    /// # Errors
    ///
    /// If the start is in the goal, that is, if the grid is 2 x 2.
    ///
    /// ```
    /// use wasmouse_core::maze::{Cell, Heading, Maze, Walls};
    /// let maze = Maze::contest(Walls::open(12)).expect("a 12 x 12 maze has room for both");
    /// assert_eq!(maze.reach(Cell::new(0, 0), Heading::Up), 11);
    /// ```
    pub fn contest(walls: Walls) -> Result<Self, MazeError> {
        let goal = Area::center(walls.dimension());
        Self::new(walls, Cell::new(0, 0), goal)
    }

    /// The walls.
    pub const fn walls(&self) -> &Walls {
        &self.walls
    }

    /// Cells along each side, in [`DIMENSIONS`].
    pub const fn dimension(&self) -> u8 {
        self.walls.dimension()
    }

    /// The cell where both runs start, heading up.
    pub const fn start(&self) -> Cell {
        self.start
    }

    /// The goal cells.
    pub const fn goal(&self) -> Area {
        self.goal
    }

    /// The number of open cells between `cell` and the nearest wall in that direction; 0 if
    /// the wall is on this side of the cell.
    ///
    /// # Panics
    ///
    /// If `cell` is outside the maze.
    pub fn reach(&self, cell: Cell, heading: Heading) -> u8 {
        assert!(self.walls.contains(cell), "{cell} is outside the maze");
        self.reach_at(self.walls.index(cell))[heading as usize]
    }

    /// [`Maze::reach`] of the cell with that [index](Walls::index), by heading.
    pub(super) fn reach_at(&self, index: usize) -> &[u8; 4] {
        &self.reach[index]
    }

    /// The bytes that identify this maze, the same for equal mazes from different files: the
    /// size, x and y of the start, x, y, width and height of the goal, then the
    /// [value](Walls::value) of every cell.
    pub fn identity_bytes(&self) -> Vec<u8> {
        let goal = self.goal;
        let mut bytes = vec![
            self.dimension(),
            self.start.x,
            self.start.y,
            goal.origin().x,
            goal.origin().y,
            goal.width(),
            goal.height(),
        ];
        bytes.extend_from_slice(&self.walls.open);
        bytes
    }

    /// The identity of the maze: the SHA-256 of [`Maze::identity_bytes`].
    pub fn digest(&self) -> Digest {
        Digest::of(&self.identity_bytes())
    }

    /// The maze with these [identity bytes](Maze::identity_bytes); `None` if there is none.
    ///
    /// ```
    /// use wasmouse_core::maze::{Maze, Walls};
    /// let maze = Maze::contest(Walls::open(12)).expect("room for start and goal");
    /// assert_eq!(Maze::from_identity_bytes(&maze.identity_bytes()), Some(maze));
    /// assert_eq!(Maze::from_identity_bytes(&[12, 0]), None);
    /// ```
    pub fn from_identity_bytes(bytes: &[u8]) -> Option<Self> {
        let (&[dimension, start_x, start_y, goal_x, goal_y, width, height], values) =
            bytes.split_first_chunk()?;
        let walls = Walls::from_values(dimension, values)?;
        let goal = Area::new(Cell::new(goal_x, goal_y), width, height)?;
        Self::new(walls, Cell::new(start_x, start_y), goal).ok()
    }
}

/// The open cells to the nearest wall, for every cell in every direction. Each is one more than
/// that of the next cell in that direction, so the cells are visited in both orders.
fn reaches(walls: &Walls) -> Box<[[u8; 4]]> {
    let column = usize::from(walls.dimension);
    let mut reach = vec![[0; 4]; walls.open.len()].into_boxed_slice();
    // The perimeter is closed, so the cell behind an open side exists.
    let one_more = |value: u8, heading: Heading, next: u8| match value & heading.bit() {
        0 => 0,
        _ => next + 1,
    };
    for (at, &value) in walls.open.iter().enumerate() {
        for (heading, distance) in [(Heading::Down, 1), (Heading::Left, column)] {
            let next = at
                .checked_sub(distance)
                .map_or(0, |next| reach[next][heading as usize]);
            reach[at][heading as usize] = one_more(value, heading, next);
        }
    }
    for (at, &value) in walls.open.iter().enumerate().rev() {
        for (heading, distance) in [(Heading::Up, 1), (Heading::Right, column)] {
            let next = reach
                .get(at + distance)
                .map_or(0, |next| next[heading as usize]);
            reach[at][heading as usize] = one_more(value, heading, next);
        }
    }
    reach
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_cells_of_an_edge_agree() {
        let mut walls = Walls::open(5);
        walls.set(Cell::new(2, 2), Heading::Right, false);
        assert!(!walls.is_open(Cell::new(3, 2), Heading::Left));
        walls.set(Cell::new(3, 2), Heading::Left, true);
        assert!(walls.is_open(Cell::new(2, 2), Heading::Right));
    }

    #[test]
    #[should_panic(expected = "perimeter")]
    fn the_perimeter_stays_closed() {
        Walls::closed(4).set(Cell::new(0, 0), Heading::Left, true);
    }

    #[test]
    fn reach_is_the_number_of_open_cells() {
        let mut walls = Walls::open(6);
        walls.set(Cell::new(0, 3), Heading::Up, false);
        let maze = Maze::contest(walls).expect("legal start and goal");
        assert_eq!(maze.reach(Cell::new(0, 0), Heading::Up), 3);
        assert_eq!(maze.reach(Cell::new(0, 4), Heading::Down), 0);
        assert_eq!(maze.reach(Cell::new(0, 4), Heading::Right), 5);
    }

    /// By walking from every cell in every direction.
    #[test]
    fn reach_of_every_cell_of_the_bundled_mazes() {
        for bundled in crate::maze::bundled() {
            let maze = crate::maze::format::parse(bundled.text)
                .expect("a maze")
                .maze;
            let walls = maze.walls();
            for cell in walls.cells() {
                for heading in Heading::ALL {
                    let (mut at, mut open) = (cell, 0);
                    while walls.is_open(at, heading) {
                        at = at.step(heading).expect("the perimeter is closed");
                        open += 1;
                    }
                    assert_eq!(maze.reach(cell, heading), open, "{cell} {heading}");
                }
            }
        }
    }

    #[test]
    fn bytes_of_no_maze_are_none() {
        let maze = Maze::contest(Walls::open(4)).expect("legal start and goal");
        let bytes = maze.identity_bytes();
        assert_eq!(Maze::from_identity_bytes(&bytes), Some(maze));
        let cells = 7..bytes.len();
        // Any bit of a cell is either an edge that the neighbor disagrees about, or an open
        // perimeter, or no side at all.
        for at in cells {
            for bit in 0..8 {
                let mut changed = bytes.clone();
                changed[at] ^= 1 << bit;
                assert_eq!(Maze::from_identity_bytes(&changed), None, "{at} {bit}");
            }
        }
        assert_eq!(Maze::from_identity_bytes(&bytes[..bytes.len() - 1]), None);
    }

    #[test]
    fn a_start_in_the_goal_is_rejected() {
        let error = Maze::contest(Walls::open(2)).expect_err("2 x 2 is all goal");
        assert_eq!(error.to_string(), "start (0, 0) is in the goal");
    }
}
