//! Sets of cells ([`CellSet`]) and of open walls ([`Passages`]), one bit each.
//!
//! A row of the maze is one 64-bit word, so a search processes a whole row of cells with a
//! few instructions. Both are plain values: to search around some cells, clone a map's
//! passages and close some of them.

use crate::geometry::DIMENSION_MAX;
use crate::{Area, Cell, Heading};

pub(crate) const ROWS: usize = DIMENSION_MAX as usize;

/// The row's place in an array of [`ROWS`]. The mask proves to the compiler that
/// no check of bounds is needed.
#[inline]
pub(crate) const fn row(y: u32) -> usize {
    (y & (DIMENSION_MAX - 1)) as usize
}

#[inline]
pub(crate) const fn bit(x: u32) -> u64 {
    1 << (x & (DIMENSION_MAX - 1))
}

/// A set of cells of a maze of up to 64 x 64.
///
/// ```
/// use wasmouse_sdk::{Area, Cell, CellSet};
/// let goal = CellSet::from(Area::center(12));
/// assert!(goal.contains(Cell::new(5, 6)));
/// assert_eq!(goal.iter().count(), 4);
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CellSet {
    pub(crate) rows: [u64; ROWS],
}

impl CellSet {
    /// No cells.
    pub const fn new() -> Self {
        Self { rows: [0; ROWS] }
    }

    /// Adds a cell.
    ///
    /// # Panics
    ///
    /// When a coordinate is above 63.
    pub fn insert(&mut self, cell: Cell) {
        assert_inside(cell);
        self.rows[row(cell.y)] |= bit(cell.x);
    }

    /// Whether the cell is in the set.
    pub const fn contains(&self, cell: Cell) -> bool {
        cell.x < DIMENSION_MAX
            && cell.y < DIMENSION_MAX
            && self.rows[row(cell.y)] & bit(cell.x) != 0
    }

    /// Whether the set is empty.
    pub fn is_empty(&self) -> bool {
        self.rows.iter().all(|&row| row == 0)
    }

    /// Removes all cells.
    pub const fn clear(&mut self) {
        self.rows = [0; ROWS];
    }

    /// The cells, row by row from the bottom, each from the left.
    pub fn iter(&self) -> impl Iterator<Item = Cell> {
        (0..DIMENSION_MAX).flat_map(|y| Bits(self.rows[row(y)]).map(move |x| Cell::new(x, y)))
    }
}

impl Default for CellSet {
    fn default() -> Self {
        Self::new()
    }
}

impl From<Cell> for CellSet {
    fn from(cell: Cell) -> Self {
        Self::from_iter([cell])
    }
}

impl From<Area> for CellSet {
    fn from(area: Area) -> Self {
        Self::from_iter(area.cells())
    }
}

impl FromIterator<Cell> for CellSet {
    fn from_iter<I: IntoIterator<Item = Cell>>(cells: I) -> Self {
        let mut set = Self::new();
        cells.into_iter().for_each(|cell| set.insert(cell));
        set
    }
}

/// The positions of the bits that are set, from the lowest.
pub(crate) struct Bits(pub(crate) u64);

impl Iterator for Bits {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        if self.0 == 0 {
            return None;
        }
        let position = self.0.trailing_zeros();
        self.0 &= self.0 - 1;
        Some(position)
    }
}

/// Which walls of a square maze may be driven through. The perimeter never may.
///
/// [`Map::passages`](crate::Map::passages) gives those of a map, for searches.
///
/// ```
/// use wasmouse_sdk::{Cell, Heading, Map, View};
/// let map = Map::new(4);
/// let mut passages = map.passages(View::Optimistic).clone();
/// passages.close(Cell::new(0, 0), Heading::Up);
/// assert!(!passages.is_open(Cell::new(0, 1), Heading::Down));
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Passages {
    pub(crate) dimension: u32,
    /// By row: the wall to the right of the cell in column x is bit x.
    pub(crate) right: [u64; ROWS],
    /// By row: the wall above the cell in column x is bit x.
    pub(crate) up: [u64; ROWS],
}

impl Passages {
    /// Every wall stands.
    ///
    /// # Panics
    ///
    /// When `dimension` is outside 2..=64.
    pub const fn all_closed(dimension: u32) -> Self {
        assert!(
            dimension >= 2 && dimension <= DIMENSION_MAX,
            "the dimension is outside 2..=64"
        );
        Self {
            dimension,
            right: [0; ROWS],
            up: [0; ROWS],
        }
    }

    /// Only the perimeter stands.
    ///
    /// # Panics
    ///
    /// When `dimension` is outside 2..=64.
    pub fn all_open(dimension: u32) -> Self {
        let mut passages = Self::all_closed(dimension);
        let all = u64::MAX >> (DIMENSION_MAX - dimension);
        for y in 0..dimension {
            passages.right[row(y)] = all >> 1;
            passages.up[row(y)] = if y + 1 < dimension { all } else { 0 };
        }
        passages
    }

    /// Cells along each side.
    pub const fn dimension(&self) -> u32 {
        self.dimension
    }

    /// Whether the wall on that side of `cell` may be driven through; `false`
    /// outside the maze.
    #[inline]
    pub const fn is_open(&self, cell: Cell, heading: Heading) -> bool {
        match Place::of(self.dimension, cell, heading) {
            Some(Place::Right(y, bit)) => self.right[row(y)] & bit != 0,
            Some(Place::Up(y, bit)) => self.up[row(y)] & bit != 0,
            None => false,
        }
    }

    /// Closes the wall on that side of `cell`, for both its cells.
    pub const fn close(&mut self, cell: Cell, heading: Heading) {
        match Place::of(self.dimension, cell, heading) {
            Some(Place::Right(y, bit)) => self.right[row(y)] &= !bit,
            Some(Place::Up(y, bit)) => self.up[row(y)] &= !bit,
            None => {}
        }
    }

    /// Opens the wall on that side of `cell`, for both its cells; walls of the
    /// perimeter stay closed.
    pub const fn open(&mut self, cell: Cell, heading: Heading) {
        match Place::of(self.dimension, cell, heading) {
            Some(Place::Right(y, bit)) => self.right[row(y)] |= bit,
            Some(Place::Up(y, bit)) => self.up[row(y)] |= bit,
            None => {}
        }
    }

    /// Closes all four sides of `cell`, so that no search passes it.
    pub fn wall_in(&mut self, cell: Cell) {
        for heading in Heading::ALL {
            self.close(cell, heading);
        }
    }

    /// How many cells in a row can be driven from `cell` in that direction, at
    /// most `longest`.
    pub fn clear_cells(&self, cell: Cell, heading: Heading, longest: u32) -> u32 {
        let mut count = 0;
        let mut at = Some(cell);
        while count < longest {
            match at {
                Some(cell) if self.is_open(cell, heading) => at = cell.toward(heading, 1),
                _ => break,
            }
            count += 1;
        }
        count
    }
}

/// Where the bit of a wall is kept; `None` for the perimeter and beyond.
pub(crate) enum Place {
    Right(u32, u64),
    Up(u32, u64),
}

impl Place {
    #[inline]
    pub(crate) const fn of(dimension: u32, cell: Cell, heading: Heading) -> Option<Self> {
        let Cell { x, y } = cell;
        if x >= dimension || y >= dimension {
            return None;
        }
        match heading {
            Heading::Up if y + 1 < dimension => Some(Self::Up(y, bit(x))),
            Heading::Right if x + 1 < dimension => Some(Self::Right(y, bit(x))),
            Heading::Down if y > 0 => Some(Self::Up(y - 1, bit(x))),
            Heading::Left if x > 0 => Some(Self::Right(y, bit(x - 1))),
            _ => None,
        }
    }
}

fn assert_inside(cell: Cell) {
    assert!(
        cell.x < DIMENSION_MAX && cell.y < DIMENSION_MAX,
        "the cell is outside 64 x 64"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_perimeter_of_every_dimension_is_closed() {
        for dimension in 2..=DIMENSION_MAX {
            let mut passages = Passages::all_open(dimension);
            for cell in Area::new(Cell::new(0, 0), dimension, dimension).cells() {
                for heading in Heading::ALL {
                    let beyond = cell.toward(heading, 1);
                    let inner = beyond.is_some_and(|it| it.x < dimension && it.y < dimension);
                    assert_eq!(passages.is_open(cell, heading), inner);
                    passages.open(cell, heading);
                    assert_eq!(passages.is_open(cell, heading), inner);
                }
            }
        }
    }

    #[test]
    fn a_wall_belongs_to_both_cells() {
        let mut passages = Passages::all_open(64);
        passages.wall_in(Cell::new(62, 62));
        assert!(!passages.is_open(Cell::new(63, 62), Heading::Left));
        assert!(!passages.is_open(Cell::new(62, 61), Heading::Up));
        passages.open(Cell::new(61, 62), Heading::Right);
        assert!(passages.is_open(Cell::new(62, 62), Heading::Left));
    }

    #[test]
    fn clear_cells_end_at_a_wall() {
        let mut passages = Passages::all_open(8);
        passages.close(Cell::new(5, 0), Heading::Right);
        let cell = Cell::new(1, 0);
        assert_eq!(passages.clear_cells(cell, Heading::Right, 64), 4);
        assert_eq!(passages.clear_cells(cell, Heading::Right, 3), 3);
        assert_eq!(passages.clear_cells(cell, Heading::Left, 3), 1);
        assert_eq!(passages.clear_cells(cell, Heading::Up, 64), 7);
        assert_eq!(passages.clear_cells(cell, Heading::Down, 64), 0);
    }

    #[test]
    fn a_set_returns_what_was_put_in() {
        let cells = [Cell::new(63, 0), Cell::new(0, 1), Cell::new(63, 63)];
        let mut set: CellSet = cells.into_iter().collect();
        assert!(set.iter().eq(cells));
        assert!(!set.contains(Cell::new(64, 0)) && !set.contains(Cell::new(1, 1)));
        set.clear();
        assert!(set.is_empty());
    }

    #[test]
    #[should_panic(expected = "outside 2..=64")]
    fn too_large() {
        Passages::all_open(65);
    }
}
