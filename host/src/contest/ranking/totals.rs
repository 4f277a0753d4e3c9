//! [`Totals`]: the matches of one robot, added up exactly.

use wasmouse_core::game::Score;

use super::points::Points;
use crate::contest::matrix::{MatchScore, Outcome};
use crate::contest::mean::Mean;

/// Some matches of one robot. Sums count each match as often as its maze counts; counts and
/// maxima do not.
#[derive(Clone, Debug, Default)]
pub(super) struct Totals {
    pub(super) matches: u64,
    pub(super) finished: u64,
    pub(super) budget_used_up: u64,
    pub(super) goal_reached: u64,
    pub(super) faults: u64,
    /// Finished matches whose speed run took as few steps as the maze allows.
    pub(super) optimal: u64,
    pub(super) step_fuel_max: u64,
    pub(super) memory_bytes_max: u64,

    /// Matches.
    pub(super) weight: u64,
    /// Finished matches.
    pub(super) weight_finished: u64,
    /// Scores of the finished matches.
    pub(super) finished_score: i128,
    /// Scores of all matches, an unfinished one as the penalty.
    pub(super) score: i128,
    /// Oracle scores of all matches.
    pub(super) oracle: i128,
    /// Steps of the exploration runs of the finished matches.
    pub(super) exploration_steps: i128,
    /// Steps beyond the oracle's in each run of the finished matches.
    pub(super) exploration_regret: i128,
    pub(super) speed_regret: i128,
    /// Steps, and calls in which the robot failed.
    pub(super) calls: i128,
    /// Fuel of all calls.
    pub(super) fuel: i128,
    /// Score and weight of every match, an unfinished one as the penalty.
    pub(super) scores: Vec<(u64, u32)>,
}

impl Totals {
    /// Adds a match in a maze with that oracle score, which counts `weight` times.
    pub(super) fn add(&mut self, played: &MatchScore, oracle: Score, weight: u32, points: &Points) {
        let times = i128::from(weight);
        self.matches += 1;
        self.weight += u64::from(weight);
        let steps = played.steps;
        let mut calls = u64::from(steps.exploration) + u64::from(steps.speed);
        match played.outcome {
            Outcome::Finished => {
                let more = |ours: u32, least: u32| i128::from(ours) - i128::from(least);
                let speed = more(steps.speed, oracle.speed_steps());
                let exploration = more(steps.exploration, oracle.exploration_steps());
                self.finished += 1;
                self.optimal += u64::from(speed == 0);
                self.weight_finished += u64::from(weight);
                self.exploration_steps += i128::from(steps.exploration) * times;
                self.exploration_regret += exploration * times;
                self.speed_regret += speed * times;
            }
            Outcome::BudgetUsedUp { goal_reached } => {
                self.budget_used_up += 1;
                self.goal_reached += u64::from(goal_reached);
            }
            Outcome::Fault(_) => {
                self.faults += 1;
                // A robot that fails before its first call has used no fuel of steps.
                calls += u64::from(played.fuel.steps > 0);
            }
        }
        let finished = points.score(played);
        let score = finished.unwrap_or(points.penalty);
        let oracle = points.of_steps(oracle.speed_steps(), oracle.exploration_steps());
        self.finished_score += i128::from(finished.unwrap_or(0)) * times;
        self.score += i128::from(score) * times;
        self.oracle += i128::from(oracle) * times;
        self.calls += i128::from(calls) * times;
        self.fuel += i128::from(played.fuel.steps) * times;
        self.step_fuel_max = self.step_fuel_max.max(played.fuel.step_max);
        self.memory_bytes_max = self.memory_bytes_max.max(played.memory_bytes);
        self.scores.push((score, weight));
    }

    /// Average fuel of a call; `None` without calls.
    pub(super) fn step_fuel(&self) -> Option<Mean> {
        (self.calls > 0).then(|| Mean::fraction(self.fuel, self.calls))
    }

    /// Average steps of the exploration run over the finished matches; `None` when there is none.
    pub(super) fn mean_exploration_steps(&self) -> Option<Mean> {
        let count = self.weight_finished;
        (count > 0).then(|| Mean::fraction(self.exploration_steps, count.into()))
    }
}
