//! Detects loops: the report's test, and a stronger one.

use wasmouse_sdk::{Cell, Pose};

/// Path lengths that the report looks for, in nodes.
const LENGTHS: std::ops::RangeInclusive<usize> = 2..=6;

/// How often the robot may plan in the same pose without having learnt anything.
const SAME_POSE_MAX: u8 = 2;

/// Whether the end of `visited` is a path of 2 to 6 nodes, then the same path back,
/// then the same path again.
pub fn is_looping(visited: &[Cell]) -> bool {
    LENGTHS.into_iter().any(|length| {
        let turn = length - 1;
        let Some(first) = visited.len().checked_sub(3 * turn + 1) else {
            return false;
        };
        let round = &visited[first..];
        (0..=turn).all(|node| {
            let there = round[node];
            let back = round[2 * turn - node];
            let again = round[2 * turn + node];
            there == back && back == again
        })
    })
}

/// Counts how often the robot makes a plan in the same pose without any news.
pub struct Repeats {
    dimension: u32,
    plans: Vec<u8>,
}

impl Repeats {
    pub fn new(dimension: u32) -> Self {
        Self {
            dimension,
            plans: vec![0; (4 * dimension * dimension) as usize],
        }
    }

    /// Something new has been seen.
    pub fn forget(&mut self) {
        self.plans.fill(0);
    }

    /// A plan is about to be made in this pose; true when it has been made too often.
    pub fn is_stuck(&mut self, pose: Pose) -> bool {
        let cell = pose.cell.y * self.dimension + pose.cell.x;
        let plans = &mut self.plans[4 * cell as usize + pose.heading as usize];
        *plans = plans.saturating_add(1);
        *plans > SAME_POSE_MAX
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(rows: &[u32], expected: bool) {
        let visited: Vec<Cell> = rows.iter().map(|&y| Cell::new(0, y)).collect();
        assert_eq!(is_looping(&visited), expected, "{rows:?}");
    }

    #[test]
    fn there_and_back_and_there_again() {
        check(&[1, 2, 1, 2], true);
        check(&[9, 1, 2, 1, 2], true);
        check(&[1, 2, 1], false);
        check(&[1, 2, 1, 3], false);
        check(&[1, 2, 3, 2, 1, 2, 3], true);
        check(&[1, 2, 3, 1, 2, 3, 1, 2, 3], false);
        // The report's example of three nodes, and six of them.
        check(&[7, 8, 9, 8, 7, 8, 9], true);
        check(&[1, 2, 3, 4, 5, 6, 5, 4, 3, 2, 1, 2, 3, 4, 5, 6], true);
        let seven = [1, 2, 3, 4, 5, 6, 7, 6, 5, 4, 3, 2, 1, 2, 3, 4, 5, 6, 7];
        check(&seven, false);
    }

    #[test]
    fn plans_in_the_same_pose() {
        let mut repeats = Repeats::new(4);
        let pose = Pose::at_start(Cell::new(3, 3));
        assert!(!repeats.is_stuck(pose) && !repeats.is_stuck(pose));
        assert!(!repeats.is_stuck(Pose::at_start(Cell::new(3, 2))));
        assert!(repeats.is_stuck(pose));
        repeats.forget();
        assert!(!repeats.is_stuck(pose));
    }
}
