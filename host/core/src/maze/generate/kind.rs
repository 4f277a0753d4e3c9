//! [`Kind`]: the algorithms by name.

use std::fmt;
use std::ops::RangeInclusive;

use super::super::Maze;
use super::draws::Draws;
use super::{braid, division, stretches, tree};

/// The smallest and the largest size of generated mazes, in cells. Only even sizes are valid.
pub const GENERATED_DIMENSIONS: RangeInclusive<u8> = 12..=20;

/// A maze generator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Stretches of four edges, three of them walls: Minnett's generator as his report
    /// describes it. Open areas, free-standing walls, and still dead ends.
    Division,
    /// A random spanning tree with some walls removed. Winding, many dead ends.
    Tree {
        /// How many of the walls that the tree leaves are opened, in percent. Range: 0 to
        /// 100. Default: [`Kind::DEFAULT_LOOPS`].
        loops: u8,
    },
    /// Straights and diagonal staircases with most dead ends joined, like mazes that people
    /// draw for contests.
    Braid,
    /// Stretches of one to five edges, each with an opening: Minnett's generator as his
    /// program implements it. Short paths, many loops and many dead ends.
    Stretches,
}

impl Kind {
    /// The default of `loops` for a tree, in percent.
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

    /// Generates the legal contest maze of this kind, size and seed.
    ///
    /// The key of the random numbers includes the kind and the size, so equal seeds do not
    /// make mazes similar. It does not include the loops of a tree: with more loops, more
    /// walls of the same tree are opened, in the same order.
    ///
    /// # Panics
    ///
    /// If the size is odd or outside [`GENERATED_DIMENSIONS`], or if the loops exceed 100
    /// percent. [`GenSpec`](super::GenSpec) rejects both.
    pub(super) fn generate(self, dimension: u8, seed: u64) -> Maze {
        assert!(
            GENERATED_DIMENSIONS.contains(&dimension) && dimension.is_multiple_of(2),
            "size {dimension} is not an even number from 12 to 20"
        );
        let mut draws = Draws::new(self.name(), dimension, seed);
        let walls = match self {
            Self::Division => division::walls(dimension, &mut draws),
            Self::Tree { loops } => tree::walls(dimension, loops, &mut draws),
            Self::Braid => braid::walls(dimension, &mut draws),
            Self::Stretches => stretches::walls(dimension, &mut draws),
        };
        Maze::contest(walls).expect("start and goal fit")
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
