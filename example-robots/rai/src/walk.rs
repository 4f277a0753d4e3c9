//! Where to go in the exploration run, cell by cell: [`Walk`].
//!
//! It keeps the report's traversal grid and marks of dead ends. It does not know the budget or
//! when to stop.

use wasmouse_sdk::journal::{self, Color};
use wasmouse_sdk::{Area, Cell, CellSet, Heading, Map, Pose, Random, Turn, Wall};

/// What to do about dead ends.
pub enum DeadEnds {
    /// Mark them while backing out, and never enter them again.
    Mark,
    /// Back out to the next junction, and go anywhere from there.
    BackOut {
        /// Chooses the direction at the junction.
        random: Random,
        /// Whether the robot is on its way to the junction.
        retreating: bool,
    },
}

/// How often the robot has been in each cell, and what follows from that.
pub struct Walk {
    goal: Area,
    dimension: u32,
    /// By column and row.
    counts: Vec<u32>,
    visited: CellSet,
    /// How many cells are in `visited`.
    visited_cells: u32,
    marked: CellSet,
    dead_ends: DeadEnds,
}

impl Walk {
    pub fn new(dimension: u32, goal: Area, dead_ends: DeadEnds) -> Self {
        Self {
            goal,
            dimension,
            counts: vec![0; (dimension * dimension) as usize],
            visited: CellSet::new(),
            visited_cells: 0,
            marked: CellSet::new(),
            dead_ends,
        }
    }

    /// The cells that the robot has been in.
    pub const fn visited(&self) -> &CellSet {
        &self.visited
    }

    /// Whether the robot has been in at least that share of all cells.
    pub const fn has_visited(&self, percent: u32) -> bool {
        self.visited_cells * 100 >= percent * self.dimension * self.dimension
    }

    /// Counts a visit of `cell`.
    pub fn visit(&mut self, cell: Cell) {
        let index = self.index(cell);
        self.counts[index] += 1;
        if self.counts[index] == 1 {
            self.visited.insert(cell);
            self.visited_cells += 1;
            journal::paint(cell, Color::Green);
        }
    }

    /// The direction of the next cell: ahead, to the left or to the right where
    /// it has been least, or back. Back may be closed or unknown.
    pub fn next(&mut self, map: &Map, pose: Pose) -> Heading {
        let back = pose.heading.opposite();
        let open = [Turn::Left, Turn::Straight, Turn::Right]
            .map(|turn| pose.heading.turned(turn))
            .map(|side| (map.wall(pose.cell, side) == Wall::Open).then_some(side));
        let open: Vec<Heading> = open.into_iter().flatten().collect();
        match &mut self.dead_ends {
            DeadEnds::Mark => {
                let least = self.least_traversed(pose.cell, &open);
                if least.is_none() {
                    self.marked.insert(pose.cell);
                    journal::paint(pose.cell, Color::Red);
                }
                least.unwrap_or(back)
            }
            DeadEnds::BackOut { random, retreating } => {
                *retreating |= open.is_empty();
                if !*retreating {
                    return self.least_traversed(pose.cell, &open).unwrap_or(back);
                }
                if open.len() < 2 && map.wall(pose.cell, back) != Wall::Closed {
                    return back;
                }
                *retreating = false;
                match u32::try_from(open.len()) {
                    Ok(ways @ 1..) => open[random.below(ways) as usize],
                    _ => back,
                }
            }
        }
    }

    /// The report's order: fewest visits, then nearest to the goal, then by
    /// coordinates. Marked dead ends are left out.
    fn least_traversed(&self, cell: Cell, open: &[Heading]) -> Option<Heading> {
        let beyond = |&side: &Heading| cell.toward(side, 1).map(|it| (side, it));
        open.iter()
            .filter_map(beyond)
            .filter(|&(_, it)| !self.marked.contains(it))
            .min_by_key(|&(_, it)| (self.counts[self.index(it)], self.to_goal(it), it.x, it.y))
            .map(|(side, _)| side)
    }

    /// Manhattan distance to the nearest goal cell, in cells.
    const fn to_goal(&self, cell: Cell) -> u32 {
        let Area {
            origin,
            width,
            height,
        } = self.goal;
        outside(cell.x, origin.x, width) + outside(cell.y, origin.y, height)
    }

    const fn index(&self, cell: Cell) -> usize {
        (cell.x * self.dimension + cell.y) as usize
    }
}

/// How far `at` is from the range of that length, which is at least 1.
const fn outside(at: u32, first: u32, length: u32) -> u32 {
    first.saturating_sub(at) + at.saturating_sub(first + length - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_heuristic_grid_of_maze_01() {
        // Three columns of figure 8.
        let columns = [
            (0, [10, 9, 8, 7, 6, 5, 5, 6, 7, 8, 9, 10]),
            (5, [5, 4, 3, 2, 1, 0, 0, 1, 2, 3, 4, 5]),
            (9, [8, 7, 6, 5, 4, 3, 3, 4, 5, 6, 7, 8]),
        ];
        let walk = Walk::new(12, Area::center(12), DeadEnds::Mark);
        for (x, column) in columns {
            let distances: Vec<u32> = (0..12).map(|y| walk.to_goal(Cell::new(x, y))).collect();
            assert_eq!(distances, column, "column {x}");
        }
    }
}
