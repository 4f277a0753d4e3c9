//! Cheapest paths to the goal when walls have costs: [`WeightedSearch`].
//!
//! Where [`Search`](crate::Search) counts steps, here a step has a fixed cost and every
//! wall that it crosses adds one of its own, for instance for the chance that it is
//! closed. One search answers for all cells. Costs are small whole numbers, so cells wait
//! in buckets instead of a heap (Dial, *Algorithm 360: Shortest-Path Forest with
//! Topological Ordering*, 1969).

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
    /// The cells to expand next, by their cost modulo the number of buckets.
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
    /// value forevery wall of the grid, [`IMPASSABLE`] at least for the perimeter.
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
                // A cheaper path to this cell has been found since.
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

    /// The cost from a cell to the nearest target; `None` when there is no path.
    #[inline]
    pub fn cost(&self, cell: usize) -> Option<u32> {
        let cost = self.cost[cell];
        (cost != NOT_REACHED).then_some(cost)
    }

    /// The first hop of a cheapest path from a cell; `None` in a target and where
    /// there is no path.
    #[inline]
    pub fn hop(&self, cell: usize) -> Option<Hop> {
        let hop = self.hop[cell];
        (self.cost[cell] != NOT_REACHED && hop.cells > 0).then_some(hop)
    }

    /// A cheapest path from a cell, hop by hop, each with the cell where it starts.
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

    /// Offers a path to every cell that is one hop away.
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
    use crate::Cell;
    use crate::random::Random;

    const STEP_COST: u16 = 20;

    /// Against repeated relaxation, and again with the same buffers.
    #[test]
    fn costs_are_the_least() {
        let mut random = Random::new(5);
        for dimension in [2, 7, 12, 64] {
            let grid = Grid::new(dimension);
            let mut search = WeightedSearch::new(grid, 3, STEP_COST);
            for round in 0..12 {
                let costs = random_costs(grid, &mut random);
                let mut cell =
                    || grid.cell(Cell::new(random.below(dimension), random.below(dimension)));
                let (target, from) = (cell(), cell());
                let until = (round % 2 == 0).then_some(from);
                search.run(&costs, &[target], until);
                let expected = least_costs(grid, &costs, target)[from];
                assert_eq!(search.cost(from), expected);
                if let Some(expected) = expected {
                    let mut end = from;
                    let mut sum = 0;
                    for (at, hop) in search.way(from) {
                        assert_eq!(at, end);
                        let cost;
                        (end, cost) = after(grid, &costs, at, hop).expect("no wall is in its way");
                        sum += cost;
                    }
                    assert_eq!((end, sum), (target, expected));
                }
            }
        }
    }

    fn random_costs(grid: Grid, random: &mut Random) -> Vec<u16> {
        let mut costs = vec![IMPASSABLE; grid.wall_count()];
        for wall in grid.inner_walls() {
            match random.below(4) {
                0 => {}
                1 => costs[wall] = random.below(300) as u16,
                _ => costs[wall] = 0,
            }
        }
        costs
    }

    /// Where a hop ends and what it costs; `None` when a wall is in its way.
    fn after(grid: Grid, costs: &[u16], from: usize, hop: Hop) -> Option<(usize, u32)> {
        let mut cell = from;
        let mut sum = u32::from(STEP_COST);
        for _ in 0..hop.cells {
            let cost = costs[grid.wall(cell, hop.heading)];
            if cost == IMPASSABLE {
                return None;
            }
            sum += u32::from(cost);
            cell = grid.beyond(cell, hop.heading);
        }
        Some((cell, sum))
    }

    /// The least cost from every cell to the target, improved until nothing changes.
    fn least_costs(grid: Grid, costs: &[u16], target: usize) -> Vec<Option<u32>> {
        let side = 0..grid.dimension();
        let cells = side
            .clone()
            .flat_map(|y| side.clone().map(move |x| Cell::new(x, y)));
        let hops: Vec<(usize, usize, u32)> = cells
            .map(|cell| grid.cell(cell))
            .flat_map(|from| {
                let hops = Heading::ALL
                    .into_iter()
                    .flat_map(|heading| (1..=3).map(move |cells| Hop { heading, cells }));
                hops.filter_map(move |hop| {
                    let (to, cost) = after(grid, costs, from, hop)?;
                    Some((from, to, cost))
                })
            })
            .collect();
        let mut least = vec![None; grid.cell_count()];
        least[target] = Some(0);
        loop {
            let mut has_changed = false;
            for &(from, to, cost) in &hops {
                let Some(rest) = least[to] else { continue };
                if least[from].is_none_or(|known: u32| known > rest + cost) {
                    least[from] = Some(rest + cost);
                    has_changed = true;
                }
            }
            if !has_changed {
                return least;
            }
        }
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
