//! Cheapest paths under costs of your own: [`AStar`].
//!
//! Slower and more general than [`Search`](crate::Search), which counts steps and
//! nothing else: here every hop has a cost that the robot names, so unknown walls,
//! visited cells or dead ends can be dear without being forbidden. The algorithm is
//! that of Hart, Nilsson and Raphael (*A Formal Basis for the Heuristic
//! Determination of Minimum Cost Paths*, 1968).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::geometry::DIMENSION_MAX;
use crate::{Cell, CellSet, Heading, Hop, Passages};

/// A path and what it costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Path<'a> {
    /// The sum of the costs of the hops.
    pub cost: u32,
    /// The hops from the first cell to a target; none when it is a target itself.
    pub hops: &'a [Hop],
}

/// A* over hops of up to the longest move, with reusable buffers.
///
/// ```
/// use wasmouse_sdk::{Area, AStar, Cell, CellSet, Map, View};
///
/// let map = Map::new(12);
/// let goal = Area::center(12);
/// let mut astar = AStar::new(12, 1);
/// let path = astar
///     .path(
///         map.passages(View::Optimistic),
///         Cell::new(0, 0),
///         &CellSet::from(goal),
///         |_, _| Some(1),
///         |cell| cell.manhattan(goal.origin).saturating_sub(2),
///     )
///     .expect("nothing is known to be closed");
/// assert_eq!((path.cost, path.hops.len()), (10, 10));
/// ```
#[derive(Clone, Debug)]
pub struct AStar {
    dimension: u32,
    longest_move: u32,
    nodes: Vec<Node>,
    /// Cells to go on from, the most promising first.
    open: BinaryHeap<Reverse<Entry>>,
    path: Vec<Hop>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// The cheapest way found so far.
    cost: u32,
    /// The last hop of that way.
    hop: Option<Hop>,
}

/// Ordered by its fields from the first: the estimated cost of the whole path, then
/// the age, so that equal ones are taken in the order in which they were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Entry {
    total: u32,
    age: u32,
    cost: u32,
    cell: Cell,
}

const NOT_REACHED: Node = Node {
    cost: u32::MAX,
    hop: None,
};

impl AStar {
    /// Buffers for mazes of this dimension, for hops of up to `longest_move` cells;
    /// 1 makes it a search over cells.
    ///
    /// # Panics
    ///
    /// When `dimension` is outside 2..=64 or `longest_move` is 0.
    pub fn new(dimension: u32, longest_move: u32) -> Self {
        assert!(
            (2..=DIMENSION_MAX).contains(&dimension),
            "the dimension is outside 2..=64"
        );
        assert!(longest_move > 0, "the longest move is at least 1 cell");
        Self {
            dimension,
            longest_move,
            nodes: vec![NOT_REACHED; (dimension * dimension) as usize],
            open: BinaryHeap::new(),
            path: Vec::new(),
        }
    }

    /// The cheapest path from `from` to one of `targets`; `None` when there is none.
    ///
    /// `cost` is what a hop from a cell costs, `None` where it is forbidden; sums
    /// stay below 2^32 - 1. `estimate` guesses what is still to pay from a cell.
    /// When it never guesses too much, the path is a cheapest one; an estimate of 0
    /// makes this Dijkstra's search. Hops are tried clockwise from up, the shortest
    /// first; among equal totals the oldest cell goes first.
    pub fn path(
        &mut self,
        passages: &Passages,
        from: Cell,
        targets: &CellSet,
        mut cost: impl FnMut(Cell, Hop) -> Option<u32>,
        mut estimate: impl FnMut(Cell) -> u32,
    ) -> Option<Path<'_>> {
        assert_eq!(
            passages.dimension, self.dimension,
            "the passages are of another dimension"
        );
        self.nodes.fill(NOT_REACHED);
        self.open.clear();
        let mut age = 0;
        self.reach(from, 0, None, estimate(from), age);
        while let Some(Reverse(entry)) = self.open.pop() {
            let cell = entry.cell;
            if targets.contains(cell) {
                return Some(self.build(cell));
            }
            // A cheaper way to this cell has been found since.
            if entry.cost > self.nodes[self.index(cell)].cost {
                continue;
            }
            for heading in Heading::ALL {
                for cells in 1..=passages.clear_cells(cell, heading, self.longest_move) {
                    let hop = Hop { heading, cells };
                    let there = cell.toward(heading, cells);
                    let (Some(there), Some(price)) = (there, cost(cell, hop)) else {
                        continue;
                    };
                    let sum = entry.cost.saturating_add(price);
                    if sum < self.nodes[self.index(there)].cost {
                        age += 1;
                        self.reach(there, sum, Some(hop), estimate(there), age);
                    }
                }
            }
        }
        None
    }

    fn reach(&mut self, cell: Cell, cost: u32, hop: Option<Hop>, rest: u32, age: u32) {
        let index = self.index(cell);
        self.nodes[index] = Node { cost, hop };
        self.open.push(Reverse(Entry {
            total: cost.saturating_add(rest),
            age,
            cost,
            cell,
        }));
    }

    /// Follows the last hops back from the target.
    fn build(&mut self, target: Cell) -> Path<'_> {
        let cost = self.nodes[self.index(target)].cost;
        self.path.clear();
        let mut cell = target;
        while let Some(hop) = self.nodes[self.index(cell)].hop {
            self.path.push(hop);
            cell = cell
                .toward(hop.heading.opposite(), hop.cells)
                .expect("the hop came from inside the maze");
        }
        self.path.reverse();
        Path {
            cost,
            hops: &self.path,
        }
    }

    const fn index(&self, cell: Cell) -> usize {
        (cell.y * self.dimension + cell.x) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use crate::{Area, Search};

    fn random_passages(random: &mut Random) -> Passages {
        let mut passages = Passages::all_open(12);
        for cell in Area::new(Cell::new(0, 0), 12, 12).cells() {
            for heading in [Heading::Up, Heading::Right] {
                if random.below(100) < 35 {
                    passages.close(cell, heading);
                }
            }
        }
        passages
    }

    /// With hops of one step each it is the breadth-first search, whatever an
    /// honest estimate says.
    #[test]
    fn agrees_with_the_search() {
        let mut random = Random::new(3);
        for _ in 0..200 {
            let passages = random_passages(&mut random);
            let target = Cell::new(random.below(12), random.below(12));
            let from = Cell::new(random.below(12), random.below(12));
            let targets = CellSet::from(target);
            let mut search = Search::new(12, 3);
            search.fill(&passages, &targets);
            let mut astar = AStar::new(12, 3);
            for weight in [0, 1] {
                let estimate = |cell: Cell| weight * cell.manhattan(target).div_ceil(3);
                let path = astar.path(&passages, from, &targets, |_, _| Some(1), estimate);
                assert_eq!(path.map(|it| it.cost), search.steps(from));
                let end = path.map(|it| {
                    it.hops.iter().fold(from, |at, hop| {
                        let clear = passages.clear_cells(at, hop.heading, hop.cells);
                        assert_eq!(clear, hop.cells);
                        at.toward(hop.heading, clear).expect("clear")
                    })
                });
                assert!(end.is_none_or(|it| it == target));
            }
        }
    }

    #[test]
    fn dear_and_forbidden_cells_are_avoided() {
        let passages = Passages::all_open(4);
        let (from, target) = (Cell::new(0, 0), Cell::new(2, 0));
        let middle = Cell::new(1, 0);
        let mut astar = AStar::new(4, 1);
        let mut cost_with = |price: Option<u32>| {
            let cost = |cell: Cell, hop: Hop| {
                if cell.toward(hop.heading, hop.cells) == Some(middle) {
                    price
                } else {
                    Some(10)
                }
            };
            let targets = CellSet::from(target);
            let path = astar.path(&passages, from, &targets, cost, |_| 0);
            path.map(|it| (it.cost, it.hops.len()))
        };
        assert_eq!(cost_with(Some(10)), Some((20, 2)));
        assert_eq!(cost_with(Some(29)), Some((39, 2)));
        assert_eq!(cost_with(Some(31)), Some((40, 4)));
        assert_eq!(cost_with(None), Some((40, 4)));
    }

    #[test]
    fn no_path_and_no_way_to_go() {
        let passages = Passages::all_closed(4);
        let mut astar = AStar::new(4, 3);
        let here = Cell::new(1, 1);
        let one = |_: Cell, _: Hop| Some(1);
        let away = CellSet::from(Cell::new(3, 3));
        assert_eq!(astar.path(&passages, here, &away, one, |_| 0), None);
        let path = astar.path(&passages, here, &CellSet::from(here), one, |_| 0);
        assert_eq!(path, Some(Path { cost: 0, hops: &[] }));
    }
}
