//! What a robot knows about the walls: [`Map`].
//!
//! It keeps two sets of passages, the walls known to be open and the walls not known to be
//! closed, so that a search under either assumption needs no conversion.

use crate::passages::{Place, row};
use crate::{Cell, Heading, Passages, Pose, Sensors};

/// What is known about one wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wall {
    /// Not known.
    Unknown,
    /// There is no wall.
    Open,
    /// There is a wall.
    Closed,
}

/// How to treat unknown walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum View {
    /// Unknown walls count as open: for exploring.
    Optimistic,
    /// Unknown walls count as closed: for driving only where it is certain.
    Pessimistic,
}

/// What was new in a reading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct News {
    /// Walls that were not known to be open before.
    pub opened: u32,
    /// Walls that were not known to be closed before.
    pub closed: u32,
}

/// The walls of a square maze, each unknown, open or closed.
///
/// At first the perimeter is closed and everything else is unknown.
///
/// ```
/// use wasmouse_sdk::{Cell, Heading, Map, Pose, Sensors, Wall};
///
/// let mut map = Map::new(12);
/// let pose = Pose::at_start(Cell::new(0, 0));
/// let news = map.observe(pose, Sensors { left: 0, front: 2, right: 0 });
/// assert_eq!((news.opened, news.closed), (2, 2));
/// assert_eq!(map.wall(Cell::new(0, 2), Heading::Down), Wall::Open);
/// assert_eq!(map.wall(Cell::new(0, 2), Heading::Up), Wall::Closed);
/// assert_eq!(map.wall(Cell::new(0, 2), Heading::Right), Wall::Unknown);
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Map {
    /// The walls known to be open.
    known: Passages,
    /// The walls not known to be closed; a superset of `known`.
    possible: Passages,
}

impl Map {
    /// A map that knows the perimeter and nothing else.
    ///
    /// # Panics
    ///
    /// When `dimension` is outside 2..=64.
    pub fn new(dimension: u32) -> Self {
        Self {
            known: Passages::all_closed(dimension),
            possible: Passages::all_open(dimension),
        }
    }

    /// Cells along each side.
    pub const fn dimension(&self) -> u32 {
        self.known.dimension
    }

    /// Whether the maze has that cell.
    pub const fn contains(&self, cell: Cell) -> bool {
        cell.x < self.dimension() && cell.y < self.dimension()
    }

    /// The neighbouring cell on that side, ignoring walls; `None` outside the maze.
    pub fn neighbor(&self, cell: Cell, heading: Heading) -> Option<Cell> {
        cell.toward(heading, 1).filter(|&it| self.contains(it))
    }

    /// What is known about the wall on that side of `cell`. The perimeter and
    /// everything beyond it is closed.
    pub fn wall(&self, cell: Cell, heading: Heading) -> Wall {
        if !self.possible.is_open(cell, heading) {
            Wall::Closed
        } else if self.known.is_open(cell, heading) {
            Wall::Open
        } else {
            Wall::Unknown
        }
    }

    /// Overrides what is known about a wall; the perimeter stays closed.
    pub fn set(&mut self, cell: Cell, heading: Heading, wall: Wall) {
        match wall {
            Wall::Unknown => {
                self.known.close(cell, heading);
                self.possible.open(cell, heading);
            }
            Wall::Open => {
                self.known.open(cell, heading);
                self.possible.open(cell, heading);
            }
            Wall::Closed => {
                self.known.close(cell, heading);
                self.possible.close(cell, heading);
            }
        }
    }

    /// The walls that may be driven through in that view.
    #[inline]
    pub const fn passages(&self, view: View) -> &Passages {
        match view {
            View::Optimistic => &self.possible,
            View::Pessimistic => &self.known,
        }
    }

    /// What a sensor in `cell` would read in that direction, in open cells; `None` if the
    /// map does not know.
    ///
    /// ```
    /// use wasmouse_sdk::{Cell, Heading, Map, Pose, Sensors};
    /// let mut map = Map::new(12);
    /// map.observe(Pose::at_start(Cell::new(0, 0)), Sensors { left: 0, front: 5, right: 0 });
    /// assert_eq!(map.sight(Cell::new(0, 2), Heading::Up), Some(3));
    /// assert_eq!(map.sight(Cell::new(0, 2), Heading::Right), None);
    /// ```
    pub fn sight(&self, cell: Cell, heading: Heading) -> Option<u32> {
        let open = self.known.clear_cells(cell, heading, self.dimension());
        let end = cell.toward(heading, open)?;
        (self.wall(end, heading) == Wall::Closed).then_some(open)
    }

    /// Adds a reading made at `pose`: in each of the three directions that many open walls
    /// and then a closed one. It overrides earlier readings; a reading that ends outside the
    /// maze ends at its perimeter.
    ///
    /// # Panics
    ///
    /// When the pose is outside the maze.
    pub fn observe(&mut self, pose: Pose, sensors: Sensors) -> News {
        use crate::Turn::{Left, Right};
        assert!(self.contains(pose.cell), "the pose is outside the maze");
        let mut news = News::default();
        let heading = pose.heading;
        self.look(pose.cell, heading.turned(Left), sensors.left, &mut news);
        self.look(pose.cell, heading, sensors.front, &mut news);
        self.look(pose.cell, heading.turned(Right), sensors.right, &mut news);
        news
    }

    fn look(&mut self, from: Cell, heading: Heading, reading: u32, news: &mut News) {
        let Cell { x, y } = from;
        let last = self.dimension() - 1;
        match heading {
            Heading::Up => {
                let end = y + reading.min(last - y);
                for y in y..end {
                    self.learn_open(Place::Up(y, 1 << x), news);
                }
                self.learn_closed(Cell::new(x, end), heading, news);
            }
            Heading::Down => {
                let end = y - reading.min(y);
                for y in end..y {
                    self.learn_open(Place::Up(y, 1 << x), news);
                }
                self.learn_closed(Cell::new(x, end), heading, news);
            }
            Heading::Right => {
                let end = x + reading.min(last - x);
                self.learn_open(Place::Right(y, span(x, end)), news);
                self.learn_closed(Cell::new(end, y), heading, news);
            }
            Heading::Left => {
                let end = x - reading.min(x);
                self.learn_open(Place::Right(y, span(end, x)), news);
                self.learn_closed(Cell::new(end, y), heading, news);
            }
        }
    }

    #[inline]
    fn learn_open(&mut self, place: Place, news: &mut News) {
        let (known, possible, bits) = match place {
            Place::Right(y, bits) => (
                &mut self.known.right[row(y)],
                &mut self.possible.right[row(y)],
                bits,
            ),
            Place::Up(y, bits) => (
                &mut self.known.up[row(y)],
                &mut self.possible.up[row(y)],
                bits,
            ),
        };
        news.opened += (bits & !*known).count_ones();
        *known |= bits;
        *possible |= bits;
    }

    #[inline]
    fn learn_closed(&mut self, cell: Cell, heading: Heading, news: &mut News) {
        if self.possible.is_open(cell, heading) {
            news.closed += 1;
            self.possible.close(cell, heading);
            self.known.close(cell, heading);
        }
    }
}

/// The bits `from..to`; `to` is at most 63.
const fn span(from: u32, to: u32) -> u64 {
    ((1 << to) - 1) & !((1 << from) - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(x: u32, y: u32, heading: Heading) -> Pose {
        Pose {
            cell: Cell::new(x, y),
            heading,
        }
    }

    /// In every pose of every dimension, an observed reading is what `sight`
    /// returns afterwards, and what lies behind stays unknown.
    #[test]
    fn a_reading_is_remembered_in_every_pose() {
        for dimension in [2, 3, 5, 16, 63, 64] {
            for (x, y) in [(0, 0), (1, 0), (dimension - 1, dimension - 1), (0, 1)] {
                for heading in Heading::ALL {
                    check_reading(dimension, pose(x, y, heading));
                }
            }
        }
    }

    fn check_reading(dimension: u32, pose: Pose) {
        let mut map = Map::new(dimension);
        let farthest = |heading| Passages::all_open(dimension).clear_cells(pose.cell, heading, 64);
        for shorter in [0, 1, 2] {
            let [left, front, right] =
                [3, 0, 1].map(|quarters| Heading::ALL[(pose.heading as usize + quarters) % 4]);
            let sensors = Sensors {
                left: farthest(left).saturating_sub(shorter),
                front: farthest(front).saturating_sub(shorter),
                right: farthest(right).saturating_sub(shorter),
            };
            map.observe(pose, sensors);
            assert_eq!(map.sight(pose.cell, left), Some(sensors.left));
            assert_eq!(map.sight(pose.cell, front), Some(sensors.front));
            assert_eq!(map.sight(pose.cell, right), Some(sensors.right));
            assert_eq!(map.observe(pose, sensors), News::default());
        }
        let back = pose.heading.opposite();
        let expected = if farthest(back) == 0 {
            Wall::Closed
        } else {
            Wall::Unknown
        };
        assert_eq!(map.wall(pose.cell, back), expected);
    }

    #[test]
    fn a_reading_beyond_the_perimeter_ends_there() {
        let mut map = Map::new(4);
        let far = Sensors {
            left: u32::MAX,
            front: 99,
            right: 4,
        };
        map.observe(pose(1, 1, Heading::Up), far);
        assert_eq!(map.sight(Cell::new(1, 1), Heading::Left), Some(1));
        assert_eq!(map.sight(Cell::new(1, 1), Heading::Up), Some(2));
        assert_eq!(map.sight(Cell::new(1, 1), Heading::Right), Some(2));
    }

    #[test]
    fn set_and_wall_agree() {
        let mut map = Map::new(4);
        let cell = Cell::new(2, 2);
        for wall in [Wall::Open, Wall::Closed, Wall::Unknown] {
            map.set(cell, Heading::Left, wall);
            assert_eq!(map.wall(Cell::new(1, 2), Heading::Right), wall);
            map.set(Cell::new(0, 2), Heading::Left, wall);
            assert_eq!(map.wall(Cell::new(0, 2), Heading::Left), Wall::Closed);
        }
    }
}
