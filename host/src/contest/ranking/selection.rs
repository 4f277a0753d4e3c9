//! [`Selection`]: which robots and mazes of a matrix count.

use wasmouse_core::guest_text::GuestStr;

use crate::contest::matrix::ScoreMatrix;

/// Which mazes a ranking or a comparison is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MazeFilter {
    /// All of them.
    #[default]
    All,
    /// Those of the set with that index.
    Set(usize),
    /// Those with that many cells along a side.
    Size(u8),
}

impl MazeFilter {
    /// The mazes that it leaves, in their order.
    pub(in crate::contest) fn mazes(self, matrix: &ScoreMatrix) -> impl Iterator<Item = usize> {
        let mazes = matrix.mazes.iter().enumerate();
        mazes
            .filter(move |(_, maze)| match self {
                Self::All => true,
                Self::Set(set) => maze.set == set,
                Self::Size(dimension) => maze.dimension == dimension,
            })
            .map(|(index, _)| index)
    }
}

/// Whether a robot can have a rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RobotState {
    /// It has a rank, as soon as there is a maze that all such robots have played.
    Ranked,
    /// The host could not play some of its matches in these mazes, or it was withdrawn. The
    /// others are ranked as without it.
    Incomplete,
    /// It has not played any of these mazes yet.
    NotStarted,
    /// It was not admitted.
    NotAdmitted,
}

/// The robots and mazes of a ranking.
#[derive(Debug)]
pub(super) struct Selection {
    /// The robots, as indices into those of the matrix.
    pub(super) robots: Vec<usize>,
    /// By position in `robots`.
    pub(super) states: Vec<RobotState>,
    /// Matches of each robot that were not played, in mazes of the filter.
    pub(super) unplayed: Vec<u64>,
    /// The mazes that count.
    pub(super) mazes: Vec<usize>,
    /// By maze that counts, then by position in `robots`: whether the robot has played it with
    /// every seed.
    has_played: Vec<bool>,
    /// How many mazes of the filter have a goal that cannot be reached.
    pub(super) mazes_unreachable: u64,
    /// How many mazes the filter leaves.
    pub(super) mazes_total: u64,
}

impl Selection {
    /// The robots of a class, or all, in the mazes that all of them have played with every seed.
    pub(super) fn new(
        matrix: &ScoreMatrix,
        filter: MazeFilter,
        class: Option<GuestStr<'_>>,
    ) -> Self {
        let robots = matrix.robots.iter().enumerate();
        let robots: Vec<usize> = robots
            .filter(|(_, robot)| {
                class.is_none() || robot.class.as_ref().map(GuestStr::from) == class
            })
            .map(|(index, _)| index)
            .collect();
        let count = robots.len();
        let mut unplayed = vec![0; count];
        let (mut candidates, mut has_played) = (Vec::new(), Vec::new());
        let mut has_started = vec![false; count];
        let mut is_missing_any = vec![false; count];
        let mut mazes_total = 0;
        let mut missing = vec![0; count];
        for maze in filter.mazes(matrix) {
            mazes_total += 1;
            missing.fill(0);
            for seed in 0..matrix.seeds.count {
                let row = matrix.row(maze, seed);
                for (missing, &robot) in missing.iter_mut().zip(&robots) {
                    *missing += u64::from(row[robot].is_none());
                }
            }
            for (total, missing) in unplayed.iter_mut().zip(&missing) {
                *total += missing;
            }
            // Nobody can finish it, so it would only move all averages by as much.
            if matrix.mazes[maze].oracle.is_none() {
                continue;
            }
            candidates.push(maze);
            for (position, &missing) in missing.iter().enumerate() {
                has_started[position] |= missing < u64::from(matrix.seeds.count);
                is_missing_any[position] |= missing > 0;
                has_played.push(missing == 0);
            }
        }
        let states: Vec<RobotState> = robots
            .iter()
            .enumerate()
            .map(|(position, &index)| {
                let robot = &matrix.robots[index];
                if robot.not_admitted.is_some() {
                    RobotState::NotAdmitted
                } else if is_missing_any[position] && !robot.unplayed.is_empty() {
                    RobotState::Incomplete
                } else if has_started[position] {
                    RobotState::Ranked
                } else {
                    RobotState::NotStarted
                }
            })
            .collect();
        let is_ranked = |&(_, state): &(&bool, &RobotState)| *state == RobotState::Ranked;
        let counts = |played: &[bool]| {
            let mut of_ranked = played.iter().zip(&states).filter(is_ranked).peekable();
            of_ranked.peek().is_some() && of_ranked.all(|(&has_played, _)| has_played)
        };
        let mazes_reachable = candidates.len() as u64;
        let (mut mazes, mut has_played_counting) = (Vec::new(), Vec::new());
        for (maze, has_played) in candidates.into_iter().zip(has_played.chunks(count.max(1))) {
            if counts(has_played) {
                mazes.push(maze);
                has_played_counting.extend_from_slice(has_played);
            }
        }
        Self {
            robots,
            states,
            unplayed,
            mazes,
            has_played: has_played_counting,
            mazes_unreachable: mazes_total - mazes_reachable,
            mazes_total,
        }
    }

    /// Of a maze by its position in `mazes`, which robots have played it with every seed, by
    /// position in `robots`.
    pub(super) fn has_played(&self, maze: usize) -> &[bool] {
        let count = self.robots.len();
        &self.has_played[maze * count..(maze + 1) * count]
    }
}
