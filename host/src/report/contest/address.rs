//! [`Addresses`]: the addresses of matches, which are the digests of their keys.

use wasmouse_core::Digest;
use wasmouse_core::record::MatchKey;

use super::document::ContestReport;
use crate::contest::ScoreMatrix;

/// Finds the address of a match by its place in the matrix.
pub(super) struct Addresses<'a> {
    matrix: &'a ScoreMatrix,
    engine: Digest,
    rules: Digest,
}

impl<'a> Addresses<'a> {
    pub(super) fn new(report: &ContestReport<'a>) -> Self {
        Self {
            matrix: report.matrix,
            engine: report.engine.digest(),
            rules: report.matrix.rules.digest(),
        }
    }

    /// The address of the match of a robot in a maze with the seed at that position.
    pub(super) fn get(&self, robot: usize, maze: usize, seed: u32) -> Digest {
        let (robot, maze) = (&self.matrix.robots[robot], &self.matrix.mazes[maze]);
        let key = MatchKey {
            engine: self.engine,
            rules: self.rules,
            robot: robot.digest,
            variant: robot.variant,
            maze: maze.digest,
            seed: self.matrix.seeds.get(seed),
        };
        key.digest()
    }
}
