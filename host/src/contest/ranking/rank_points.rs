//! [`RankPoints`]: how robots did against each other, match by match.

/// Points of each robot, in half points: two for each robot that did worse in the same match,
/// and one for each other that did as well.
#[derive(Debug)]
pub(super) struct RankPoints {
    /// By robot.
    pub(super) half_points: Vec<u64>,
    /// The robots of the match in progress with their scores; kept to allocate only once.
    row: Vec<(u64, usize)>,
}

/// The score of an unfinished match: worse than any other.
pub(super) const UNFINISHED: u64 = u64::MAX;

impl RankPoints {
    pub(super) fn new(robots: usize) -> Self {
        Self {
            half_points: vec![0; robots],
            row: Vec::with_capacity(robots),
        }
    }

    /// Adds a robot to the match in progress.
    pub(super) fn push(&mut self, robot: usize, score: u64) {
        self.row.push((score, robot));
    }

    /// Gives the points of the match in progress, `weight` times, and begins the next.
    pub(super) fn end_match(&mut self, weight: u32) {
        self.row.sort_unstable();
        let mut rest = self.row.len() as u64;
        for equal in self.row.chunk_by(|(a, _), (b, _)| a == b) {
            let size = equal.len() as u64;
            rest -= size;
            for &(_, robot) in equal {
                self.half_points[robot] += u64::from(weight) * (2 * rest + size - 1);
            }
        }
        self.row.clear();
    }
}
