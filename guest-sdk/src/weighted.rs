//! Cheapest ways to the goal when walls have costs: [`WeightedSearch`].
//!
//! Between [`Search`](crate::Search), which counts steps, and
//! [`AStar`](crate::AStar), which asks for the cost of every hop: here a step has a
//! fixed price and every wall on its way adds one of its own, for instance for the
//! chance that it stands. One search answers for all cells. Costs are small whole
//! numbers, so cells wait in buckets instead of a heap (Dial, *Algorithm 360:
//! Shortest-Path Forest with Topological Ordering*, 1969).

use crate::{Grid, Heading, Hop};

/// The cost of a wall that cannot be driven through.
pub const IMPASSABLE: u16 = u16::MAX;

/// Costs from every cell to a set of targets, with reusable buffers.
///
/// ```
/// use wasmouse_sdk::{Cell, Grid, Heading, Hop, IMPASSABLE, WeightedSearch};
///
/// let grid = Grid::new(4);
/// let mut costs = vec![IMPASSABLE; grid.wall_count()];
/// grid.inner_walls().for_each(|wall| costs[wall] = 0);
/// let (from, target) = (grid.cell(Cell::new(0, 0)), grid.cell(Cell::new(3, 0)));
///
/// let mut search = WeightedSearch::new(grid, 3, 10);
/// search.run(&costs, &[target], None);
/// assert_eq!(search.cost(from), Some(10));
/// let hop = Hop { heading: Heading::Right, cells: 3 };
/// assert_eq!(search.hop(from), Some(hop));
///
/// costs[grid.wall(from, Heading::Right)] = 25; // perhaps closed: two more steps are better
/// search.run(&costs, &[target], None);
/// assert_eq!(search.cost(from), Some(30));
/// ```
#[derive(Clone, Debug)]
pub struct WeightedSearch {
    grid: Grid,
    longest_move: u32,
    step_cost: u16,
    cost: Vec<u32>,
    hop: Vec<Hop>,
    /// The cells to go on from, by their cost modulo the number of buckets.
    buckets: Vec<Vec<u16>>,
    waiting: usize,
}

const NOT_REACHED: u32 = u32::MAX;

impl WeightedSearch {
    /// Buffers for hops of up to `longest_move` cells that cost `step_cost` each,
    /// besides the walls.
    ///
    /// # Panics
    ///
    /// When `longest_move` or `step_cost` is 0.
    pub fn new(grid: Grid, longest_move: u32, step_cost: u16) -> Self {
        assert!(longest_move > 0, "the longest move is at least 1 cell");
        assert!(step_cost > 0, "a step costs at least 1");
        let nowhere = Hop {
            heading: Heading::Up,
            cells: 0,
        };
        Self {
            grid,
            longest_move: longest_move.min(grid.dimension()),
            step_cost,
            cost: vec![NOT_REACHED; grid.cell_count()],
            hop: vec![nowhere; grid.cell_count()],
            buckets: Vec::new(),
            waiting: 0,
        }
    }

    /// Computes the cost from every cell to the nearest of `targets`. `costs` has a
    /// value for every wall of the grid, [`IMPASSABLE`] at least for the perimeter.
    ///
    /// With `until`, ends when the cost of that cell is known; cells that are dearer
    /// may then have a cost that is too high, or none.
    ///
    /// # Panics
    ///
    /// When `costs` has another length than the grid has walls.
    pub fn run(&mut self, costs: &[u16], targets: &[usize], until: Option<usize>) {
        assert_eq!(costs.len(), self.grid.wall_count(), "a cost for every wall");
        self.prepare(costs);
        for &target in targets {
            self.reach(target, 0, Heading::Up, 0);
        }
        let mut now = 0;
        while self.waiting > 0 {
            let bucket = self.bucket(now);
            while let Some(cell) = self.buckets[bucket].pop() {
                self.waiting -= 1;
                let cell = usize::from(cell);
                // A cheaper way to this cell has been found since.
                if self.cost[cell] != now {
                    continue;
                }
                if until == Some(cell) {
                    return;
                }
                self.spread(costs, cell, now);
            }
            now += 1;
        }
    }

    /// The cost from a cell to the nearest target; `None` when there is no way.
    #[inline]
    pub fn cost(&self, cell: usize) -> Option<u32> {
        let cost = self.cost[cell];
        (cost != NOT_REACHED).then_some(cost)
    }

    /// The first hop of a cheapest way from a cell; `None` in a target and where
    /// there is no way.
    #[inline]
    pub fn hop(&self, cell: usize) -> Option<Hop> {
        let hop = self.hop[cell];
        (self.cost[cell] != NOT_REACHED && hop.cells > 0).then_some(hop)
    }

    /// A cheapest way from a cell, hop after hop, each with the cell it starts from.
    pub fn way(&self, from: usize) -> impl Iterator<Item = (usize, Hop)> {
        let mut cell = from;
        std::iter::from_fn(move || {
            let hop = self.hop(cell)?;
            let start = cell;
            for _ in 0..hop.cells {
                cell = self.grid.beyond(cell, hop.heading);
            }
            Some((start, hop))
        })
    }

    /// Forgets the last search, and sees that there are more buckets than the
    /// dearest hop costs, so that no two costs share a bucket at any time.
    fn prepare(&mut self, costs: &[u16]) {
        let dearest = costs.iter().filter(|&&it| it != IMPASSABLE).max();
        let dearest = usize::from(dearest.copied().unwrap_or(0));
        let span = usize::from(self.step_cost) + self.longest_move as usize * dearest + 1;
        let buckets = span.next_power_of_two();
        if self.buckets.len() < buckets {
            self.buckets.resize(buckets, Vec::new());
        }
        if self.waiting > 0 {
            self.buckets.iter_mut().for_each(Vec::clear);
            self.waiting = 0;
        }
        self.cost.fill(NOT_REACHED);
    }

    #[inline]
    const fn bucket(&self, cost: u32) -> usize {
        cost as usize & (self.buckets.len() - 1)
    }

    /// Offers a way to every cell that is one hop away.
    fn spread(&mut self, costs: &[u16], cell: usize, cost: u32) {
        for heading in Heading::ALL {
            let mut there = cell;
            let mut sum = cost + u32::from(self.step_cost);
            for cells in 1..=self.longest_move {
                let price = costs[self.grid.wall(there, heading)];
                if price == IMPASSABLE {
                    break;
                }
                sum += u32::from(price);
                there = self.grid.beyond(there, heading);
                if sum < self.cost[there] {
                    self.reach(there, sum, heading.opposite(), cells);
                }
            }
        }
    }

    #[inline]
    fn reach(&mut self, cell: usize, cost: u32, heading: Heading, cells: u32) {
        self.cost[cell] = cost;
        self.hop[cell] = Hop { heading, cells };
        let bucket = self.bucket(cost);
        self.buckets[bucket].push(cell as u16);
        self.waiting += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use crate::{AStar, Cell, CellSet, Passages};

    /// Against A* with the same costs, and again with the same buffers.
    #[test]
    fn agrees_with_a_star() {
        let mut random = Random::new(5);
        for dimension in [2, 7, 12, 64] {
            let grid = Grid::new(dimension);
            let mut search = WeightedSearch::new(grid, 3, 20);
            let mut astar = AStar::new(dimension, 3);
            for round in 0..12 {
                let (passages, costs) = random_costs(grid, &mut random);
                let target = Cell::new(random.below(dimension), random.below(dimension));
                let from = Cell::new(random.below(dimension), random.below(dimension));
                let until = (round % 2 == 0).then_some(grid.cell(from));
                search.run(&costs, &[grid.cell(target)], until);
                let price = |cell: Cell, hop: Hop| Some(hop_cost(grid, &costs, cell, hop));
                let targets = CellSet::from(target);
                let path = astar.path(&passages, from, &targets, price, |_| 0);
                let expected = path.map(|it| it.cost);
                assert_eq!(search.cost(grid.cell(from)), expected);
                if expected.is_some() {
                    let way: Vec<_> = search.way(grid.cell(from)).collect();
                    let cost = |&(at, hop): &(usize, Hop)| hop_cost(grid, &costs, grid.at(at), hop);
                    assert_eq!(way.iter().map(cost).sum::<u32>(), expected.unwrap_or(0));
                }
            }
        }
    }

    fn random_costs(grid: Grid, random: &mut Random) -> (Passages, Vec<u16>) {
        let mut passages = Passages::all_open(grid.dimension());
        let mut costs = vec![IMPASSABLE; grid.wall_count()];
        for wall in grid.inner_walls() {
            let [first, second] = grid.sides(wall);
            let up = second != first + 1;
            let heading = if up { Heading::Up } else { Heading::Right };
            match random.below(4) {
                0 => passages.close(grid.at(first), heading),
                1 => costs[wall] = random.below(300) as u16,
                _ => costs[wall] = 0,
            }
        }
        (passages, costs)
    }

    fn hop_cost(grid: Grid, costs: &[u16], from: Cell, hop: Hop) -> u32 {
        let mut cell = grid.cell(from);
        let mut sum = 20;
        for _ in 0..hop.cells {
            sum += u32::from(costs[grid.wall(cell, hop.heading)]);
            cell = grid.beyond(cell, hop.heading);
        }
        sum
    }

    #[test]
    fn a_walled_in_target() {
        let grid = Grid::new(4);
        let costs = vec![IMPASSABLE; grid.wall_count()];
        let mut search = WeightedSearch::new(grid, 3, 1);
        let cells = [Cell::new(0, 0), Cell::new(1, 1)].map(|it| grid.cell(it));
        search.run(&costs, &cells[..1], None);
        assert_eq!(search.cost(cells[0]), Some(0));
        assert_eq!((search.cost(cells[1]), search.hop(cells[1])), (None, None));
        assert_eq!(search.way(cells[0]).count(), 0);
    }
}
