//! One cheap way, found fast: [`GuidedSearch`].
//!
//! For robots that imagine matches: each time an imagined wall bars the way they need
//! another one, thousands of times a decision, and little has changed since
//! [`WeightedSearch`] last looked at the whole maze. Its costs lead this search to the
//! goal past most cells (A*; Hart, Nilsson and Raphael, *A Formal Basis for the
//! Heuristic Determination of Minimum Cost Paths*, 1968), and each search makes them
//! better for the next one, which need not walk into the same dead ends (Koenig and
//! Likhachev, *A New Principle for Incremental Heuristic Search: Theoretical Results*,
//! 2006).

use crate::{Grid, Heading, Hop, IMPASSABLE, WeightedSearch};

/// A cheap way from a cell to a target, with reusable buffers.
///
/// ```
/// use wasmouse_sdk::{Cell, Grid, GuidedSearch, Heading, IMPASSABLE, WeightedSearch};
///
/// let grid = Grid::new(4);
/// let mut costs = vec![IMPASSABLE; grid.wall_count()];
/// grid.inner_walls().for_each(|wall| costs[wall] = 0);
/// let (from, target) = (grid.cell(Cell::new(0, 0)), grid.cell(Cell::new(3, 0)));
/// let mut whole = WeightedSearch::new(grid, 3, 10);
/// whole.run(&costs, &[target], None);
///
/// costs[grid.wall(from, Heading::Right)] = IMPASSABLE; // just seen
/// let mut search = GuidedSearch::new(grid, 3, 10);
/// search.begin(&whole);
/// assert!(search.run(&costs, from));
/// // Up, to the right and down again, as far up as it likes.
/// let headings: Vec<Heading> = search.way().map(|(_, hop)| hop.heading).collect();
/// assert_eq!(headings, [Heading::Up, Heading::Right, Heading::Down]);
/// ```
#[derive(Clone, Debug)]
pub struct GuidedSearch {
    grid: Grid,
    longest_move: u32,
    step_cost: u16,
    /// What the way from a cell to a target is believed to cost; `u32::MAX` for none.
    rest: Vec<u32>,
    /// What the way to a cell costs so far; [`DONE`] is set once it has been gone on
    /// from.
    cost: Vec<u32>,
    /// The hop by which a cell was reached.
    hop: Vec<Hop>,
    /// The cells to go on from, by cost and guessed rest modulo the number of buckets.
    buckets: Vec<Vec<u16>>,
    waiting: usize,
    /// The cells that have been gone on from.
    done: Vec<u16>,
    /// What is left of the way, the last hop first.
    way: Vec<(usize, Hop)>,
}

const DONE: u32 = 1 << 31;
const NOT_REACHED: u32 = DONE - 1;

impl GuidedSearch {
    /// Buffers for hops of up to `longest_move` cells that cost `step_cost` each,
    /// besides the walls; the same as those of the guide.
    pub fn new(grid: Grid, longest_move: u32, step_cost: u16) -> Self {
        let nowhere = Hop {
            heading: Heading::Up,
            cells: 0,
        };
        Self {
            grid,
            longest_move: longest_move.min(grid.dimension()),
            step_cost,
            rest: vec![u32::MAX; grid.cell_count()],
            cost: vec![NOT_REACHED; grid.cell_count()],
            hop: vec![nowhere; grid.cell_count()],
            buckets: Vec::new(),
            waiting: 0,
            done: Vec::new(),
            way: Vec::new(),
        }
    }

    /// Believes from now on what a guide says, which has searched the whole maze, and
    /// forgets what earlier searches have taught.
    ///
    /// # Panics
    ///
    /// When the guide's grid is another one.
    pub fn begin(&mut self, guide: &WeightedSearch) {
        guide.copy_costs(&mut self.rest);
        // A hop can cost that much, and lead as much away from the target.
        let buckets = 2 * guide.bucket_count();
        if self.buckets.len() < buckets {
            self.buckets.resize(buckets, Vec::new());
        }
    }

    /// Looks for a way from a cell to a target of the guide; whether there is one.
    ///
    /// The costs are those of the guide, but for walls that have changed since it
    /// searched. The way is cheap but not always the cheapest: a wall that has become
    /// cheaper is not looked for, and no cell is gone on from twice. It is the cheapest
    /// as long as no wall has become cheaper.
    ///
    /// # Panics
    ///
    /// When `costs` is shorter than the grid has walls, and before [`begin`](Self::begin).
    pub fn run(&mut self, costs: &[u16], from: usize) -> bool {
        self.forget();
        let mut now = self.rest[from];
        if now == u32::MAX {
            return false;
        }
        self.cost[from] = 0;
        self.wait(from, now);
        while self.waiting > 0 {
            let bucket = self.bucket(now);
            while let Some(cell) = self.buckets[bucket].pop() {
                self.waiting -= 1;
                let cell = usize::from(cell);
                let cost = self.cost[cell];
                if cost & DONE != 0 {
                    continue;
                }
                if self.rest[cell] == 0 {
                    self.trace(from, cell);
                    self.learn(cost);
                    return true;
                }
                self.cost[cell] = cost | DONE;
                self.done.push(cell as u16);
                self.spread(costs, cell, cost, now);
            }
            now += 1;
        }
        false
    }

    /// What is left of the way, hop after hop, each with the cell it starts from.
    pub fn way(&self) -> impl Iterator<Item = (usize, Hop)> {
        self.way.iter().rev().copied()
    }

    /// Takes the next hop off the way.
    pub fn advance(&mut self) -> Option<Hop> {
        self.way.pop().map(|(_, hop)| hop)
    }

    fn forget(&mut self) {
        self.way.clear();
        self.done.clear();
        if self.waiting > 0 {
            self.buckets.iter_mut().for_each(Vec::clear);
            self.waiting = 0;
        }
        self.cost.fill(NOT_REACHED);
    }

    /// From a cell that was gone on from, the way cannot be cheaper than what the whole
    /// way costs beyond it.
    fn learn(&mut self, whole: u32) {
        for &cell in &self.done {
            let cell = usize::from(cell);
            let beyond = whole.saturating_sub(self.cost[cell] & !DONE);
            self.rest[cell] = self.rest[cell].max(beyond);
        }
    }

    #[inline]
    const fn bucket(&self, cost: u32) -> usize {
        cost as usize & (self.buckets.len() - 1)
    }

    #[inline]
    fn wait(&mut self, cell: usize, cost: u32) {
        let bucket = self.bucket(cost);
        self.buckets[bucket].push(cell as u16);
        self.waiting += 1;
    }

    /// Goes on from a cell in all directions.
    fn spread(&mut self, costs: &[u16], cell: usize, cost: u32, now: u32) {
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
                let known = self.cost[there];
                if known & DONE != 0 || known <= sum {
                    continue;
                }
                let rest = self.rest[there];
                if rest != u32::MAX {
                    self.cost[there] = sum;
                    self.hop[there] = Hop { heading, cells };
                    self.wait(there, (sum + rest).max(now));
                }
            }
        }
    }

    /// Notes the way backwards.
    fn trace(&mut self, from: usize, target: usize) {
        let mut cell = target;
        while cell != from {
            let hop = self.hop[cell];
            for _ in 0..hop.cells {
                cell = self.grid.beyond(cell, hop.heading.opposite());
            }
            self.way.push((cell, hop));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Cell;
    use crate::random::Random;

    /// After walls have been closed, against a whole search; again and again with the
    /// same buffers.
    #[test]
    fn finds_the_cheapest_way_past_new_walls() {
        let mut random = Random::new(11);
        for dimension in [2, 7, 12, 20] {
            let grid = Grid::new(dimension);
            let walls: Vec<usize> = grid.inner_walls().collect();
            let mut guide = WeightedSearch::new(grid, 3, 20);
            let mut fresh = WeightedSearch::new(grid, 3, 20);
            let mut search = GuidedSearch::new(grid, 3, 20);
            for _ in 0..30 {
                let mut costs = vec![IMPASSABLE; grid.wall_count()];
                for &wall in &walls {
                    costs[wall] = random.below(100) as u16;
                }
                let mut any =
                    || grid.cell(Cell::new(random.below(dimension), random.below(dimension)));
                let (from, target) = (any(), any());
                guide.run(&costs, &[target], None);
                search.begin(&guide);
                for _ in 0..4 {
                    for _ in 0..random.below(walls.len() as u32 / 4 + 1) {
                        costs[walls[random.below(walls.len() as u32) as usize]] = IMPASSABLE;
                    }
                    fresh.run(&costs, &[target], None);
                    assert_eq!(search.run(&costs, from), fresh.cost(from).is_some());
                    if let Some(expected) = fresh.cost(from) {
                        let mut cell = from;
                        let mut sum = 0;
                        for (start, hop) in search.way() {
                            assert_eq!(start, cell);
                            sum += 20;
                            for _ in 0..hop.cells {
                                sum += u32::from(costs[grid.wall(cell, hop.heading)]);
                                cell = grid.beyond(cell, hop.heading);
                            }
                        }
                        assert_eq!((cell, sum), (target, expected));
                    }
                }
            }
        }
    }
}
