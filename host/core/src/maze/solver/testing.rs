//! Random mazes for the laws of the solver; compiled for tests only.

use std::ops::RangeInclusive;

use proptest::prelude::*;

use crate::maze::{Heading, Maze, Walls};

/// Mazes of random walls, about half of them standing, legal or not.
pub(super) fn random_maze(dimensions: RangeInclusive<u8>) -> impl Strategy<Value = Maze> {
    dimensions.prop_flat_map(|n| {
        let edges = 2 * usize::from(n) * usize::from(n);
        let shares = prop::collection::vec(0_u8..100, edges);
        (shares, 20_u8..80).prop_map(move |(shares, limit)| {
            let mut walls = Walls::closed(n);
            let sides = Walls::closed(n)
                .cells()
                .flat_map(|cell| [(cell, Heading::Up), (cell, Heading::Right)]);
            for ((cell, heading), share) in sides.zip(shares) {
                if walls.neighbor(cell, heading).is_some() {
                    walls.set(cell, heading, share >= limit);
                }
            }
            Maze::contest(walls).expect("at least 3 x 3 has room for both")
        })
    })
}
