//! A robot's position: [`Pose`].
//!
//! Dead reckoning only: it knows no walls except from the readings that it is given.

use crate::{Cell, Heading, Hop, Sensors, Turn};

/// A cell and a heading.
///
/// ```
/// use wasmouse_sdk::{Cell, Heading, Pose, Sensors, Turn};
///
/// let pose = Pose::at_start(Cell::new(0, 0));
/// let sensors = Sensors { left: 0, front: 2, right: 5 };
/// // There is a wall after two cells, so the robot does not reach the third.
/// let pose = pose.after(Turn::Straight, 3, sensors).expect("a forward move");
/// assert_eq!(pose.cell, Cell::new(0, 2));
/// assert_eq!(pose.heading, Heading::Up);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pose {
    /// The robot's cell.
    pub cell: Cell,
    /// The robot's heading.
    pub heading: Heading,
}

impl Pose {
    /// The pose in which both runs begin: in the start cell, heading up.
    pub const fn at_start(start: Cell) -> Self {
        Self {
            cell: start,
            heading: Heading::Up,
        }
    }

    /// The pose after a turn and a move of `advance` cells, given the readings before it. A
    /// forward move ends at the first wall, which the sensors have seen.
    ///
    /// `None` for a backward move: there is no rear sensor, so only a map can tell how far
    /// it goes. See [`Pose::moved`].
    pub fn after(self, turn: Turn, advance: i8, sensors: Sensors) -> Option<Self> {
        let wish = u32::try_from(advance).ok()?;
        let open = match turn {
            Turn::Left => sensors.left,
            Turn::Straight => sensors.front,
            Turn::Right => sensors.right,
        };
        let heading = self.heading.turned(turn);
        self.moved(turn, heading, wish.min(open))
    }

    /// The pose after a hop. The robot turns to the hop's heading, unless that is behind it;
    /// then it drives backwards. `None` below row or column 0.
    pub fn hopped(self, hop: Hop) -> Option<Self> {
        let turn = self.heading.turn_to(hop.heading).unwrap_or(Turn::Straight);
        self.moved(turn, hop.heading, hop.cells)
    }

    /// The pose after a turn and then `cells` cells in direction `travel`, which is the new
    /// heading or, for a backward move, its opposite. `None` below row or column 0.
    pub fn moved(self, turn: Turn, travel: Heading, cells: u32) -> Option<Self> {
        Some(Self {
            cell: self.cell.toward(travel, cells)?,
            heading: self.heading.turned(turn),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_comes_before_the_drive() {
        let sensors = Sensors {
            left: 0,
            front: 0,
            right: 4,
        };
        let pose = Pose::at_start(Cell::new(3, 3)).after(Turn::Right, 2, sensors);
        let expected = Pose {
            cell: Cell::new(5, 3),
            heading: Heading::Right,
        };
        assert_eq!(pose, Some(expected));
    }

    #[test]
    fn a_backward_move_needs_the_map() {
        let sensors = Sensors {
            left: 9,
            front: 9,
            right: 9,
        };
        let pose = Pose::at_start(Cell::new(3, 3));
        assert_eq!(pose.after(Turn::Straight, -1, sensors), None);
        let back = pose.moved(Turn::Straight, Heading::Down, 1);
        assert_eq!(back, Some(Pose::at_start(Cell::new(3, 2))));
    }
}
