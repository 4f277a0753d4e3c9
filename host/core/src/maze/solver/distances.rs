//! [`Distances`]: how far every cell is from the goal or from one cell.
//!
//! A breadth-first search with flat arrays. The maze already knows how many
//! open cells lie in each direction, so a move needs no look at single walls.

use super::super::{Cell, Heading, Maze};

/// The longest move of a step in the ruleset `udacity`, in cells.
pub const LONGEST_MOVE: u8 = 3;

/// What a distance counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metric {
    /// Steps of a robot: each covers 1 to `longest_move` cells in a straight
    /// line, in any of the four directions.
    Steps {
        /// The longest move, in cells. Range: at least 1 to get anywhere; 0
        /// leaves every other cell out of reach.
        longest_move: u8,
    },
    /// Cells driven through.
    Cells,
}

impl Metric {
    /// Steps of up to [`LONGEST_MOVE`] cells, as in the ruleset `udacity`.
    pub const STEPS: Self = Self::Steps {
        longest_move: LONGEST_MOVE,
    };

    /// The longest move that costs 1 in this metric, in cells.
    const fn unit_move(self) -> u8 {
        match self {
            Self::Steps { longest_move } => longest_move,
            Self::Cells => 1,
        }
    }

    /// The longest move of the robot whose path is wanted, in cells.
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
/// let maze = Maze::contest(Walls::open(12)).expect("a 12 x 12 maze has room");
/// let steps = distances_to_goal(&maze, Metric::STEPS);
/// assert_eq!(steps.get(Cell::new(0, 0)), Some(4));
/// let cells = distances_to_goal(&maze, Metric::Cells);
/// assert_eq!(cells.get(Cell::new(0, 0)), Some(10));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Distances {
    dimension: u8,
    /// By cell index; [`UNREACHED`] where no way leads.
    values: Box<[u32]>,
    /// Indices of the reached cells, nearest first.
    order: Vec<u16>,
}

/// Larger than any distance: a maze has at most 64 x 64 cells.
const UNREACHED: u32 = u32::MAX;

impl Distances {
    /// The distance of `cell`; `None` when no way leads there or the maze has
    /// no such cell.
    pub fn get(&self, cell: Cell) -> Option<u32> {
        if cell.x >= self.dimension || cell.y >= self.dimension {
            return None;
        }
        let index = usize::from(cell.x) * usize::from(self.dimension) + usize::from(cell.y);
        Some(self.values[index]).filter(|&value| value != UNREACHED)
    }

    /// The largest distance of any reached cell; 0 when only sources were reached.
    pub fn largest(&self) -> u32 {
        self.order.last().map_or(0, |&index| self.at(index))
    }

    /// How many cells were reached, sources included.
    pub fn reached(&self) -> usize {
        self.order.len()
    }

    /// The reached cells as indices, nearest first.
    pub(super) fn order(&self) -> &[u16] {
        &self.order
    }

    /// The distance of a reached cell by index.
    pub(super) fn at(&self, index: u16) -> u32 {
        self.values[usize::from(index)]
    }
}

/// How far every cell is from the goal. Steps count only when they end in the
/// goal, so a cell from which the robot would have to overshoot is no nearer
/// for it.
pub fn distances_to_goal(maze: &Maze, metric: Metric) -> Distances {
    search(maze, maze.goal().cells(), metric)
}

/// How far every cell is from `cell`.
///
/// # Panics
///
/// When `cell` is outside the maze.
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
        for step in moves(maze, from, metric.unit_move()) {
            // Cells behind a nearer one may still be new, so the search goes on
            // to the end of the move.
            let value = &mut values[usize::from(step.to)];
            if *value == UNREACHED {
                *value = distance;
                order.push(step.to);
            }
        }
    }
    Distances {
        dimension: maze.dimension(),
        values,
        order,
    }
}

/// A straight move of 1 or more cells from one cell to another, by index.
#[derive(Clone, Copy)]
pub(super) struct Move {
    pub(super) to: u16,
    pub(super) cells: u8,
}

/// All moves from a cell of up to `longest` cells: by heading, shortest first.
pub(super) fn moves(maze: &Maze, from: u16, longest: u8) -> impl Iterator<Item = Move> {
    let stride = i32::from(maze.dimension());
    let cell = cell_at(maze, from);
    Heading::ALL.into_iter().flat_map(move |heading| {
        let delta = match heading {
            Heading::Up => 1,
            Heading::Right => stride,
            Heading::Down => -1,
            Heading::Left => -stride,
        };
        let reach = maze.reach(cell, heading).min(longest);
        (1..=reach).map(move |cells| {
            let to = i32::from(from) + delta * i32::from(cells);
            let to = u16::try_from(to).expect("reach ends inside the maze");
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
    use crate::maze::solver::testing::random_maze;

    /// The same distances the slow way: relax every single-cell drive until
    /// nothing changes. The state is the cell, the heading of the current
    /// straight drive and the cells driven in it; a drive that is full, or that
    /// changes its heading, costs another step.
    fn bellman_ford(maze: &Maze, from: Cell, metric: Metric) -> Vec<Option<u32>> {
        let longest = metric.unit_move();
        let n = maze.dimension();
        let cells: Vec<Cell> = maze.walls().cells().collect();
        let state = |cell: Cell, heading: Heading, driven: u8| {
            (maze.walls().index(cell) * 4 + heading as usize) * usize::from(longest + 1)
                + usize::from(driven)
        };
        let mut best = vec![u32::MAX; usize::from(n).pow(2) * 4 * usize::from(longest + 1)];
        for heading in Heading::ALL {
            best[state(from, heading, 0)] = 0;
        }
        let mut changed = true;
        while changed {
            changed = false;
            for &cell in &cells {
                for heading in Heading::ALL {
                    for driven in 0..=longest {
                        let cost = best[state(cell, heading, driven)];
                        if cost == u32::MAX {
                            continue;
                        }
                        for out in Heading::ALL {
                            if !maze.walls().is_open(cell, out) {
                                continue;
                            }
                            let next = maze.walls().neighbor(cell, out).expect("open");
                            let same_drive = out == heading && driven > 0 && driven < longest;
                            let (cost, driven) = if same_drive {
                                (cost, driven + 1)
                            } else {
                                (cost + 1, 1)
                            };
                            let slot = &mut best[state(next, out, driven)];
                            if cost < *slot {
                                *slot = cost;
                                changed = true;
                            }
                        }
                    }
                }
            }
        }
        cells
            .iter()
            .map(|&cell| {
                Heading::ALL
                    .into_iter()
                    .flat_map(|h| (0..=longest).map(move |d| (h, d)))
                    .map(|(h, d)| best[state(cell, h, d)])
                    .min()
                    .filter(|&cost| cost != u32::MAX)
            })
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
        fn distances_are_symmetric(maze in random_maze(3..=9)) {
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
        let maze = Maze::contest(Walls::closed(12)).expect("room for both");
        let distances = distances_to_goal(&maze, Metric::STEPS);
        assert_eq!(distances.get(maze.start()), None);
        assert_eq!(distances.get(Cell::new(99, 0)), None);
        assert_eq!((distances.reached(), distances.largest()), (4, 0));
    }

    #[test]
    fn a_move_of_no_cells_leads_nowhere() {
        let maze = Maze::contest(Walls::open(12)).expect("room for both");
        let distances = distances_from(&maze, maze.start(), Metric::Steps { longest_move: 0 });
        assert_eq!(distances.reached(), 1);
    }
}
