//! A path found by counting squares: [`Expansion`].
//!
//! The search of simple maze robots: squares are opened one after the other, each gets the
//! next number, and the path is built backwards from the target, always to a smaller number.
//! It does not count steps and does not guarantee a shortest path; use
//! [`Search`](crate::Search) or [`WeightedSearch`](crate::WeightedSearch) for that. The robots
//! of Lobato's report (2016) use it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::geometry::DIMENSION_MAX;
use crate::{Cell, CellSet, Heading, Hop};

/// The order in which neighbours are opened and the smallest number is looked for:
/// counterclockwise from up.
const ORDER: [Heading; 4] = [Heading::Up, Heading::Left, Heading::Down, Heading::Right];

/// The number of a square that has not been opened.
const CLOSED: u16 = u16::MAX;

/// Numbers for every square, with reusable buffers.
///
/// ```
/// use wasmouse_sdk::{Cell, CellSet, Expansion, Heading, Hop, Map, View};
///
/// let map = Map::new(12);
/// let passages = map.passages(View::Optimistic);
/// let is_open = |cell, side| passages.is_open(cell, side);
/// let (from, target) = (Cell::new(0, 0), Cell::new(3, 1));
/// let targets = CellSet::from(target);
/// let mut expansion = Expansion::new(12);
///
/// // All ranks are equal, so the first square opened is expanded first: breadth first.
/// let hop = expansion.first_hop(is_open, from, &targets, |_, _| 0);
/// assert_eq!(hop, Some(Hop { heading: Heading::Up, cells: 1 }));
///
/// // The path so far plus an estimate of the rest make it A*.
/// let hop = expansion.first_hop(is_open, from, &targets, |cell, walked| {
///     u64::from(walked + cell.manhattan(target))
/// });
/// assert!(hop.is_some());
/// ```
#[derive(Clone, Debug)]
pub struct Expansion {
    dimension: u32,
    /// When each square was opened, by column and row.
    numbers: Vec<u16>,
    /// The squares to expand next.
    open: BinaryHeap<Reverse<Entry>>,
}

/// Ordered by its fields from the first: the rank, then the number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Entry {
    rank: u64,
    number: u16,
    /// Cells from the first square, on the path by which it was opened.
    walked: u32,
    square: Cell,
}

impl Expansion {
    /// Buffers for mazes of this dimension.
    ///
    /// # Panics
    ///
    /// When `dimension` is outside 2..=64.
    pub fn new(dimension: u32) -> Self {
        assert!(
            (2..=DIMENSION_MAX).contains(&dimension),
            "the dimension is outside 2..=64"
        );
        Self {
            dimension,
            numbers: vec![CLOSED; (dimension * dimension) as usize],
            open: BinaryHeap::new(),
        }
    }

    /// The first straight stretch of the path from `from` to one of `targets`; `None` if
    /// there is no path, or if `from` is a target.
    ///
    /// `is_open` says whether the robot may leave a square on that side, which need not be
    /// the same from both squares. It must be `false` for the perimeter.
    ///
    /// Squares are expanded by rank, the smallest first, and among equals in the order in
    /// which they were opened. `rank` is called once for every square, with the number of
    /// cells walked to it. A square is opened once, from wherever it is reached first, and
    /// its neighbours in the order up, left, down, right. The expansion ends when a target is
    /// expanded. The path back always goes to the neighbour with the smallest number from
    /// which the robot may enter the square.
    ///
    /// # Panics
    ///
    /// When `from` is outside the maze, or `is_open` leads out of it.
    pub fn first_hop(
        &mut self,
        is_open: impl Fn(Cell, Heading) -> bool,
        from: Cell,
        targets: &CellSet,
        rank: impl FnMut(Cell, u32) -> u64,
    ) -> Option<Hop> {
        let target = self.expand(&is_open, from, targets, rank)?;
        self.way_back(&is_open, target)
    }

    /// Expands squares until one of them is a target, and returns it.
    fn expand(
        &mut self,
        is_open: &impl Fn(Cell, Heading) -> bool,
        from: Cell,
        targets: &CellSet,
        mut rank: impl FnMut(Cell, u32) -> u64,
    ) -> Option<Cell> {
        self.numbers.fill(CLOSED);
        self.open.clear();
        let mut number = 0;
        let mut open = |this: &mut Self, square: Cell, walked: u32| {
            let index = this.index(square);
            if this.numbers[index] == CLOSED {
                this.numbers[index] = number;
                this.open.push(Reverse(Entry {
                    rank: rank(square, walked),
                    number,
                    walked,
                    square,
                }));
                // At most 64 x 64 squares.
                number += 1;
            }
        };
        open(self, from, 0);
        while let Some(Reverse(Entry { square, walked, .. })) = self.open.pop() {
            if targets.contains(square) {
                return Some(square);
            }
            for heading in ORDER {
                if is_open(square, heading) {
                    let beyond = square.toward(heading, 1).expect("inside");
                    open(self, beyond, walked + 1);
                }
            }
        }
        None
    }

    /// Walks from the target to the square with the number 0, and returns the last straight
    /// stretch of that path, reversed.
    fn way_back(&self, is_open: &impl Fn(Cell, Heading) -> bool, target: Cell) -> Option<Hop> {
        let mut square = target;
        let mut stretch: Option<Hop> = None;
        while self.numbers[self.index(square)] != 0 {
            let (square_before, back) = ORDER
                .into_iter()
                .filter_map(|back| Some((self.neighbor(square, back)?, back)))
                .filter(|&(before, back)| is_open(before, back.opposite()))
                .min_by_key(|&(before, _)| self.numbers[self.index(before)])?;
            let heading = back.opposite();
            stretch = Some(match stretch {
                Some(hop) if hop.heading == heading => Hop {
                    cells: hop.cells + 1,
                    ..hop
                },
                _ => Hop { heading, cells: 1 },
            });
            square = square_before;
        }
        stretch
    }

    /// The neighbouring square on that side, ignoring walls.
    fn neighbor(&self, square: Cell, heading: Heading) -> Option<Cell> {
        let beyond = square.toward(heading, 1)?;
        (beyond.x < self.dimension && beyond.y < self.dimension).then_some(beyond)
    }

    const fn index(&self, square: Cell) -> usize {
        (square.x * self.dimension + square.y) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Area, Passages, Random, Search};

    fn random_passages(random: &mut Random) -> Passages {
        let mut passages = Passages::all_open(9);
        for cell in Area::new(Cell::new(0, 0), 9, 9).cells() {
            for heading in [Heading::Up, Heading::Right] {
                if random.below(100) < 30 {
                    passages.close(cell, heading);
                }
            }
        }
        passages
    }

    /// Drives hop by hop; the number of cells, or `None` when there is no path.
    fn drive(
        is_open: impl Fn(Cell, Heading) -> bool + Copy,
        from: Cell,
        to: Cell,
        rank: impl Fn(Cell, u32) -> u64 + Copy,
    ) -> Option<u32> {
        let targets = CellSet::from(to);
        let mut expansion = Expansion::new(9);
        let (mut at, mut cells) = (from, 0);
        while at != to {
            let hop = expansion.first_hop(is_open, at, &targets, rank)?;
            for _ in 0..hop.cells {
                assert!(is_open(at, hop.heading));
                at = at.toward(hop.heading, 1).expect("inside");
            }
            cells += hop.cells;
            assert!(cells <= 81, "the drive goes in circles");
        }
        Some(cells)
    }

    /// Breadth first, the path is a shortest one, and there is one wherever a search
    /// of another kind finds one.
    #[test]
    fn breadth_first_is_shortest() {
        let mut random = Random::new(11);
        let mut found = 0;
        for _ in 0..300 {
            let passages = random_passages(&mut random);
            let any = |random: &mut Random| Cell::new(random.below(9), random.below(9));
            let (from, to) = (any(&mut random), any(&mut random));
            let mut search = Search::new(9, 1);
            search.fill(&passages, &CellSet::from(to));
            let is_open = |cell, side| passages.is_open(cell, side);
            let cells = drive(is_open, from, to, |_, _| 0);
            assert_eq!(cells, search.steps(from));
            found += u32::from(cells.is_some());
        }
        assert!(found > 100, "only {found} ways: a weak test");
    }

    /// A square is gone on from by its rank: with the far corner preferred, the path
    /// to the near one is found late, and by the numbers of a detour.
    #[test]
    fn ranks_decide() {
        let passages = Passages::all_open(9);
        let is_open = |cell: Cell, side| passages.is_open(cell, side);
        let (from, to) = (Cell::new(0, 0), Cell::new(2, 0));
        let targets = CellSet::from(to);
        let mut expansion = Expansion::new(9);
        let mut asked = Vec::new();
        expansion.first_hop(is_open, from, &targets, |cell, walked| {
            asked.push((cell, walked));
            u64::from(cell.manhattan(Cell::new(8, 8)))
        });
        assert_eq!(
            asked[..3],
            [(from, 0), (Cell::new(0, 1), 1), (Cell::new(1, 0), 1)]
        );
        assert!(asked.contains(&(Cell::new(8, 8), 16)));
    }

    /// A wall that stands from one side only closes one direction.
    #[test]
    fn walls_of_one_side() {
        let passages = Passages::all_open(9);
        let (a, b) = (Cell::new(0, 0), Cell::new(0, 1));
        let is_open =
            |cell: Cell, side| passages.is_open(cell, side) && (cell, side) != (a, Heading::Up);
        let rank = |_: Cell, _: u32| 0;
        assert_eq!(drive(is_open, a, b, rank), Some(3));
        assert_eq!(drive(is_open, b, a, rank), Some(1));
    }

    #[test]
    fn no_way_and_no_need_for_one() {
        let mut expansion = Expansion::new(9);
        let here = Cell::new(4, 4);
        let mut hop = |to| {
            let targets = CellSet::from(to);
            expansion.first_hop(|_, _| false, here, &targets, |_, _| 0)
        };
        assert_eq!(hop(here), None);
        assert_eq!(hop(Cell::new(4, 5)), None);
    }
}
