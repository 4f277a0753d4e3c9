//! Cells and walls as plain numbers: [`Grid`].
//!
//! For planners that have arrays with one value per cell or per wall.
//! [`Map`](crate::Map) and [`Passages`](crate::Passages) store bits and take [`Cell`]s; this
//! is arithmetic only and stores nothing.

use crate::geometry::DIMENSION_MAX;
use crate::{Cell, Heading};

/// Numbers for the cells and walls of a square maze, with a margin of two cells
/// around it, so that neighbours of neighbours need no checks.
///
/// Cells and walls have numbers of their own. A wall belongs to two cells and has
/// one number; the perimeter and the margin have walls too.
///
/// ```
/// use wasmouse_sdk::{Cell, Grid, Heading};
///
/// let grid = Grid::new(12);
/// let (left, right) = (grid.cell(Cell::new(3, 4)), grid.cell(Cell::new(4, 4)));
/// assert_eq!(grid.beyond(left, Heading::Right), right);
/// assert_eq!(grid.wall(left, Heading::Right), grid.wall(right, Heading::Left));
/// assert_eq!(grid.at(right), Cell::new(4, 4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    dimension: u32,
    width: usize,
}

/// Cells of the margin on each side.
const MARGIN: usize = 2;

impl Grid {
    /// The numbers for a maze of this dimension.
    ///
    /// # Panics
    ///
    /// When `dimension` is outside 2..=64.
    pub const fn new(dimension: u32) -> Self {
        assert!(
            dimension >= 2 && dimension <= DIMENSION_MAX,
            "the dimension is outside 2..=64"
        );
        Self {
            dimension,
            width: dimension as usize + 2 * MARGIN,
        }
    }

    /// Cells along each side of the maze.
    pub const fn dimension(self) -> u32 {
        self.dimension
    }

    /// The length of an array with a value forevery cell, including the margin.
    pub const fn cell_count(self) -> usize {
        self.width * self.width
    }

    /// The length of an array with a value forevery wall, including the margin.
    pub const fn wall_count(self) -> usize {
        2 * self.cell_count()
    }

    /// The number of a cell of the maze.
    #[inline]
    pub const fn cell(self, cell: Cell) -> usize {
        (cell.y as usize + MARGIN) * self.width + cell.x as usize + MARGIN
    }

    /// The cell of the maze with that number.
    #[inline]
    pub const fn at(self, cell: usize) -> Cell {
        Cell {
            x: (cell % self.width - MARGIN) as u32,
            y: (cell / self.width - MARGIN) as u32,
        }
    }

    /// The number of the neighbouring cell on that side, ignoring walls.
    #[inline]
    pub const fn beyond(self, cell: usize, heading: Heading) -> usize {
        match heading {
            Heading::Up => cell + self.width,
            Heading::Right => cell + 1,
            Heading::Down => cell - self.width,
            Heading::Left => cell - 1,
        }
    }

    /// The number of the wall on that side of a cell.
    #[inline]
    pub const fn wall(self, cell: usize, heading: Heading) -> usize {
        match heading {
            Heading::Up => 2 * cell + 1,
            Heading::Right => 2 * cell,
            Heading::Down => 2 * (cell - self.width) + 1,
            Heading::Left => 2 * (cell - 1),
        }
    }

    /// The two cells that a wall separates: the one on its left or below it, and
    /// the one on its right or above it.
    #[inline]
    pub const fn sides(self, wall: usize) -> [usize; 2] {
        let first = wall / 2;
        if wall.is_multiple_of(2) {
            [first, first + 1]
        } else {
            [first, first + self.width]
        }
    }

    /// The numbers of all walls between two cells of the maze: row by row from the
    /// bottom, each from the left, the right wall of a cell before the upper one.
    pub fn inner_walls(self) -> impl Iterator<Item = usize> {
        let last = self.dimension - 1;
        (0..=last).flat_map(move |y| {
            (0..=last).flat_map(move |x| {
                let cell = self.cell(Cell::new(x, y));
                let right = (x < last).then_some(2 * cell);
                let up = (y < last).then_some(2 * cell + 1);
                right.into_iter().chain(up)
            })
        })
    }

    /// The eight neighbours of a wall: those that meet it at a post, and those opposite to
    /// it in its two cells.
    ///
    /// For the wall on the right of a cell: its continuations above and below; the
    /// walls above the cell and above its neighbour; those below both; the walls on
    /// the far sides of both. For the wall above a cell the same, with x and y
    /// exchanged.
    pub const fn neighborhood(self, wall: usize) -> [usize; 8] {
        // One cell further along the wall, and one across it.
        let (along, across) = if wall.is_multiple_of(2) {
            (self.width, 1)
        } else {
            (1, self.width)
        };
        // The wall at right angles, of the same cell.
        let crossing = wall ^ 1;
        [
            wall + 2 * along,
            wall - 2 * along,
            crossing,
            crossing + 2 * across,
            crossing - 2 * along,
            crossing - 2 * along + 2 * across,
            wall - 2 * across,
            wall + 2 * across,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Area;

    #[test]
    fn walls_and_cells_agree() {
        for dimension in [2, 3, 16, 64] {
            let grid = Grid::new(dimension);
            let area = Area::new(Cell::new(0, 0), dimension, dimension);
            for cell in area.cells() {
                let number = grid.cell(cell);
                assert_eq!(grid.at(number), cell);
                for heading in Heading::ALL {
                    let beyond = grid.beyond(number, heading);
                    let wall = grid.wall(number, heading);
                    assert_eq!(wall, grid.wall(beyond, heading.opposite()));
                    assert!(grid.sides(wall).contains(&number));
                    assert!(grid.sides(wall).contains(&beyond));
                    assert!(wall < grid.wall_count() && beyond < grid.cell_count());
                }
            }
            let inner = grid.inner_walls().count() as u32;
            assert_eq!(inner, 2 * dimension * (dimension - 1));
        }
    }

    /// Neighbourhood is mutual, and the eight are different walls of the grid.
    #[test]
    fn neighborhoods_are_mutual() {
        for dimension in [2, 12, 64] {
            let grid = Grid::new(dimension);
            for wall in grid.inner_walls() {
                let mut others = grid.neighborhood(wall);
                others.sort_unstable();
                assert!(others.is_sorted_by(|a, b| a < b));
                assert!(others[7] < grid.wall_count() && !others.contains(&wall));
                for other in others {
                    assert!(grid.neighborhood(other).contains(&wall));
                }
            }
        }
    }
}
