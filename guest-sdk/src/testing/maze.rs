//! Mazes for native matches, in the Udacity text format.
//!
//! Deliberately small and separate from the host's implementation, so that the two can be
//! checked against each other. It does not check everything; the host does.

use crate::geometry::DIMENSION_MAX;
use crate::{Cell, Heading, Sensors};

/// Test maze 01 of the contest, 12 x 12, as printed in the reports.
///
/// Its speed-run optimum is 17 steps.
pub const MAZE_01: &str = "\
12
1,5,7,5,5,5,7,5,7,5,5,6
3,5,14,3,7,5,15,4,9,5,7,12
11,6,10,10,9,7,13,6,3,5,13,4
10,9,13,12,3,13,5,12,9,5,7,6
9,5,6,3,15,5,5,7,7,4,10,10
3,5,15,14,10,3,6,10,11,6,10,10
9,7,12,11,12,9,14,9,14,11,13,14
3,13,5,12,2,3,13,6,9,14,3,14
11,4,1,7,15,13,7,13,6,9,14,10
11,5,6,10,9,7,13,5,15,7,14,8
11,5,12,10,2,9,5,6,10,8,9,6
9,5,5,13,13,5,5,12,9,5,5,12";

/// A maze, one Udacity value per cell, column by column from the left.
pub(super) struct Maze {
    pub(super) dimension: u32,
    values: Vec<u8>,
}

impl Maze {
    /// Reads the Udacity format: the dimension, then one line per column.
    ///
    /// # Panics
    ///
    /// When the text is not a maze in that format, two neighbours disagree about
    /// their wall, or the perimeter is open.
    pub(super) fn parse(text: &str) -> Self {
        let mut lines = text.lines();
        let first = lines.next().expect("a maze text has a first line");
        let dimension: u32 = number(first);
        assert!(
            (2..=DIMENSION_MAX).contains(&dimension),
            "dimension {dimension} is outside 2..=64"
        );
        let values: Vec<u8> = lines
            .by_ref()
            .take(dimension as usize)
            .flat_map(|line| {
                let column: Vec<u8> = line.split(',').map(number).collect();
                assert_eq!(column.len(), dimension as usize, "values in line `{line}`");
                column
            })
            .collect();
        let cells = (dimension * dimension) as usize;
        assert_eq!(values.len(), cells, "a maze text has one line per column");
        assert!(
            lines.all(|line| line.trim().is_empty()),
            "text after the maze"
        );
        let maze = Self { dimension, values };
        maze.check();
        maze
    }

    fn check(&self) {
        for x in 0..self.dimension {
            for y in 0..self.dimension {
                let cell = Cell::new(x, y);
                for heading in Heading::ALL {
                    let open = self.is_open(cell, heading);
                    let beyond = self.neighbor(cell, heading);
                    let other = beyond.is_some_and(|it| self.is_open(it, heading.opposite()));
                    assert_eq!(open, other, "the wall {heading:?} of ({x}, {y})");
                }
            }
        }
    }

    pub(super) fn neighbor(&self, cell: Cell, heading: Heading) -> Option<Cell> {
        cell.toward(heading, 1).filter(|&it| self.contains(it))
    }

    pub(super) const fn contains(&self, cell: Cell) -> bool {
        cell.x < self.dimension && cell.y < self.dimension
    }

    pub(super) fn is_open(&self, cell: Cell, heading: Heading) -> bool {
        let bit = match heading {
            Heading::Up => 1,
            Heading::Right => 2,
            Heading::Down => 4,
            Heading::Left => 8,
        };
        self.values[(cell.x * self.dimension + cell.y) as usize] & bit != 0
    }

    /// The readings of a robot in `cell` that looks towards `heading`.
    pub(super) fn sense(&self, cell: Cell, heading: Heading) -> Sensors {
        use crate::Turn::{Left, Right};
        Sensors {
            left: self.open_cells(cell, heading.turned(Left)),
            front: self.open_cells(cell, heading),
            right: self.open_cells(cell, heading.turned(Right)),
        }
    }

    fn open_cells(&self, mut cell: Cell, heading: Heading) -> u32 {
        let mut count = 0;
        while self.is_open(cell, heading) {
            cell = self
                .neighbor(cell, heading)
                .expect("the perimeter is closed");
            count += 1;
        }
        count
    }
}

fn number<T: std::str::FromStr>(text: &str) -> T {
    text.trim()
        .parse()
        .unwrap_or_else(|_| panic!("expected a number, found `{text}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_reading_of_maze_01() {
        let sensors = Maze::parse(MAZE_01).sense(Cell::new(0, 0), Heading::Up);
        let expected = Sensors {
            left: 0,
            front: 11,
            right: 0,
        };
        assert_eq!(sensors, expected);
    }

    #[test]
    #[should_panic(expected = "the wall Heading::Up of (0, 0)")]
    fn neighbours_must_agree() {
        Maze::parse("2\n1,0\n0,0");
    }

    #[test]
    #[should_panic(expected = "one line per column")]
    fn a_column_is_missing() {
        Maze::parse("2\n0,0");
    }

    #[test]
    #[should_panic(expected = "outside 2..=64")]
    fn too_large() {
        Maze::parse("65\n");
    }
}
