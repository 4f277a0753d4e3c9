//! [`Path`]: an optimal path from the start to the goal.
//!
//! Of several optimal paths, the choice is fixed: among the paths with the fewest steps the
//! one with the fewest cells, or the reverse. Remaining ties go to the first direction
//! clockwise from up, then to the shorter move.

use std::cmp::Ordering;

use super::super::{Cell, Heading, Maze};
use super::distances::{Distances, Metric, cell_at, distances_to_goal, moves};

/// A path from the start to the goal: the cells where its steps end.
///
/// ```
/// use wasmouse_core::maze::{Maze, Metric, Walls, shortest_path};
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let path = shortest_path(&maze, Metric::STEPS).expect("the goal is reachable");
/// assert_eq!((path.steps(), path.cells()), (4, 10));
/// assert_eq!(path.stops()[0], maze.start());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Path {
    /// Never empty; consecutive cells are on a straight line.
    stops: Vec<Cell>,
}

impl Path {
    /// The cells where steps end, the start first. Never empty; consecutive cells are on a
    /// straight line.
    pub fn stops(&self) -> &[Cell] {
        &self.stops
    }

    /// Steps from the start to the goal.
    pub fn steps(&self) -> u32 {
        u32::try_from(self.stops.len() - 1).expect("a path visits no cell twice")
    }

    /// Cells driven from the start to the goal, not counting the start.
    pub fn cells(&self) -> u32 {
        self.moves().map(|(_, cells)| u32::from(cells)).sum()
    }

    /// The direction and the number of cells of each step; at least 1 cell.
    pub fn moves(&self) -> impl Iterator<Item = (Heading, u8)> {
        self.stops.windows(2).map(|pair| between(pair[0], pair[1]))
    }

    /// Every cell of the path, in order, the start first.
    pub fn trail(&self) -> Vec<Cell> {
        let mut cell = self.stops[0];
        let mut trail = vec![cell];
        for (heading, cells) in self.moves() {
            for _ in 0..cells {
                cell = cell.step(heading).expect("a path stays in the maze");
                trail.push(cell);
            }
        }
        trail
    }
}

/// The optimal path from the start to the goal in that metric; `None` if the goal is
/// unreachable.
///
/// With [`Metric::Cells`], a step of the path has up to [`LONGEST_MOVE`](super::LONGEST_MOVE)
/// cells.
pub fn shortest_path(maze: &Maze, metric: Metric) -> Option<Path> {
    let distances = distances_to_goal(maze, metric);
    distances.get(maze.start())?;
    let onward = onward_moves(maze, metric, &distances);
    let mut at = u16::try_from(maze.walls().index(maze.start())).expect("at most 64 x 64 cells");
    let mut stops = vec![maze.start()];
    while distances.at(at) > 0 {
        at = onward[usize::from(at)].1;
        stops.push(cell_at(maze, at));
    }
    Some(Path { stops })
}

/// For every reachable cell, the cost of its best path to the goal in the other metric, and
/// the index of the cell where the next step ends.
///
/// One pass over the cells, nearest first, is enough: every optimal step leads to a nearer
/// cell.
fn onward_moves(maze: &Maze, metric: Metric, distances: &Distances) -> Vec<(u32, u16)> {
    let mut onward = vec![(0, 0); usize::from(maze.dimension()).pow(2)];
    for &from in distances.order() {
        let here = distances.at(from);
        if here == 0 {
            continue;
        }
        onward[usize::from(from)] = moves(maze, from, metric.longest_move())
            .filter_map(|step| {
                let (cost, other) = match metric {
                    Metric::Steps { .. } => (1, u32::from(step.cells)),
                    Metric::Cells => (u32::from(step.cells), 1),
                };
                let optimal = distances.at(step.to).checked_add(cost) == Some(here);
                optimal.then(|| (onward[usize::from(step.to)].0 + other, step.to))
            })
            .min_by_key(|&(other, _)| other)
            .expect("a step leads nearer to the goal");
    }
    onward
}

/// The direction and distance from one cell to another in its row or column.
fn between(from: Cell, to: Cell) -> (Heading, u8) {
    let heading = match (to.x.cmp(&from.x), to.y.cmp(&from.y)) {
        (Ordering::Greater, _) => Heading::Right,
        (Ordering::Less, _) => Heading::Left,
        (Ordering::Equal, Ordering::Greater) => Heading::Up,
        (Ordering::Equal, _) => Heading::Down,
    };
    (heading, from.x.abs_diff(to.x) + from.y.abs_diff(to.y))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::maze::Walls;
    use crate::maze::testing::random_maze;

    proptest! {
        #[test]
        fn a_path_is_drivable_and_as_long_as_its_distance(maze in random_maze(4..=12)) {
            for metric in [Metric::STEPS, Metric::Cells] {
                let distance = distances_to_goal(&maze, metric).get(maze.start());
                let path = shortest_path(&maze, metric);
                prop_assert_eq!(path.is_some(), distance.is_some());
                let Some(path) = path else { continue };
                let length = match metric {
                    Metric::Steps { .. } => path.steps(),
                    Metric::Cells => path.cells(),
                };
                prop_assert_eq!(Some(length), distance);
                let mut at = maze.start();
                for (heading, cells) in path.moves() {
                    prop_assert!((1..=3).contains(&cells));
                    prop_assert!(cells <= maze.reach(at, heading), "through a wall at {}", at);
                    at = (0..cells).fold(at, |cell, _| cell.step(heading).expect("inside"));
                }
                prop_assert!(maze.goal().contains(at));
                prop_assert_eq!(path.trail().len(), path.cells() as usize + 1);
            }
        }

        #[test]
        fn each_metric_gives_the_shortest_path_in_it(maze in random_maze(4..=12)) {
            let steps = shortest_path(&maze, Metric::STEPS);
            let cells = shortest_path(&maze, Metric::Cells);
            if let (Some(steps), Some(cells)) = (steps, cells) {
                prop_assert!(steps.steps() <= cells.steps());
                prop_assert!(cells.cells() <= steps.cells());
            }
        }
    }

    #[test]
    fn a_closed_maze_has_no_path() {
        let maze = Maze::contest(Walls::closed(12)).expect("start and goal fit");
        assert_eq!(shortest_path(&maze, Metric::STEPS), None);
    }

    #[test]
    fn a_goal_in_the_middle_of_a_corridor_needs_a_step_that_ends_there() {
        // A 5 x 5 maze has its one goal cell at (2, 2), one cell before the
        // longest move from (0, 2) would end.
        let maze = Maze::contest(Walls::open(5)).expect("start and goal fit");
        let path = shortest_path(&maze, Metric::STEPS).expect("open");
        assert_eq!(
            path.moves().collect::<Vec<_>>(),
            [(Heading::Up, 2), (Heading::Right, 2)]
        );
    }
}
