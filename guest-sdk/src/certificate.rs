//! Bounds on the length of the best path: [`Certificate`].
//!
//! The idea is from Minnett's report: the shortest path if every unknown wall is open, and
//! the shortest if every unknown wall is closed. The best path is between the two.

use crate::{Cell, CellSet, Map, Search, View};

/// Bounds on the fewest steps from a cell to the nearest of some targets.
///
/// ```
/// use wasmouse_sdk::{Area, Cell, CellSet, Certificate, Map, Pose, Search, Sensors};
///
/// let mut map = Map::new(12);
/// let (start, goal) = (Cell::new(0, 0), CellSet::from(Cell::new(0, 5)));
/// let mut search = Search::new(12, 3);
/// assert!(!Certificate::of(&map, start, &goal, &mut search).is_proven());
///
/// map.observe(Pose::at_start(start), Sensors { left: 0, front: 5, right: 0 });
/// let certificate = Certificate::of(&map, start, &goal, &mut search);
/// assert_eq!((certificate.at_least, certificate.at_most), (Some(2), Some(2)));
/// assert!(certificate.is_proven());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// Steps if every unknown wall is open: a lower bound. `None` if there is certainly no
    /// path.
    pub at_least: Option<u32>,
    /// Steps through walls known to be open: an upper bound. `None` if no path is known.
    pub at_most: Option<u32>,
}

impl Certificate {
    /// The bounds for a map. Refills `search`.
    pub fn of(map: &Map, from: Cell, targets: &CellSet, search: &mut Search) -> Self {
        let mut steps = |view| {
            search.fill_until(map.passages(view), targets, from);
            search.steps(from)
        };
        Self {
            at_least: steps(View::Optimistic),
            at_most: steps(View::Pessimistic),
        }
    }

    /// Whether the shortest known path is the best one, whatever the unknown walls are.
    pub const fn is_proven(self) -> bool {
        match (self.at_least, self.at_most) {
            (Some(least), Some(most)) => least == most,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Heading, Wall};

    #[test]
    fn no_path_proves_nothing() {
        let mut map = Map::new(2);
        let cell = Cell::new(0, 0);
        map.set(cell, Heading::Up, Wall::Closed);
        map.set(cell, Heading::Right, Wall::Closed);
        let targets = CellSet::from(Cell::new(1, 1));
        let certificate = Certificate::of(&map, cell, &targets, &mut Search::new(2, 3));
        assert_eq!((certificate.at_least, certificate.at_most), (None, None));
        assert!(!certificate.is_proven());
    }
}
