//! The search in mazes of up to 16 x 16: the whole maze is four words.
//!
//! A layer takes about two hundred instructions without a branch. On contest mazes that is
//! three times as fast as going row by row, and in WebAssembly loops also cost fuel.

use crate::passages::{Bits, ROWS};

/// The largest maze, in cells along each side.
pub(super) const DIMENSION_MAX: u32 = 16;

/// One bit per cell: the cell in column x of row y is bit `y * 16 + x`.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Board([u64; 4]);

const EMPTY: Board = Board([0; 4]);

impl Board {
    /// The lower 16 bits of the lower 16 rows.
    pub(super) fn pack(rows: &[u64; ROWS]) -> Self {
        Self(std::array::from_fn(|word| {
            let row = |index: usize| rows[word * 4 + index] & 0xFFFF;
            row(0) | row(1) << 16 | row(2) << 32 | row(3) << 48
        }))
    }

    /// Writes the lower 16 rows.
    pub(super) fn unpack(self, rows: &mut [u64; ROWS]) {
        for (row, place) in rows[..16].iter_mut().enumerate() {
            *place = self.0[row / 4] >> (row % 4 * 16) & 0xFFFF;
        }
    }

    /// The columns and rows of the cells.
    #[inline]
    fn for_each(self, mut visit: impl FnMut(usize, usize)) {
        for (index, word) in self.0.into_iter().enumerate() {
            for bit in Bits(word) {
                let place = index * 64 + bit as usize;
                visit(place % 16, place / 16);
            }
        }
    }

    #[inline]
    fn zip(self, other: Self, join: impl Fn(u64, u64) -> u64) -> Self {
        Self(std::array::from_fn(|word| {
            join(self.0[word], other.0[word])
        }))
    }

    #[inline]
    fn and(self, other: Self) -> Self {
        self.zip(other, |a, b| a & b)
    }

    #[inline]
    fn or(self, other: Self) -> Self {
        self.zip(other, |a, b| a | b)
    }

    #[inline]
    fn without(self, other: Self) -> Self {
        self.zip(other, |a, b| a & !b)
    }

    /// Every cell one column to the right. The last column must be empty.
    #[inline]
    fn right(self) -> Self {
        Self(self.0.map(|word| word << 1))
    }

    /// Every cell one column to the left; those of the first column end up in the
    /// last one.
    #[inline]
    fn left(self) -> Self {
        Self(self.0.map(|word| word >> 1))
    }

    /// Every cell one row up.
    #[inline]
    fn up(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([
            a << 16,
            b << 16 | a >> 48,
            c << 16 | b >> 48,
            d << 16 | c >> 48,
        ])
    }

    /// Every cell one row down.
    #[inline]
    fn down(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([
            a >> 16 | b << 48,
            b >> 16 | c << 48,
            c >> 16 | d << 48,
            d >> 16,
        ])
    }
}

/// Open walls: to the right of cells and above them. The perimeter is closed.
pub(super) struct Walls {
    pub(super) right: Board,
    pub(super) up: Board,
}

/// Spreads from `targets` until `stop` is reached or nothing new is; calls
/// `visit(x, y, steps)` forevery cell reached, and returns all of them.
pub(super) fn spread(
    walls: &Walls,
    targets: Board,
    stop: Board,
    longest: u32,
    mut visit: impl FnMut(usize, usize, u16),
) -> Board {
    let mut reached = EMPTY;
    let mut next = targets;
    let mut steps = 0;
    loop {
        let new = next.without(reached);
        if new == EMPTY {
            return reached;
        }
        reached = reached.or(new);
        new.for_each(|x, y| visit(x, y, steps));
        if new.and(stop) != EMPTY {
            return reached;
        }
        // The usual longest move is a constant, so that its loop is unrolled.
        next = match longest {
            3 => layer(walls, new, 3),
            longest => layer(walls, new, longest.min(DIMENSION_MAX)),
        };
        steps += 1;
    }
}

/// The cells one step away from `cells`, and some others that are reached already.
#[inline]
fn layer(walls: &Walls, cells: Board, longest: u32) -> Board {
    let (mut right, mut left, mut up, mut down) = (cells, cells, cells, cells);
    let mut next = EMPTY;
    for _ in 0..longest {
        right = right.and(walls.right).right();
        left = left.left().and(walls.right);
        up = up.and(walls.up).up();
        down = down.down().and(walls.up);
        next = next.or(right).or(left).or(up).or(down);
    }
    next
}
