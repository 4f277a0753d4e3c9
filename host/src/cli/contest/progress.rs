//! [`Progress`]: what a contest shows while it is played: rate, time left, the first robots, and
//! faults.
//!
//! On a terminal it is a bar with a line below. Elsewhere it is a line now and then, so that a log
//! shows that the contest goes on.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::io::{IsTerminal as _, stderr};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use wasmouse_core::game::Verdict;
use wasmouse_core::{Digest, GuestText};

use super::super::bar;
use super::super::output::message;
use crate::contest::{Ended, MatchScore, Mean, Outcome, ScoreMatrix, Scoring};
use crate::report::escape::for_terminal;
use crate::report::number::counted;

/// Robots that are shown.
const SHOWN_MAX: usize = 3;

/// How often the line on a terminal changes.
const ON_TERMINAL: Duration = Duration::from_millis(500);

/// How often a line is printed elsewhere.
const ELSEWHERE: Duration = Duration::from_secs(30);

/// Counts the matches of a contest as they end, and shows them.
pub struct Progress {
    bar: ProgressBar,
    total: u64,
    penalty_steps: u32,
    divisor: u32,
    is_terminal: bool,
    state: Mutex<State>,
}

struct State {
    ended: u64,
    faults: u64,
    unplayed: u64,
    robots: HashMap<(Digest, u32), Sum>,
    shown: Instant,
    began: Instant,
}

/// The matches of a robot.
struct Sum {
    name: GuestText,
    matches: u32,
    /// Scores times the divisor of the rules; an unfinished match counts as the penalty.
    numerator: u64,
}

impl Progress {
    /// The progress of a contest of which `before` has been played, with `total` matches left.
    pub fn new(before: &ScoreMatrix, scoring: &Scoring, total: u64) -> Self {
        let is_terminal = stderr().is_terminal();
        let bar = bar::new(total, bar::matches("\n{msg}"));
        let game = &before.rules.game;
        let mut progress = Self {
            bar,
            total,
            penalty_steps: scoring.penalty_steps(game),
            divisor: game.exploration_divisor,
            is_terminal,
            state: Mutex::new(State {
                ended: 0,
                faults: 0,
                unplayed: 0,
                robots: HashMap::new(),
                shown: Instant::now(),
                began: Instant::now(),
            }),
        };
        for robot in 0..before.robots.len() {
            let sum = progress.sum_of(before, robot);
            let robot = &before.robots[robot];
            let state = progress.state.get_mut();
            let state = state.unwrap_or_else(PoisonError::into_inner);
            let player = (robot.digest, robot.variant);
            state.robots.entry(player).or_insert(sum);
        }
        progress
    }

    fn sum_of(&self, before: &ScoreMatrix, robot: usize) -> Sum {
        let mut sum = Sum {
            name: before.robots[robot].name.clone(),
            matches: 0,
            numerator: 0,
        };
        for maze in 0..before.mazes.len() {
            for seed in 0..before.seeds.count {
                if let Some(played) = before.get(robot, maze, seed) {
                    self.add(&mut sum, played);
                }
            }
        }
        sum
    }

    fn add(&self, sum: &mut Sum, played: &MatchScore) {
        sum.matches += 1;
        let (speed, exploration) = match played.outcome {
            Outcome::Finished => (played.steps.speed, played.steps.exploration),
            Outcome::BudgetUsedUp { .. } | Outcome::Fault(_) => (self.penalty_steps, 0),
        };
        sum.numerator += u64::from(speed) * u64::from(self.divisor) + u64::from(exploration);
    }

    /// Counts a match, and shows what there is to show.
    pub fn ended(&self, ended: &Ended) {
        self.bar.inc(1);
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.ended += 1;
        match ended {
            Ended::Played(played) => {
                let record = &played.record;
                let is_fault = matches!(record.verdict, Verdict::Fault { .. });
                state.faults += u64::from(is_fault);
                let player = (record.key.robot, record.key.variant);
                if let Some(sum) = state.robots.get_mut(&player) {
                    self.add(sum, &MatchScore::new(record));
                }
            }
            Ended::Failed(_) | Ended::Withdrawn(_) => state.unplayed += 1,
        }
        let now = Instant::now();
        let interval = if self.is_terminal {
            ON_TERMINAL
        } else {
            ELSEWHERE
        };
        if now.duration_since(state.shown) < interval {
            return;
        }
        state.shown = now;
        let line = self.line(&state);
        if self.is_terminal {
            self.bar.set_message(line);
        } else {
            let seconds = now.duration_since(state.began).as_secs_f64();
            let left = (self.total - state.ended.min(self.total)) as f64;
            let left = (left * seconds / state.ended as f64).ceil() as u64;
            message!(
                "{} of {}, {} s left; {}",
                state.ended,
                counted(self.total, "match"),
                left,
                line
            );
        }
    }

    /// The first robots by their average score over the matches so far.
    fn line(&self, state: &State) -> String {
        let played = state.robots.values().filter(|it| it.matches > 0);
        let mut order: Vec<(Mean, &GuestText)> = played
            .map(|it| {
                let denominator = i128::from(it.matches) * i128::from(self.divisor);
                (Mean::fraction(it.numerator.into(), denominator), &it.name)
            })
            .collect();
        order.sort();
        let mut line = String::from("now ");
        for (place, (mean, name)) in order.iter().take(SHOWN_MAX).enumerate() {
            let separator = if place > 0 { ", " } else { "" };
            let (place, name) = (place + 1, for_terminal(*name));
            write!(line, "{separator}{place}. {name} {mean}").expect("a string takes any text");
        }
        let (faults, unplayed) = (state.faults, state.unplayed);
        write!(line, "; {}", counted(faults, "fault")).expect("a string takes any text");
        if unplayed > 0 {
            write!(line, "; {unplayed} not played").expect("a string takes any text");
        }
        line
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
