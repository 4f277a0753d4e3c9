//! Seeded maze generators, one per file, and the specification that names them.
//!
//! Every generated maze is a legal contest maze by construction: `Draft`
//! fixes the start and the goal room before a generator begins, the generators
//! only touch what is left, and each keeps all cells connected by the structure
//! of its algorithm. Nothing is generated and thrown away.
//!
//! Equal specifications give equal mazes on every platform and in every later
//! version: chance comes from ChaCha8 with a seed that `Draws` lays out byte
//! by byte, and only fixed-width integers are drawn. A change to any generator
//! would move the mazes of published results, so tests pin their bytes.

mod braid;
mod division;
mod draft;
mod draws;
mod sets;
mod spec;
mod stretches;
mod tree;

use std::fmt;

use self::draws::Draws;
use super::Maze;

pub use spec::{GENERATED_MAX, GenSpec, GenSpecError, GeneratedMaze};

/// The smallest and the largest dimension that can be generated, in cells. Only
/// even ones are.
pub const GENERATED_DIMENSIONS: std::ops::RangeInclusive<u8> = 12..=20;

/// A way of making mazes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Stretches of four edges, three of them walls: Minnett's generator as his
    /// report describes it. Has open places, free-standing walls, and dead ends
    /// all the same.
    Division,
    /// A random spanning tree with some walls removed. Winding, many dead ends.
    Tree {
        /// How many of the walls that the tree leaves are opened, in percent.
        /// Range: 0 to 100. Default: [`Kind::DEFAULT_LOOPS`].
        loops: u8,
    },
    /// Straights and diagonal staircases with most dead ends joined: like mazes
    /// that people draw for contests.
    Braid,
    /// Stretches of one to five edges, each with an opening: Minnett's generator
    /// as his program has it. Short ways, many loops and many dead ends.
    Stretches,
}

impl Kind {
    /// Percent of walls opened in a tree when nobody says otherwise.
    pub const DEFAULT_LOOPS: u8 = 12;

    /// One of each kind, with default settings, in the order of help texts.
    pub const ALL: [Self; 4] = [
        Self::Division,
        Self::Tree {
            loops: Self::DEFAULT_LOOPS,
        },
        Self::Braid,
        Self::Stretches,
    ];

    /// `division`, `tree`, `braid` or `stretches`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Division => "division",
            Self::Tree { .. } => "tree",
            Self::Braid => "braid",
            Self::Stretches => "stretches",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        match self {
            Self::Tree { loops } => write!(f, ",loops={loops}"),
            Self::Division | Self::Braid | Self::Stretches => Ok(()),
        }
    }
}

/// The maze of that kind, dimension and seed: always a legal contest maze.
///
/// The seed of the random numbers also holds the kind's name and the dimension,
/// so mazes with the same seed have nothing in common. The loops of a tree are
/// left out of it: with more of them the same tree loses more walls, in the
/// same order.
///
/// # Panics
///
/// When the dimension is odd or outside [`GENERATED_DIMENSIONS`], or more than
/// 100 percent of walls are to be opened. [`GenSpec`] refuses both.
pub(super) fn generate(kind: Kind, dimension: u8, seed: u64) -> Maze {
    assert!(
        GENERATED_DIMENSIONS.contains(&dimension) && dimension.is_multiple_of(2),
        "dimension {dimension} is not an even number from 12 to 20"
    );
    let mut draws = Draws::new(kind.name(), dimension, seed);
    let walls = match kind {
        Kind::Division => division::walls(dimension, &mut draws),
        Kind::Tree { loops } => tree::walls(dimension, loops, &mut draws),
        Kind::Braid => braid::walls(dimension, &mut draws),
        Kind::Stretches => stretches::walls(dimension, &mut draws),
    };
    Maze::contest(walls).expect("12 x 12 cells have room for start and goal")
}

#[cfg(test)]
mod tests;
