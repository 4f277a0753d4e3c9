//! Fewest steps from every cell to a set of cells: [`Search`].
//!
//! Breadth first over whole steps: one step drives up to the longest move in a
//! straight line, in any of the four directions (backwards included, so the
//! heading never matters). Layers grow as bits, a row at a time; a search
//! allocates nothing.

use crate::passages::{Bits, ROWS, row};
use crate::{Cell, CellSet, Heading, Passages};

/// A drive in a straight line, in one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Hop {
    /// The direction of travel, in the maze.
    pub heading: Heading,
    /// How far, in cells, at least 1.
    pub cells: u32,
}

/// Distances in steps to a set of cells, with reusable buffers.
///
/// Because every step can also be driven back, distances to a cell are distances
/// from it too.
///
/// ```
/// use wasmouse_sdk::{Cell, CellSet, Heading, Hop, Map, Search, View};
///
/// let map = Map::new(12);
/// let passages = map.passages(View::Optimistic);
/// let mut search = Search::new(12, 3);
/// search.fill(passages, &CellSet::from(Cell::new(5, 0)));
/// assert_eq!(search.steps(Cell::new(0, 0)), Some(2));
/// let hops: Vec<Hop> = search.route(passages, Cell::new(0, 0)).collect();
/// let right = Heading::Right;
/// assert_eq!(hops, [Hop { heading: right, cells: 3 }, Hop { heading: right, cells: 2 }]);
/// ```
#[derive(Clone, Debug)]
pub struct Search {
    dimension: u32,
    longest_move: u32,
    reached: [u64; ROWS],
    frontier: [u64; ROWS],
    next: [u64; ROWS],
    /// Steps, by row * 64 + column; valid where `reached` says so.
    steps: Box<[u16]>,
}

impl Search {
    /// Buffers for mazes of this dimension, for steps of up to `longest_move`
    /// cells. Nothing is reached yet.
    ///
    /// # Panics
    ///
    /// When `dimension` is outside 2..=64 or `longest_move` is 0.
    pub fn new(dimension: u32, longest_move: u32) -> Self {
        assert!(
            (2..=ROWS as u32).contains(&dimension),
            "the dimension is outside 2..=64"
        );
        assert!(longest_move > 0, "the longest move is at least 1 cell");
        Self {
            dimension,
            longest_move,
            reached: [0; ROWS],
            frontier: [0; ROWS],
            next: [0; ROWS],
            steps: vec![0; dimension as usize * ROWS].into(),
        }
    }

    /// Computes the distance of every cell to the nearest of `targets`.
    pub fn fill(&mut self, passages: &Passages, targets: &CellSet) {
        self.search(passages, targets, None);
    }

    /// Like [`fill`](Self::fill), but stops when the distance of `from` is known.
    /// Then all cells that are nearer are known too, and those that are as far;
    /// others are not, or count as not reached.
    pub fn fill_until(&mut self, passages: &Passages, targets: &CellSet, from: Cell) {
        self.search(passages, targets, Some(from));
    }

    /// Steps from `cell` to the nearest target; `None` when the last search did
    /// not reach it.
    #[inline]
    pub fn steps(&self, cell: Cell) -> Option<u32> {
        let inside = cell.x < self.dimension && cell.y < self.dimension;
        let reached = inside && self.reached[row(cell.y)] >> cell.x & 1 != 0;
        reached.then(|| u32::from(self.steps[place(cell)]))
    }

    /// All hops from `cell` that bring it one step nearer to a target, through the
    /// passages of the last search: clockwise from up, the longest first.
    pub fn hops<'a>(
        &'a self,
        passages: &'a Passages,
        cell: Cell,
    ) -> impl Iterator<Item = Hop> + use<'a> {
        let goal = self.steps(cell).and_then(|steps| steps.checked_sub(1));
        Heading::ALL.into_iter().flat_map(move |heading| {
            let clear = match goal {
                Some(_) => passages.clear_cells(cell, heading, self.longest_move),
                None => 0,
            };
            (1..=clear).rev().filter_map(move |cells| {
                let there = cell.toward(heading, cells)?;
                (self.steps(there) == goal).then_some(Hop { heading, cells })
            })
        })
    }

    /// The longest hop nearer to a target in the first of these directions that
    /// has one. The order decides between routes of equal length.
    pub fn hop_toward(
        &self,
        passages: &Passages,
        cell: Cell,
        order: impl IntoIterator<Item = Heading>,
    ) -> Option<Hop> {
        let goal = self.steps(cell)?.checked_sub(1)?;
        order.into_iter().find_map(|heading| {
            let clear = passages.clear_cells(cell, heading, self.longest_move);
            let longest = (1..=clear).rev().find(|&cells| {
                let there = cell.toward(heading, cells);
                there.and_then(|it| self.steps(it)) == Some(goal)
            });
            longest.map(|cells| Hop { heading, cells })
        })
    }

    /// A shortest route from `cell` to a target, hop by hop; empty when there is
    /// none or the cell is a target. Prefers to go on straight, then clockwise.
    pub fn route<'a>(
        &'a self,
        passages: &'a Passages,
        cell: Cell,
    ) -> impl Iterator<Item = Hop> + use<'a> {
        let mut at = cell;
        let mut straight = Heading::Up;
        std::iter::from_fn(move || {
            let order = (0..4).map(|quarters| Heading::ALL[(straight as usize + quarters) & 3]);
            let hop = self.hop_toward(passages, at, order)?;
            at = at.toward(hop.heading, hop.cells)?;
            straight = hop.heading;
            Some(hop)
        })
    }

    fn search(&mut self, passages: &Passages, targets: &CellSet, from: Option<Cell>) {
        assert_eq!(
            passages.dimension, self.dimension,
            "the passages are of another dimension"
        );
        let rows = self.dimension as usize;
        self.reached[..rows].fill(0);
        self.next[..rows].copy_from_slice(&targets.rows[..rows]);
        let stop = from.map(|cell| (row(cell.y), 1_u64 << (cell.x & 63)));
        let mut steps = 0;
        while self.settle(steps) {
            if stop.is_some_and(|(row, bit)| self.reached[row] & bit != 0) {
                break;
            }
            self.spread(passages);
            steps += 1;
        }
    }

    /// Makes the new cells of `next` the frontier, `steps` away, and empties
    /// `next`. Says whether there were any.
    fn settle(&mut self, steps: u16) -> bool {
        let mut any = 0;
        let rows = self.dimension as usize;
        let columns = u64::MAX >> (ROWS - rows);
        let distances = self.steps.chunks_exact_mut(ROWS);
        let boards = self.reached[..rows]
            .iter_mut()
            .zip(&mut self.next[..rows])
            .zip(&mut self.frontier[..rows]);
        for (((reached, next), frontier), distances) in boards.zip(distances) {
            let new = *next & !*reached & columns;
            *next = 0;
            *frontier = new;
            *reached |= new;
            any |= new;
            for x in Bits(new) {
                distances[x as usize & (ROWS - 1)] = steps;
            }
        }
        any != 0
    }

    /// Adds to `next` every cell one step away from the frontier.
    fn spread(&mut self, passages: &Passages) {
        for y in 0..self.dimension {
            let cells = self.frontier[row(y)];
            if cells == 0 {
                continue;
            }
            self.spread_sideways(passages.right[row(y)], cells, y);
            self.spread_up(&passages.up, cells, y);
            self.spread_down(&passages.up, cells, y);
        }
    }

    #[inline]
    fn spread_sideways(&mut self, open: u64, cells: u64, y: u32) {
        let (mut right, mut left, mut both) = (cells, cells, 0);
        for _ in 0..self.longest_move {
            right = (right & open) << 1;
            left = left >> 1 & open;
            if right | left == 0 {
                break;
            }
            both |= right | left;
        }
        self.next[row(y)] |= both;
    }

    #[inline]
    fn spread_up(&mut self, open: &[u64; ROWS], mut cells: u64, y: u32) {
        // The perimeter is closed, so `cells` is empty before the rows run out.
        for above in y..y.saturating_add(self.longest_move) {
            cells &= open[row(above)];
            if cells == 0 {
                break;
            }
            self.next[row(above + 1)] |= cells;
        }
    }

    #[inline]
    fn spread_down(&mut self, open: &[u64; ROWS], mut cells: u64, y: u32) {
        for below in (0..y).rev().take(self.longest_move as usize) {
            cells &= open[row(below)];
            if cells == 0 {
                break;
            }
            self.next[row(below)] |= cells;
        }
    }
}

#[inline]
const fn place(cell: Cell) -> usize {
    cell.y as usize * ROWS + cell.x as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use crate::{Area, Map, View};
    use std::collections::VecDeque;

    /// The plain way: a queue of cells.
    fn by_queue(passages: &Passages, targets: &CellSet, longest: u32) -> Vec<Option<u32>> {
        let dimension = passages.dimension;
        let place = |cell: Cell| (cell.x * dimension + cell.y) as usize;
        let mut steps = vec![None; (dimension * dimension) as usize];
        let mut queue: VecDeque<Cell> = targets.iter().collect();
        targets.iter().for_each(|it| steps[place(it)] = Some(0));
        while let Some(cell) = queue.pop_front() {
            for heading in Heading::ALL {
                for cells in 1..=passages.clear_cells(cell, heading, longest) {
                    let there = cell.toward(heading, cells).expect("clear");
                    if steps[place(there)].is_none() {
                        steps[place(there)] = steps[place(cell)].map(|it: u32| it + 1);
                        queue.push_back(there);
                    }
                }
            }
        }
        steps
    }

    fn random_passages(dimension: u32, random: &mut Random, share: u32) -> Passages {
        let mut passages = Passages::all_open(dimension);
        for cell in Area::new(Cell::new(0, 0), dimension, dimension).cells() {
            for heading in [Heading::Up, Heading::Right] {
                if random.below(100) < share {
                    passages.close(cell, heading);
                }
            }
        }
        passages
    }

    #[test]
    fn agrees_with_a_queue() {
        let mut random = Random::new(7);
        for round in 0..300 {
            let dimension = [2, 3, 7, 12, 16, 33, 63, 64][round % 8];
            let longest = [1, 2, 3, 7, 100][round % 5];
            let share = random.below(70);
            let passages = random_passages(dimension, &mut random, share);
            let cell = Cell::new(random.below(dimension), random.below(dimension));
            let mut targets = CellSet::from(cell);
            targets.insert(Cell::new(random.below(dimension), 0));
            let mut search = Search::new(dimension, longest);
            search.fill(&passages, &targets);
            let expected = by_queue(&passages, &targets, longest);
            for cell in Area::new(Cell::new(0, 0), dimension, dimension).cells() {
                let steps = expected[(cell.x * dimension + cell.y) as usize];
                assert_eq!(search.steps(cell), steps, "round {round}");
                check_route(&search, &passages, &targets, cell);
            }
        }
    }

    fn check_route(search: &Search, passages: &Passages, targets: &CellSet, from: Cell) {
        let Some(steps) = search.steps(from) else {
            assert_eq!(search.route(passages, from).count(), 0);
            return;
        };
        let hops: Vec<Hop> = search.route(passages, from).collect();
        assert_eq!(hops.len() as u32, steps);
        assert_eq!(steps > 0, search.hops(passages, from).next().is_some());
        let end = hops.iter().fold(from, |at, hop| {
            assert_eq!(passages.clear_cells(at, hop.heading, hop.cells), hop.cells);
            at.toward(hop.heading, hop.cells).expect("clear")
        });
        assert!(targets.contains(end));
    }

    #[test]
    fn stopping_early_gives_the_same_route_length() {
        let mut random = Random::new(8);
        for _ in 0..100 {
            let passages = random_passages(16, &mut random, 30);
            let targets = CellSet::from(Area::center(16));
            let mut full = Search::new(16, 3);
            let mut early = full.clone();
            full.fill(&passages, &targets);
            early.fill_until(&passages, &targets, Cell::new(0, 0));
            assert_eq!(full.steps(Cell::new(0, 0)), early.steps(Cell::new(0, 0)));
            check_route(&early, &passages, &targets, Cell::new(0, 0));
        }
    }

    #[test]
    fn a_cell_outside_is_not_reached() {
        let map = Map::new(2);
        let mut search = Search::new(2, 3);
        search.fill(
            map.passages(View::Optimistic),
            &CellSet::from(Cell::new(9, 9)),
        );
        assert_eq!(search.steps(Cell::new(0, 0)), None);
        assert_eq!(search.steps(Cell::new(9, 9)), None);
    }
}
