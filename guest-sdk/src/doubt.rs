//! The next wall to look at before the best path is certain: [`Doubt`].

use crate::{Cell, CellSet, Heading, Map, Pose, Search, View};

/// An unknown wall on the best path that may exist.
///
/// ```
/// use wasmouse_sdk::{Area, Cell, CellSet, Doubt, Heading, Map, Pose, Search, Sensors};
///
/// let mut map = Map::new(12);
/// let (start, goal) = (Cell::new(0, 0), CellSet::from(Cell::new(1, 3)));
/// map.observe(Pose::at_start(start), Sensors { left: 0, front: 11, right: 0 });
/// let mut search = Search::new(12, 3);
/// let doubt = Doubt::first(&map, &mut search, start, &goal);
/// assert_eq!(doubt, Some(Doubt { cell: Cell::new(0, 3), side: Heading::Right }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Doubt {
    /// The cell on this side of the wall; known to be reachable from the start.
    pub cell: Cell,
    /// The side of the cell that has the wall.
    pub side: Heading,
}

impl Doubt {
    /// The first unknown wall on the path with the fewest steps from `start` to `goal`,
    /// treating unknown walls as open.
    ///
    /// `None` if that whole path is known to be open, so that no better one exists, or if
    /// there is no path. A robot that drives to the cell, looks at the wall and asks again
    /// gets there, because it learns a wall each time.
    ///
    /// Refills `search`.
    pub fn first(map: &Map, search: &mut Search, start: Cell, goal: &CellSet) -> Option<Self> {
        let passages = map.passages(View::Optimistic);
        search.fill_until(passages, goal, start);
        let mut cell = start;
        for hop in search.route(passages, Pose::at_start(start)) {
            let known = map.passages(View::Pessimistic);
            let clear = known.clear_cells(cell, hop.heading, hop.cells);
            cell = cell.toward(hop.heading, clear)?;
            if clear < hop.cells {
                let side = hop.heading;
                return Some(Self { cell, side });
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Random, Wall};

    /// Answering doubt after doubt ends, with as many steps as the maze allows.
    #[test]
    fn answers_prove_the_best_path() {
        let mut random = Random::new(12);
        for _ in 0..100 {
            let mut maze = Map::new(9);
            for x in 0..9 {
                for y in 0..9 {
                    for side in [Heading::Up, Heading::Right] {
                        let is_closed = random.below(100) < 25;
                        let wall = if is_closed { Wall::Closed } else { Wall::Open };
                        maze.set(Cell::new(x, y), side, wall);
                    }
                }
            }
            let (start, goal) = (Cell::new(0, 0), CellSet::from(Cell::new(4, 4)));
            let mut map = Map::new(9);
            let mut search = Search::new(9, 3);
            let mut asked = 0;
            while let Some(doubt) = Doubt::first(&map, &mut search, start, &goal) {
                assert_eq!(map.wall(doubt.cell, doubt.side), Wall::Unknown);
                map.set(doubt.cell, doubt.side, maze.wall(doubt.cell, doubt.side));
                asked += 1;
            }
            assert!(asked <= 144, "{asked} questions about 144 walls");
            search.fill(map.passages(View::Pessimistic), &goal);
            let proven = search.steps(start);
            search.fill(maze.passages(View::Pessimistic), &goal);
            assert_eq!(proven, search.steps(start));
        }
    }
}
