//! [`Distances`]: how far every cell is from the goal or from one cell.
//!
//! A breadth-first search with flat arrays. The maze stores how many open cells there are in
//! each direction, so the search does not look at single walls.

use super::super::{Cell, Heading, Maze};

/// The longest move of a step in the ruleset `udacity`, in cells.
pub const LONGEST_MOVE: u8 = 3;

/// What a distance counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metric {
    /// Steps of a robot: each covers 1 to `longest_move` cells in a straight line, in any of
    /// the four directions.
    Steps {
        /// The longest move, in cells. If it is 0, no other cell is reachable.
        longest_move: u8,
    },
    /// Cells that the robot drives.
    Cells,
}

impl Metric {
    /// Steps of up to [`LONGEST_MOVE`] cells, as in the ruleset `udacity`.
    pub const STEPS: Self = Self::Steps {
        longest_move: LONGEST_MOVE,
    };

    /// The longest move with a cost of 1, in cells.
    const fn unit_move(self) -> u8 {
        match self {
            Self::Steps { longest_move } => longest_move,
            Self::Cells => 1,
        }
    }

    /// The longest move in a path, in cells.
    pub(super) const fn longest_move(self) -> u8 {
        match self {
            Self::Steps { longest_move } => longest_move,
            Self::Cells => LONGEST_MOVE,
        }
    }

    /// `steps` or `cells`, as in messages and JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Steps { .. } => "steps",
            Self::Cells => "cells",
        }
    }
}

/// The distance of every cell of one maze from the goal or from one cell.
///
/// ```
/// use wasmouse_core::maze::{Cell, Maze, Metric, Walls, distances_to_goal};
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let steps = distances_to_goal(&maze, Metric::STEPS);
/// assert_eq!(steps.get(Cell::new(0, 0)), Some(4));
/// let cells = distances_to_goal(&maze, Metric::Cells);
/// assert_eq!(cells.get(Cell::new(0, 0)), Some(10));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Distances {
    dimension: u8,
    /// By cell index; [`UNREACHED`] if there is no path.
    values: Box<[u32]>,
    /// The indices of the reachable cells, nearest first.
    order: Vec<u16>,
}

/// Greater than any distance: a maze has at most 64 x 64 cells.
const UNREACHED: u32 = u32::MAX;

impl Distances {
    /// The distance of `cell`; `None` if it is unreachable or outside the maze.
    pub fn get(&self, cell: Cell) -> Option<u32> {
        if cell.x >= self.dimension || cell.y >= self.dimension {
            return None;
        }
        let index = usize::from(cell.x) * usize::from(self.dimension) + usize::from(cell.y);
        Some(self.values[index]).filter(|&value| value != UNREACHED)
    }

    /// The largest distance of a reachable cell.
    pub fn largest(&self) -> u32 {
        self.order.last().map_or(0, |&index| self.at(index))
    }

    /// The number of reachable cells, including those at distance 0.
    pub fn reached(&self) -> usize {
        self.order.len()
    }

    /// The indices of the reachable cells, nearest first.
    pub(super) fn order(&self) -> &[u16] {
        &self.order
    }

    /// The distance of a reachable cell by index.
    pub(super) fn at(&self, index: u16) -> u32 {
        self.values[usize::from(index)]
    }
}

/// How far every cell is from the goal. The last step has to end in the goal: driving through
/// it is not enough.
pub fn distances_to_goal(maze: &Maze, metric: Metric) -> Distances {
    search(maze, maze.goal().cells(), metric)
}

/// How far every cell is from `cell`.
///
/// # Panics
///
/// If `cell` is outside the maze.
pub fn distances_from(maze: &Maze, cell: Cell, metric: Metric) -> Distances {
    assert!(maze.walls().contains(cell), "{cell} is outside the maze");
    search(maze, [cell], metric)
}

fn search(maze: &Maze, sources: impl IntoIterator<Item = Cell>, metric: Metric) -> Distances {
    let cells = usize::from(maze.dimension()).pow(2);
    let mut values = vec![UNREACHED; cells].into_boxed_slice();
    let mut order = Vec::with_capacity(cells);
    for source in sources {
        let index = maze.walls().index(source);
        values[index] = 0;
        order.push(narrow(index));
    }
    let mut next = 0;
    while let Some(&from) = order.get(next) {
        next += 1;
        let distance = values[usize::from(from)] + 1;
        // Each maze of a contest is solved, and this takes two thirds of the time of a `for` loop:
        // the iterator runs its own loops, one inside the other.
        moves(maze, from, metric.unit_move()).for_each(|step| {
            // Cells behind one that was reached before may still be new, so the search
            // continues to the end of the move.
            let value = &mut values[usize::from(step.to)];
            if *value == UNREACHED {
                *value = distance;
                order.push(step.to);
            }
        });
    }
    Distances {
        dimension: maze.dimension(),
        values,
        order,
    }
}

/// A straight move of at least 1 cell, to the cell with index `to`.
#[derive(Clone, Copy)]
pub(super) struct Move {
    pub(super) to: u16,
    pub(super) cells: u8,
}

/// All moves of up to `longest` cells from a cell, by heading, shortest first.
pub(super) fn moves(maze: &Maze, from: u16, longest: u8) -> impl Iterator<Item = Move> {
    let stride = i32::from(maze.dimension());
    let reach = *maze.reach_at(usize::from(from));
    Heading::ALL.into_iter().flat_map(move |heading| {
        let delta = match heading {
            Heading::Up => 1,
            Heading::Right => stride,
            Heading::Down => -1,
            Heading::Left => -stride,
        };
        let reach = reach[heading as usize].min(longest);
        (1..=reach).map(move |cells| {
            let to = i32::from(from) + delta * i32::from(cells);
            let to = u16::try_from(to).expect("a move ends inside the maze");
            Move { to, cells }
        })
    })
}

/// The cell with that index.
pub(super) fn cell_at(maze: &Maze, index: u16) -> Cell {
    let n = u16::from(maze.dimension());
    let narrow = |value: u16| u8::try_from(value).expect("a coordinate is below the dimension");
    Cell::new(narrow(index / n), narrow(index % n))
}

fn narrow(index: usize) -> u16 {
    u16::try_from(index).expect("a maze has at most 64 x 64 cells")
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::maze::Walls;
    use crate::maze::testing::random_maze;

    /// The same distances by a slower algorithm: relax single-cell drives until nothing
    /// changes. The state is the cell, the heading of the current move and the cells driven
    /// in it. A move that is as long as possible, or that changes its heading, costs another
    /// step.
    fn bellman_ford(maze: &Maze, from: Cell, metric: Metric) -> Vec<Option<u32>> {
        let longest = metric.unit_move();
        let walls = maze.walls();
        let moves = usize::from(longest) + 1;
        let slot = |heading: Heading, driven: u8| heading as usize * moves + usize::from(driven);
        let mut best = vec![vec![UNREACHED; 4 * moves]; walls.cells().count()];
        best[walls.index(from)][slot(Heading::Up, 0)] = 0;
        let mut changed = true;
        while changed {
            changed = false;
            for (cell, heading) in walls
                .cells()
                .flat_map(|cell| Heading::ALL.map(|it| (cell, it)))
            {
                for driven in 0..=longest {
                    let cost = best[walls.index(cell)][slot(heading, driven)];
                    let is_open = |out: &Heading| cost != UNREACHED && walls.is_open(cell, *out);
                    for out in Heading::ALL.into_iter().filter(is_open) {
                        let next = walls.neighbor(cell, out).expect("open");
                        let (cost, driven) = match driven {
                            0 => (cost + 1, 1),
                            _ if out == heading && driven < longest => (cost, driven + 1),
                            _ => (cost + 1, 1),
                        };
                        let old = &mut best[walls.index(next)][slot(out, driven)];
                        changed |= cost < *old;
                        *old = cost.min(*old);
                    }
                }
            }
        }
        let nearest = best.iter().map(|costs| costs.iter().copied().min());
        nearest
            .map(|cost| cost.filter(|&cost| cost != UNREACHED))
            .collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn search_agrees_with_bellman_ford(maze in random_maze(3..=9), longest in 1_u8..=4) {
            for metric in [Metric::Steps { longest_move: longest }, Metric::Cells] {
                let fast = distances_from(&maze, maze.start(), metric);
                let slow = bellman_ford(&maze, maze.start(), metric);
                for (cell, slow) in maze.walls().cells().zip(slow) {
                    prop_assert_eq!(fast.get(cell), slow, "{} at {}", metric.name(), cell);
                }
            }
        }

        #[test]
        fn distances_to_the_goal_are_distances_from_the_goal(maze in random_maze(3..=9)) {
            for metric in [Metric::STEPS, Metric::Cells] {
                let to_goal = distances_to_goal(&maze, metric);
                for cell in maze.walls().cells() {
                    let from = distances_from(&maze, cell, metric);
                    let nearest = maze.goal().cells().filter_map(|goal| from.get(goal)).min();
                    prop_assert_eq!(to_goal.get(cell), nearest);
                }
            }
        }
    }

    #[test]
    fn unreachable_cells_have_no_distance() {
        let maze = Maze::contest(Walls::closed(12)).expect("start and goal fit");
        let distances = distances_to_goal(&maze, Metric::STEPS);
        assert_eq!(distances.get(maze.start()), None);
        assert_eq!(distances.get(Cell::new(99, 0)), None);
        assert_eq!((distances.reached(), distances.largest()), (4, 0));
    }

    #[test]
    fn a_longest_move_of_0_reaches_nothing() {
        let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
        let distances = distances_from(&maze, maze.start(), Metric::Steps { longest_move: 0 });
        assert_eq!(distances.reached(), 1);
    }
}
