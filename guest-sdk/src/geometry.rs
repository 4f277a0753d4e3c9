//! Methods of the types in `wit/robot.wit`: [`Cell`], [`Heading`], [`Turn`], [`Area`],
//! [`Action`] and [`Briefing`].
//!
//! Arithmetic only; [`Map`](crate::Map) knows the walls.

use crate::{Action, Area, Briefing, BudgetScope, Cell, Heading, Move, Turn};

/// The largest maze a robot can meet, in cells along each side.
pub const DIMENSION_MAX: u32 = 64;

impl Cell {
    /// The cell in column `x` and row `y`, counted from the bottom left.
    pub const fn new(x: u32, y: u32) -> Self {
        Self { x, y }
    }

    /// The cell `distance` cells away in that direction, ignoring walls; `None` below row or
    /// column 0. Does not check the size of the maze.
    ///
    /// ```
    /// use wasmouse_sdk::{Cell, Heading};
    /// assert_eq!(Cell::new(2, 5).toward(Heading::Right, 3), Some(Cell::new(5, 5)));
    /// assert_eq!(Cell::new(2, 5).toward(Heading::Left, 3), None);
    /// ```
    pub const fn toward(self, heading: Heading, distance: u32) -> Option<Self> {
        let (x, y) = match heading {
            Heading::Up => (Some(self.x), self.y.checked_add(distance)),
            Heading::Right => (self.x.checked_add(distance), Some(self.y)),
            Heading::Down => (Some(self.x), self.y.checked_sub(distance)),
            Heading::Left => (self.x.checked_sub(distance), Some(self.y)),
        };
        match (x, y) {
            (Some(x), Some(y)) => Some(Self { x, y }),
            _ => None,
        }
    }

    /// The Manhattan distance between two cells.
    pub const fn manhattan(self, other: Self) -> u32 {
        self.x.abs_diff(other.x) + self.y.abs_diff(other.y)
    }
}

impl Heading {
    /// All four, clockwise from [`Heading::Up`].
    pub const ALL: [Self; 4] = [Self::Up, Self::Right, Self::Down, Self::Left];

    /// The heading after a turn on the spot.
    ///
    /// ```
    /// use wasmouse_sdk::{Heading, Turn};
    /// assert_eq!(Heading::Up.turned(Turn::Left), Heading::Left);
    /// ```
    pub const fn turned(self, turn: Turn) -> Self {
        let quarters = match turn {
            Turn::Left => 3,
            Turn::Straight => 0,
            Turn::Right => 1,
        };
        Self::ALL[(self as usize + quarters) & 3]
    }

    /// The opposite heading.
    pub const fn opposite(self) -> Self {
        Self::ALL[(self as usize + 2) & 3]
    }

    /// The turn from this heading to `target`; `None` if that is behind the robot, because
    /// one step cannot turn that far.
    ///
    /// ```
    /// use wasmouse_sdk::{Heading, Turn};
    /// assert_eq!(Heading::Up.turn_to(Heading::Right), Some(Turn::Right));
    /// assert_eq!(Heading::Up.turn_to(Heading::Down), None);
    /// ```
    pub const fn turn_to(self, target: Self) -> Option<Turn> {
        match (target as usize + 4 - self as usize) & 3 {
            0 => Some(Turn::Straight),
            1 => Some(Turn::Right),
            3 => Some(Turn::Left),
            _ => None,
        }
    }
}

impl Area {
    /// The rectangle of `width` x `height` cells with this bottom left cell.
    pub const fn new(origin: Cell, width: u32, height: u32) -> Self {
        Self {
            origin,
            width,
            height,
        }
    }

    /// The goal room of a contest maze: the 2 x 2 cells in the centre, or the single centre
    /// cell if `dimension` is odd.
    pub const fn center(dimension: u32) -> Self {
        let low = dimension.saturating_sub(1) / 2;
        let side = if dimension.is_multiple_of(2) { 2 } else { 1 };
        Self::new(Cell::new(low, low), side, side)
    }

    /// Whether `cell` lies in the rectangle.
    ///
    /// ```
    /// use wasmouse_sdk::{Area, Cell};
    /// assert!(Area::center(12).contains(Cell::new(6, 5)));
    /// assert!(!Area::center(12).contains(Cell::new(7, 5)));
    /// ```
    pub const fn contains(self, cell: Cell) -> bool {
        // Differences instead of sums, so that no rectangle overflows.
        cell.x >= self.origin.x
            && cell.y >= self.origin.y
            && cell.x - self.origin.x < self.width
            && cell.y - self.origin.y < self.height
    }

    /// All cells, column by column from the left, each from the bottom up.
    pub fn cells(self) -> impl Iterator<Item = Cell> + use<> {
        let Cell { x, y } = self.origin;
        (0..self.width)
            .flat_map(move |dx| (0..self.height).map(move |dy| Cell::new(x + dx, y + dy)))
    }
}

impl Action {
    /// Turns, then drives `advance` cells along the new heading; backwards when
    /// `advance` is negative.
    pub const fn drive(turn: Turn, advance: i8) -> Self {
        Self::Move(Move { turn, advance })
    }
}

impl Briefing {
    /// The briefing of the ruleset `udacity` for a contest maze of this size: start (0, 0),
    /// goal in the centre, 1000 steps for both runs together, moves of up to 3 cells,
    /// exploration steps divided by 30, seed 0, variant 0.
    ///
    /// For tests; in a match the host provides the briefing.
    pub const fn contest(dimension: u32) -> Self {
        Self {
            dimension,
            start: Cell::new(0, 0),
            goal: Area::center(dimension),
            budget: 1000,
            budget_scope: BudgetScope::BothRuns,
            longest_move: 3,
            units_per_cell: 1,
            exploration_divisor: 30,
            seed: 0,
            variant: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_and_headings_agree() {
        for from in Heading::ALL {
            for turn in [Turn::Left, Turn::Straight, Turn::Right] {
                assert_eq!(from.turn_to(from.turned(turn)), Some(turn));
            }
            assert_eq!(from.turn_to(from.opposite()), None);
            assert_eq!(from.opposite().opposite(), from);
        }
    }

    #[test]
    fn moving_there_and_back_changes_nothing() {
        let cell = Cell::new(7, 9);
        for heading in Heading::ALL {
            let there = cell.toward(heading, 4).expect("far from the edges");
            assert_eq!(there.toward(heading.opposite(), 4), Some(cell));
            assert_eq!(there.manhattan(cell), 4);
        }
    }

    #[test]
    fn an_area_contains_exactly_its_cells() {
        let area = Area::new(Cell::new(1, 2), 3, 2);
        let listed: Vec<Cell> = area.cells().collect();
        let contained: Vec<Cell> = Area::new(Cell::new(0, 0), 6, 6)
            .cells()
            .filter(|&cell| area.contains(cell))
            .collect();
        assert_eq!(listed, contained);
        assert_eq!(listed.len(), 6);
    }

    #[test]
    fn an_area_at_the_end_of_the_numbers_does_not_overflow() {
        let area = Area::new(Cell::new(u32::MAX, 0), 2, 1);
        assert!(area.contains(Cell::new(u32::MAX, 0)));
        assert!(!area.contains(Cell::new(0, 0)));
    }
}
