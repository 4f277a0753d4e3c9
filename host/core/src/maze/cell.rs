//! Positions and directions: [`Cell`], [`Heading`], [`Turn`] and [`Area`].
//!
//! They do not refer to a particular maze; [`Walls`](super::Walls) knows whether a cell is in
//! the maze.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A cell, counted from the bottom left corner of the maze.
///
/// `x` grows to the right and `y` upward, so (0, 0) is the bottom left. Range of each in a
/// maze: 0 to its size - 1. Cells are ordered by column, then by row, as in the Udacity
/// format. Serialises as `{"x": 3, "y": 5}`.
///
/// ```
/// use wasmouse_core::maze::{Cell, Heading};
/// assert_eq!(Cell::new(0, 0).step(Heading::Up), Some(Cell::new(0, 1)));
/// assert_eq!(Cell::new(0, 0).step(Heading::Left), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// Column, counted from the left, in cells.
    pub x: u8,
    /// Row, counted from the bottom, in cells.
    pub y: u8,
}

impl Cell {
    /// The cell in column `x` and row `y`.
    pub const fn new(x: u8, y: u8) -> Self {
        Self { x, y }
    }

    /// The neighbouring cell in that direction; `None` outside 0 to 255.
    ///
    /// [`Walls::neighbor`](super::Walls::neighbor) knows the upper bounds of a maze.
    pub fn step(self, heading: Heading) -> Option<Self> {
        let (x, y) = (self.x, self.y);
        Some(match heading {
            Heading::Up => Self::new(x, y.checked_add(1)?),
            Heading::Right => Self::new(x.checked_add(1)?, y),
            Heading::Down => Self::new(x, y.checked_sub(1)?),
            Heading::Left => Self::new(x.checked_sub(1)?, y),
        })
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", self.x, self.y)
    }
}

/// A direction in the maze, independent of any robot.
///
/// The numbers are the positions of the bits in the Udacity format, clockwise from up.
/// Serialises as its [name](Heading::name).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u8)]
pub enum Heading {
    /// Towards larger `y`; every run starts with this heading.
    Up = 0,
    /// Towards larger `x`.
    Right = 1,
    /// Towards smaller `y`.
    Down = 2,
    /// Towards smaller `x`.
    Left = 3,
}

impl Heading {
    /// All four, clockwise from [`Heading::Up`].
    pub const ALL: [Self; 4] = [Self::Up, Self::Right, Self::Down, Self::Left];

    /// The heading after a turn on the spot.
    ///
    /// ```
    /// use wasmouse_core::maze::{Heading, Turn};
    /// assert_eq!(Heading::Up.turned(Turn::Left), Heading::Left);
    /// ```
    pub const fn turned(self, turn: Turn) -> Self {
        let quarters = match turn {
            Turn::Left => 3,
            Turn::Straight => 0,
            Turn::Right => 1,
        };
        Self::ALL[(self as usize + quarters) % 4]
    }

    /// The heading after a half turn.
    pub const fn opposite(self) -> Self {
        Self::ALL[(self as usize + 2) % 4]
    }

    /// The bit of this side in a Udacity cell value: 1 up, 2 right, 4 down, 8 left.
    pub const fn bit(self) -> u8 {
        1 << self as u8
    }

    /// `up`, `right`, `down` or `left`, as in WIT, JSON and messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Right => "right",
            Self::Down => "down",
            Self::Left => "left",
        }
    }
}

impl fmt::Display for Heading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A rotation on the spot, relative to the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Turn {
    /// A quarter turn counterclockwise (-90 degrees).
    Left,
    /// No rotation.
    Straight,
    /// A quarter turn clockwise (+90 degrees).
    Right,
}

/// A rectangle of cells, used for goals.
///
/// Never empty: [`Area::new`] rejects sides of 0 cells.
///
/// ```
/// use wasmouse_core::maze::{Area, Cell};
/// let room = Area::center(16);
/// assert_eq!(room.origin(), Cell::new(7, 7));
/// assert!(room.contains(Cell::new(8, 8)) && !room.contains(Cell::new(9, 8)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Area {
    origin: Cell,
    width: u8,
    height: u8,
}

impl Area {
    /// The rectangle of `width` x `height` cells whose bottom left cell is `origin`; `None` if
    /// a side is 0 or a coordinate would exceed 255.
    pub fn new(origin: Cell, width: u8, height: u8) -> Option<Self> {
        let last_x = origin.x.checked_add(width.checked_sub(1)?);
        let last_y = origin.y.checked_add(height.checked_sub(1)?);
        (last_x.is_some() && last_y.is_some()).then_some(Self {
            origin,
            width,
            height,
        })
    }

    /// The smallest rectangle around all of `cells`; `None` for no cells.
    pub fn bounding(cells: &[Cell]) -> Option<Self> {
        let (xs, ys) = (
            cells.iter().map(|cell| cell.x),
            cells.iter().map(|cell| cell.y),
        );
        let low = Cell::new(xs.clone().min()?, ys.clone().min()?);
        let width = (xs.max()? - low.x).checked_add(1)?;
        let height = (ys.max()? - low.y).checked_add(1)?;
        Self::new(low, width, height)
    }

    /// The goal of a contest maze: the 2 x 2 room in the centre, or the single centre cell if
    /// the size is odd.
    ///
    /// `dimension` is the size of the maze, at least 2 cells.
    pub const fn center(dimension: u8) -> Self {
        let low = (dimension - 1) / 2;
        let side = if dimension.is_multiple_of(2) { 2 } else { 1 };
        Self {
            origin: Cell::new(low, low),
            width: side,
            height: side,
        }
    }

    /// The bottom left cell.
    pub const fn origin(self) -> Cell {
        self.origin
    }

    /// Columns, at least 1.
    pub const fn width(self) -> u8 {
        self.width
    }

    /// Rows, at least 1.
    pub const fn height(self) -> u8 {
        self.height
    }

    /// Whether `cell` is in the rectangle.
    pub const fn contains(self, cell: Cell) -> bool {
        cell.x >= self.origin.x
            && cell.y >= self.origin.y
            && cell.x - self.origin.x < self.width
            && cell.y - self.origin.y < self.height
    }

    /// The cells, column by column, each from the bottom up.
    pub fn cells(self) -> impl Iterator<Item = Cell> {
        (0..self.width).flat_map(move |dx| {
            (0..self.height).map(move |dy| Cell::new(self.origin.x + dx, self.origin.y + dy))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_and_opposites_undo_each_other() {
        for heading in Heading::ALL {
            let turned = (0..4).fold(heading, |h, _| h.turned(Turn::Left));
            assert_eq!(turned, heading);
            assert_eq!(heading.turned(Turn::Right).turned(Turn::Left), heading);
            assert_eq!(heading.opposite().opposite(), heading);
        }
    }

    #[test]
    fn an_area_contains_its_cells() {
        let area = Area::new(Cell::new(3, 5), 3, 2).expect("sides are not 0");
        let cells: Vec<_> = area.cells().collect();
        assert_eq!(cells.len(), 6);
        assert!(cells.iter().all(|&cell| area.contains(cell)));
        assert_eq!(Area::bounding(&cells), Some(area));
        assert_eq!(Area::new(Cell::new(250, 0), 7, 1), None);
        assert_eq!(Area::new(Cell::new(0, 0), 0, 1), None);
    }
}
