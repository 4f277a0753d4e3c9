//! The fewest steps from every cell to a set of cells: [`Search`].
//!
//! A breadth-first search over steps: one step drives up to the longest move in a straight
//! line, in any of the four directions (including backwards, so the heading does not
//! matter). Cells are bits, so it processes a row at a time; a search allocates nothing.

use super::packed::{self, Board};
use crate::geometry::DIMENSION_MAX;
use crate::passages::{Bits, ROWS, bit, row};
use crate::{Cell, CellSet, Heading, Hop, Passages, Pose, Turn};

/// Distances in steps to a set of cells, with reusable buffers.
///
/// Every step can also be driven in reverse, so distances to a cell are distances from it,
/// too.
///
/// ```
/// use wasmouse_sdk::{Cell, CellSet, Heading, Hop, Map, Pose, Search, View};
///
/// let map = Map::new(12);
/// let passages = map.passages(View::Optimistic);
/// let mut search = Search::new(12, 3);
/// search.fill(passages, &CellSet::from(Cell::new(5, 0)));
/// assert_eq!(search.steps(Cell::new(0, 0)), Some(2));
/// let start = Pose::at_start(Cell::new(0, 0));
/// let hops: Vec<Hop> = search.route(passages, start).collect();
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

    /// Like [`fill`](Self::fill), but stops when the distance of `from` is known. All cells
    /// at most as far as `from` are known then; the others may count as not reached.
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

    /// A shortest route to a target for a robot in this pose, hop by hop; empty if there is
    /// none or the robot is in a target.
    ///
    /// Between routes of equal length it prefers to drive straight, then right, left,
    /// backwards; then longer hops to shorter ones.
    ///
    /// `passages` are those of the last search, or fewer: see
    /// [`first_hop`](Self::first_hop).
    pub fn route<'a>(
        &'a self,
        passages: &'a Passages,
        pose: Pose,
    ) -> impl Iterator<Item = Hop> + use<'a> {
        let mut at = pose;
        std::iter::from_fn(move || {
            let hop = self.preferred_hop(passages, at)?;
            at = at.hopped(hop)?;
            Some(hop)
        })
    }

    /// The first hop of [`route`](Self::route), provided that the whole route still
    /// leads to a target.
    ///
    /// Closing walls makes no route shorter. So as long as `passages` are those of the last
    /// search with more walls closed, a route that is still open is still a shortest one, and
    /// there is no need to search again. `None` means that a new search is needed, or that
    /// there is no route.
    pub fn first_hop(&self, passages: &Passages, pose: Pose) -> Option<Hop> {
        let steps = self.steps(pose.cell)? as usize;
        let mut route = self.route(passages, pose);
        let first = route.next()?;
        (route.count() + 1 == steps).then_some(first)
    }

    /// The first hop of a shortest route to a target. Uses
    /// [`first_hop`](Self::first_hop) of the last search if that route is still open, and
    /// searches again otherwise. `None` if there is no path, or if the robot is in a target.
    ///
    /// For a robot that drives to one set of targets: call it once per step, with the same
    /// targets, and with passages of which none opens in the meantime.
    ///
    /// ```
    /// use wasmouse_sdk::{Cell, CellSet, Heading, Hop, Map, Pose, Search, View, Wall};
    ///
    /// let mut map = Map::new(12);
    /// let (targets, pose) = (CellSet::from(Cell::new(0, 5)), Pose::at_start(Cell::new(0, 0)));
    /// let mut search = Search::new(12, 3);
    /// let hop = search.next_hop(map.passages(View::Optimistic), &targets, pose);
    /// assert_eq!(hop, Some(Hop { heading: Heading::Up, cells: 3 }));
    /// map.set(Cell::new(0, 0), Heading::Up, Wall::Closed);
    /// let hop = search.next_hop(map.passages(View::Optimistic), &targets, pose);
    /// assert_eq!(hop.map(|it| it.heading), Some(Heading::Right));
    /// ```
    pub fn next_hop(&mut self, passages: &Passages, targets: &CellSet, pose: Pose) -> Option<Hop> {
        self.first_hop(passages, pose).or_else(|| {
            self.fill_until(passages, targets, pose.cell);
            self.route(passages, pose).next()
        })
    }

    fn preferred_hop(&self, passages: &Passages, pose: Pose) -> Option<Hop> {
        let goal = self.steps(pose.cell)?.checked_sub(1)?;
        let ahead = pose.heading;
        let order = [
            ahead,
            ahead.turned(Turn::Right),
            ahead.turned(Turn::Left),
            ahead.opposite(),
        ];
        order.into_iter().find_map(|heading| {
            let cells = self.longest_hop(passages, pose.cell, heading, goal)?;
            Some(Hop { heading, cells })
        })
    }

    /// The longest drive in that direction that ends `goal` steps from a target.
    fn longest_hop(
        &self,
        passages: &Passages,
        from: Cell,
        heading: Heading,
        goal: u32,
    ) -> Option<u32> {
        let mut at = from;
        let mut longest = None;
        for cells in 1..=self.longest_move {
            if !passages.is_open(at, heading) {
                break;
            }
            at = at.toward(heading, 1)?;
            if self.steps(at) == Some(goal) {
                longest = Some(cells);
            }
        }
        longest
    }

    fn search(&mut self, passages: &Passages, targets: &CellSet, from: Option<Cell>) {
        assert_eq!(
            passages.dimension, self.dimension,
            "the passages are of another dimension"
        );
        if self.dimension <= packed::DIMENSION_MAX {
            self.search_packed(passages, targets, from);
        } else {
            self.search_rows(passages, targets, from);
        }
    }

    fn search_packed(&mut self, passages: &Passages, targets: &CellSet, from: Option<Cell>) {
        let walls = packed::Walls {
            right: Board::pack(&passages.right),
            up: Board::pack(&passages.up),
        };
        let columns = u64::MAX >> (DIMENSION_MAX - self.dimension);
        let mut rows = [0; ROWS];
        for y in 0..self.dimension {
            rows[row(y)] = targets.rows[row(y)] & columns;
        }
        let targets = Board::pack(&rows);
        let stop = from.map_or(CellSet::new(), CellSet::from);
        let stop = Board::pack(&stop.rows);
        let distances = &mut self.steps;
        let visit = |x, y, steps| distances[y * ROWS + x] = steps;
        let reached = packed::spread(&walls, targets, stop, self.longest_move, visit);
        reached.unpack(&mut self.reached);
    }

    fn search_rows(&mut self, passages: &Passages, targets: &CellSet, from: Option<Cell>) {
        let columns = u64::MAX >> (DIMENSION_MAX - self.dimension);
        for y in 0..self.dimension {
            self.reached[row(y)] = 0;
            self.next[row(y)] = targets.rows[row(y)] & columns;
        }
        // Most rows of most layers are empty, so both halves of a layer only visit
        // the rows, as bits, that the other has written.
        let mut touched = columns;
        let mut steps = 0;
        loop {
            let frontier_rows = self.settle(touched, steps);
            if frontier_rows == 0 || from.is_some_and(|it| self.steps(it).is_some()) {
                return;
            }
            // The usual longest move is a constant, so that its loops are unrolled.
            touched = match self.longest_move {
                3 => self.spread(passages, frontier_rows, 3),
                longest => self.spread(passages, frontier_rows, longest),
            };
            steps += 1;
        }
    }

    /// Makes the new cells of `next` the frontier, `steps` away, and empties
    /// `next`. Returns the rows of the frontier.
    fn settle(&mut self, touched: u64, steps: u16) -> u64 {
        let mut rows = 0;
        for y in Bits(touched) {
            let new = self.next[row(y)] & !self.reached[row(y)];
            self.next[row(y)] = 0;
            if new == 0 {
                continue;
            }
            rows |= bit(y);
            self.frontier[row(y)] = new;
            self.reached[row(y)] |= new;
            let first = y as usize * ROWS;
            let distances = &mut self.steps[first..first + ROWS];
            for x in Bits(new) {
                distances[row(x)] = steps;
            }
        }
        rows
    }

    /// Adds to `next` every cell one step away from the frontier. Returns the rows
    /// it has written.
    #[inline]
    fn spread(&mut self, passages: &Passages, frontier_rows: u64, longest: u32) -> u64 {
        let mut touched = frontier_rows;
        for y in Bits(frontier_rows) {
            let cells = self.frontier[row(y)];
            self.next[row(y)] |= sideways(passages.right[row(y)], cells, longest);
            touched |= self.spread_up(&passages.up, cells, y, longest);
            touched |= self.spread_down(&passages.up, cells, y, longest);
        }
        touched
    }

    #[inline]
    fn spread_up(&mut self, open: &[u64; ROWS], mut cells: u64, y: u32, longest: u32) -> u64 {
        let mut touched = 0;
        for distance in 0..longest {
            let below = y.wrapping_add(distance);
            // The perimeter is closed, so this ends before the rows run out.
            cells &= open[row(below)];
            if cells == 0 {
                break;
            }
            self.next[row(below + 1)] |= cells;
            touched |= bit(below + 1);
        }
        touched
    }

    #[inline]
    fn spread_down(&mut self, open: &[u64; ROWS], mut cells: u64, y: u32, longest: u32) -> u64 {
        let mut touched = 0;
        for distance in 1..=longest {
            // Below row 0 this wraps around to a row of the perimeter or beyond the
            // maze, whose walls are closed.
            let below = y.wrapping_sub(distance);
            cells &= open[row(below)];
            if cells == 0 {
                break;
            }
            self.next[row(below)] |= cells;
            touched |= bit(below);
        }
        touched
    }
}

#[inline]
fn sideways(open: u64, cells: u64, longest: u32) -> u64 {
    let (mut right, mut left, mut both) = (cells, cells, 0);
    for _ in 0..longest {
        right = (right & open) << 1;
        left = (left >> 1) & open;
        if right | left == 0 {
            break;
        }
        both |= right | left;
    }
    both
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
            assert_eq!(search.route(passages, Pose::at_start(from)).count(), 0);
            return;
        };
        let hops: Vec<Hop> = search.route(passages, Pose::at_start(from)).collect();
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

    /// While `first_hop` answers, following it is as short as searching again.
    #[test]
    fn an_old_search_stays_true_while_its_route_is_whole() {
        let mut random = Random::new(9);
        let (mut whole, mut broken) = (0, 0);
        for _ in 0..400 {
            let mut passages = random_passages(16, &mut random, 20);
            let targets = CellSet::from(Area::center(16));
            let pose = Pose::at_start(Cell::new(0, 0));
            let mut old = Search::new(16, 3);
            old.fill_until(&passages, &targets, pose.cell);
            for _ in 0..20 {
                let cell = Cell::new(random.below(16), random.below(16));
                passages.close(cell, Heading::ALL[random.below(4) as usize]);
            }
            let mut new = old.clone();
            new.fill_until(&passages, &targets, pose.cell);
            match old.first_hop(&passages, pose) {
                Some(hop) => {
                    let after = pose.hopped(hop).expect("inside");
                    assert_eq!(old.steps(pose.cell), new.steps(pose.cell));
                    assert_eq!(new.steps(after.cell), new.steps(pose.cell).map(|it| it - 1));
                    whole += 1;
                }
                None => broken += 1,
            }
        }
        assert!(whole > 50 && broken > 50, "{whole} whole, {broken} broken");
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
