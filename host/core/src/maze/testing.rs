//! Random mazes for property tests; compiled for tests only.

use std::ops::RangeInclusive;

use proptest::prelude::*;

use super::{Maze, Walls};

/// Random walls of these sizes, legal or not; 20 to 80 % of them stand.
pub fn random_walls(dimensions: RangeInclusive<u8>) -> impl Strategy<Value = Walls> {
    dimensions.prop_flat_map(|dimension| {
        let edges: Vec<_> = Walls::closed(dimension).edges().collect();
        let shares = prop::collection::vec(0_u8..100, edges.len());
        (shares, 20_u8..80).prop_map(move |(shares, limit)| {
            let mut walls = Walls::closed(dimension);
            for (&(cell, heading), share) in edges.iter().zip(shares) {
                walls.set(cell, heading, share >= limit);
            }
            walls
        })
    })
}

/// Mazes of random walls with the usual start and goal. Sizes: at least 3.
pub fn random_maze(dimensions: RangeInclusive<u8>) -> impl Strategy<Value = Maze> {
    random_walls(dimensions).prop_map(|walls| Maze::contest(walls).expect("start and goal fit"))
}
