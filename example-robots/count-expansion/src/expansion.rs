//! The expansion with its counts, and the way built in reverse: [`Expansion`].

use wasmouse_sdk::{Cell, CellSet, Heading, Hop, Passages};

/// The order in which the report opens neighbours and looks for the smallest count.
const ORDER: [Heading; 4] = [Heading::Up, Heading::Left, Heading::Down, Heading::Right];

/// The count of a square that has not been opened.
const CLOSED: u16 = u16::MAX;

/// Counts for every square, with buffers that are reused.
pub struct Expansion {
    dimension: u32,
    /// In which turn each square was opened, by column and row.
    counts: Vec<u16>,
    /// The squares in the order in which they were opened.
    opened: Vec<Cell>,
}

impl Expansion {
    pub fn new(dimension: u32) -> Self {
        let squares = (dimension * dimension) as usize;
        Self {
            dimension,
            counts: vec![CLOSED; squares],
            opened: Vec::with_capacity(squares),
        }
    }

    /// The first straight stretch of the way from `from` to one of `targets`;
    /// `None` when there is no way, or no need for one.
    pub fn first_hop(&mut self, passages: &Passages, from: Cell, targets: &CellSet) -> Option<Hop> {
        let target = self.expand(passages, from, targets)?;
        self.way_back(passages, target)
    }

    /// Opens square after square until it opens a target, and returns that.
    fn expand(&mut self, passages: &Passages, from: Cell, targets: &CellSet) -> Option<Cell> {
        self.counts.fill(CLOSED);
        self.opened.clear();
        self.open(from);
        let mut next = 0;
        while let Some(&square) = self.opened.get(next) {
            if targets.contains(square) {
                return Some(square);
            }
            for heading in ORDER {
                if passages.is_open(square, heading) {
                    self.open(neighbor(square, heading));
                }
            }
            next += 1;
        }
        None
    }

    fn open(&mut self, square: Cell) {
        let index = self.index(square);
        if self.counts[index] == CLOSED {
            // At most 64 x 64 squares.
            self.counts[index] = self.opened.len() as u16;
            self.opened.push(square);
        }
    }

    /// Walks from the target to the square with the count 0, and returns the last
    /// straight stretch of that, turned around.
    fn way_back(&self, passages: &Passages, target: Cell) -> Option<Hop> {
        let mut square = target;
        let mut stretch: Option<Hop> = None;
        while self.counts[self.index(square)] != 0 {
            let back = ORDER
                .into_iter()
                .filter(|&heading| passages.is_open(square, heading))
                .min_by_key(|&heading| self.counts[self.index(neighbor(square, heading))])?;
            let heading = back.opposite();
            stretch = Some(match stretch {
                Some(hop) if hop.heading == heading => Hop {
                    cells: hop.cells + 1,
                    ..hop
                },
                _ => Hop { heading, cells: 1 },
            });
            square = neighbor(square, back);
        }
        stretch
    }

    fn index(&self, square: Cell) -> usize {
        (square.x * self.dimension + square.y) as usize
    }
}

/// The square beyond an open wall.
fn neighbor(square: Cell, heading: Heading) -> Cell {
    square.toward(heading, 1).expect("the perimeter is closed")
}
