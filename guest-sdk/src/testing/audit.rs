//! Compares a robot's map with the maze: [`MapAudit`].

use super::maze::Maze;
use crate::{Cell, Heading, Map, Wall};

/// How a robot's map ([`Robot::map`](crate::Robot::map)) compares with the maze.
///
/// Checked after every step. An unknown wall is not an error.
///
/// ```
/// use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};
/// use wasmouse_sdk::{Action, Briefing, Heading, Map, Robot, Sensors, Tracker};
///
/// struct Up(Tracker);
///
/// impl Robot for Up {
///     fn start(briefing: &Briefing) -> Self {
///         Self(Tracker::new(briefing))
///     }
///
///     fn next_move(&mut self, sensors: Sensors) -> Action {
///         self.0.observe(sensors);
///         self.0.go(Heading::Up, 3)
///     }
///
///     fn map(&self) -> Option<&Map> {
///         Some(self.0.map())
///     }
/// }
///
/// let played = testing::play::<Up>(MAZE_01, &PlayOptions::default());
/// let audit = played.map.expect("it shows a map");
/// assert_eq!(audit.first_error, None);
/// assert!(audit.known > 12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MapAudit {
    /// Walls between two cells, open or closed, that the map knows at the end.
    pub known: u32,
    /// Where the map was first wrong: after which step, counted from 1, the cell and its
    /// side.
    pub first_error: Option<(u32, Cell, Heading)>,
}

impl MapAudit {
    /// The audit after that step.
    pub(super) fn after(self, call: u32, map: &Map, maze: &Maze) -> Self {
        let sides = [Heading::Up, Heading::Right];
        let cells =
            (0..maze.dimension).flat_map(|x| (0..maze.dimension).map(move |y| Cell::new(x, y)));
        let known = cells
            .flat_map(|cell| sides.map(|side| (cell, side)))
            .filter(|&(cell, side)| map.neighbor(cell, side).is_some())
            .filter(|&(cell, side)| map.wall(cell, side) != Wall::Unknown);
        let is_wrong = |&(cell, side): &(Cell, Heading)| {
            (map.wall(cell, side) == Wall::Open) != maze.is_open(cell, side)
        };
        let error = known.clone().find(is_wrong);
        Self {
            known: known.count() as u32,
            first_error: self
                .first_error
                .or(error.map(|(cell, side)| (call, cell, side))),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{self, MAZE_01, PlayOptions};
    use crate::{Action, Briefing, Cell, Heading, Map, Robot, Sensors, Tracker};

    /// Drives by what it sees; variant 1 mixes up left and right in its map.
    struct Careless {
        tracker: Tracker,
        mixes_up: bool,
    }

    impl Robot for Careless {
        fn start(briefing: &Briefing) -> Self {
            Self {
                tracker: Tracker::new(briefing),
                mixes_up: briefing.variant == 1,
            }
        }

        fn next_move(&mut self, sensors: Sensors) -> Action {
            let Sensors { left, front, right } = sensors;
            let seen = if self.mixes_up {
                Sensors {
                    left: right,
                    front,
                    right: left,
                }
            } else {
                sensors
            };
            self.tracker.observe(seen);
            self.tracker.go(Heading::Up, 3)
        }

        fn map(&self) -> Option<&Map> {
            Some(self.tracker.map())
        }
    }

    #[test]
    fn a_wrong_map_is_found_out() {
        let audit = |variant| {
            let options = PlayOptions::of_variant(variant);
            testing::play::<Careless>(MAZE_01, &options).map
        };
        let honest = audit(0).expect("a map");
        assert_eq!(honest.first_error, None);
        // The third call is in (0, 6), where the right side is open.
        let wrong = audit(1).expect("a map").first_error;
        assert_eq!(wrong, Some((3, Cell::new(0, 6), Heading::Right)));
    }
}
