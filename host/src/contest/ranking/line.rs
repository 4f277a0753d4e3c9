//! [`RankingLine`]: what a ranking says about one robot.

use super::percentiles::Percentiles;
use super::selection::RobotState;
use crate::contest::mean::Mean;
use crate::contest::tally::Regret;

/// One line of a [`Ranking`](super::Ranking).
///
/// It is about the mazes that count; of a robot without a rank, about those of them that it has
/// played with every seed. Averages, rates, percentiles and points count each match as often as its
/// maze does ([`MazeSet::weight`](crate::contest::MazeSet::weight)); counts and maxima count
/// it once. Scores and regrets are in steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RankingLine {
    /// Index of the robot in the matrix.
    pub robot: usize,
    /// Counted from 1; robots that did equally well share a rank. `None` unless `state` is
    /// [`RobotState::Ranked`], and for all while no maze counts.
    pub rank: Option<u32>,
    /// Whether the robot can have a rank, and if not, why.
    pub state: RobotState,
    /// What the robot is ranked by. `None` without matches, and for rank points without a rank.
    pub value: Option<Mean>,

    /// Matches played.
    pub matches: u64,
    /// Matches finished with a score.
    pub finished: u64,
    /// Matches whose budget ran out.
    pub budget_used_up: u64,
    /// Those of them in which the exploration run had reached the goal.
    pub goal_reached: u64,
    /// Matches that ended in a fault.
    pub faults: u64,
    /// Matches that were not played, in all mazes of the filter: the contest is not there yet, the
    /// host failed, or the robot was withdrawn or not admitted.
    pub unplayed: u64,
    /// Finished matches whose speed run took as few steps as the maze allows.
    pub optimal_speed_runs: u64,

    /// The share of matches that are finished. Range: 0 to 1.
    pub finish_rate: Option<Mean>,
    /// The average score; an unfinished match counts as the penalty.
    pub mean_score: Option<Mean>,
    /// The average score of the finished matches.
    pub mean_finished_score: Option<Mean>,
    /// How the scores are distributed; an unfinished match counts as the penalty.
    pub percentiles: Option<Percentiles>,
    /// Points for each other robot with a rank: one where it did worse in the same match, half a
    /// point where it did equally well. `None` for a robot without a rank.
    pub rank_points: Option<Mean>,
    /// The average regret; that of an unfinished match is the penalty minus the oracle score.
    pub mean_regret: Option<Mean>,
    /// The average regret of the finished matches, with its parts.
    pub finished_regret: Option<Regret>,
    /// The average length of the exploration run over the finished matches, in steps.
    pub mean_exploration_steps: Option<Mean>,

    /// Average fuel of a step.
    pub step_fuel_mean: Option<Mean>,
    /// Fuel of the most expensive step.
    pub step_fuel_max: u64,
    /// The most linear memory that the robot had at the end of a match, in bytes.
    pub memory_bytes_max: u64,
}
