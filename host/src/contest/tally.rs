//! [`Tally`]: what some matches have in common, counted and averaged.
//!
//! Standings and studies are made of tallies; which matches belong together is
//! decided there.

use super::{Benchmark, Contest, MatchResult, Mean};
use crate::robot::{Phase, Verdict};
use crate::sim::Score;

/// Some matches of a contest, counted and averaged. Averages are over the
/// finished ones, and `None` when there is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tally {
    /// Matches played.
    pub matches: u32,
    /// Matches finished with a score.
    pub finished: u32,
    /// Matches whose budget ran out after run 1 had reached the goal.
    pub goal_reached: u32,
    /// Matches that ended in a fault.
    pub faults: u32,
    /// Finished matches whose run 2 took as few steps as the maze allows.
    pub optimal: u32,
    /// Average score.
    pub score: Option<Mean>,
    /// Average of score minus floor.
    pub regret: Option<Regret>,
    /// How the scores stand against each of [`Benchmark::ALL`].
    pub benchmarks: [Against; Benchmark::ALL.len()],
    /// Answers that the robot was asked for in all matches: its steps, and the
    /// call in which it failed. `start` is not one.
    pub decisions: u64,
    /// Fuel of all decisions together.
    pub fuel: u64,
    /// Fuel of the most expensive decision.
    pub decision_fuel_max: u64,
}

/// How much worse than a robot that knows the maze, on average.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Regret {
    /// Average of score minus floor: the sum of the two parts.
    pub total: Mean,
    /// What run 1 adds: its steps beyond the optimal path and the reset, over
    /// the ruleset's divisor.
    pub exploration: Mean,
    /// What run 2 adds: its steps beyond the optimal path.
    pub speed: Mean,
}

/// Scores against one benchmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Against {
    /// Finished matches with a score lower than the benchmark.
    pub beaten: u32,
    /// Average of benchmark minus score: positive when scores are better.
    pub margin: Option<Mean>,
}

impl Tally {
    /// The tally of some results of a contest.
    pub fn of<'a>(contest: &Contest, results: impl IntoIterator<Item = &'a MatchResult>) -> Self {
        let mut tally = Self::default();
        let mut finished = Vec::new();
        for result in results {
            tally.count(result);
            if let Verdict::Finished(score) = result.outcome.verdict {
                finished.push((score, result.maze));
            }
        }
        // A maze that a robot has finished can be solved, so it has a floor.
        let floors = || {
            let floor = |&(score, maze): &(Score, usize)| Some((score, contest.mazes[maze].floor?));
            finished.iter().filter_map(floor)
        };
        let is_optimal =
            |(score, floor): &(Score, Score)| score.speed_steps() == floor.speed_steps();
        tally.optimal = count(floors().filter(is_optimal));
        tally.score = finished.iter().map(|&(score, _)| score).collect();
        tally.regret = regret(floors());
        tally.benchmarks = Benchmark::ALL.map(|benchmark| {
            let margins = finished
                .iter()
                .filter_map(|&(score, maze)| benchmark.margin(score, &contest.mazes[maze]));
            Against {
                beaten: count(
                    margins
                        .clone()
                        .filter(|&margin| margin > Mean::fraction(0, 1)),
                ),
                margin: margins.collect(),
            }
        });
        tally
    }

    /// Average fuel of a decision, to the nearest unit; 0 without decisions.
    pub const fn decision_fuel_mean(&self) -> u64 {
        match self.decisions {
            0 => 0,
            decisions => (self.fuel + decisions / 2) / decisions,
        }
    }

    fn count(&mut self, result: &MatchResult) {
        let outcome = &result.outcome;
        self.matches += 1;
        match &outcome.verdict {
            Verdict::Finished(_) => self.finished += 1,
            Verdict::BudgetUsedUp { goal_reached } => self.goal_reached += u32::from(*goal_reached),
            Verdict::Fault(fault) => {
                self.faults += 1;
                self.decisions += u64::from(fault.phase == Phase::NextMove);
            }
        }
        self.decisions += outcome.steps.map(u64::from).iter().sum::<u64>();
        self.fuel += outcome.fuel.steps;
        self.decision_fuel_max = self.decision_fuel_max.max(outcome.fuel.step_max);
    }
}

impl Default for Tally {
    /// The tally of no matches.
    fn default() -> Self {
        Self {
            matches: 0,
            finished: 0,
            goal_reached: 0,
            faults: 0,
            optimal: 0,
            score: None,
            regret: None,
            benchmarks: [Against {
                beaten: 0,
                margin: None,
            }; Benchmark::ALL.len()],
            decisions: 0,
            fuel: 0,
            decision_fuel_max: 0,
        }
    }
}

/// Averages of score minus floor, in parts.
fn regret(scores: impl Iterator<Item = (Score, Score)> + Clone) -> Option<Regret> {
    let total = scores
        .clone()
        .map(|(score, floor)| Mean::from(score).minus(Mean::from(floor)));
    let exploration = scores.clone().map(|(score, floor)| {
        let more = i128::from(score.exploration_steps()) - i128::from(floor.exploration_steps());
        Mean::fraction(more, i128::from(score.divisor()))
    });
    let speed = scores.map(|(score, floor)| {
        let more = i128::from(score.speed_steps()) - i128::from(floor.speed_steps());
        Mean::fraction(more, 1)
    });
    Some(Regret {
        total: total.collect::<Option<Mean>>()?,
        exploration: exploration.collect::<Option<Mean>>()?,
        speed: speed.collect::<Option<Mean>>()?,
    })
}

fn count<T>(items: impl Iterator<Item = T>) -> u32 {
    u32::try_from(items.count()).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contest::ContestMaze;
    use crate::maze::{Cell, bundled, format};
    use crate::robot::{Digest, Fault, FaultKind, FuelUse, Outcome};
    use crate::sim::{Counts, Ruleset, Run};

    /// A contest in maze 01, whose optimum is 17 steps.
    fn contest() -> Contest {
        let rules = Ruleset::default();
        let maze = format::parse(bundled()[0].text).expect("a maze").maze;
        Contest {
            entrants: Vec::new(),
            mazes: vec![ContestMaze::new("01".into(), maze, &rules)],
            seeds: vec![0],
            rules,
        }
    }

    fn result(verdict: Verdict, steps: [u32; 2], fuel: (u64, u64)) -> MatchResult {
        MatchResult {
            entrant: 0,
            maze: 0,
            seed: 0,
            outcome: Outcome {
                verdict,
                steps,
                counts: Counts::default(),
                fuel: FuelUse {
                    start: 1_000_000,
                    steps: fuel.0,
                    step_max: fuel.1,
                },
            },
            trace: Digest::of(b""),
            journal: (0, 0),
        }
    }

    fn finished(exploration: u32, speed: u32) -> MatchResult {
        let score = Score::new(speed, exploration, 30);
        result(Verdict::Finished(score), [exploration, speed], (600, 20))
    }

    fn fault() -> MatchResult {
        let fault = Fault {
            kind: FaultKind::Interface,
            phase: Phase::NextMove,
            run: Run::Exploration,
            step: 3,
            cell: Cell::new(0, 0),
            detail: String::new(),
        };
        result(Verdict::Fault(fault), [2, 0], (10, 9))
    }

    #[test]
    fn regret_is_split_into_its_parts() {
        // Minnett's final robot in maze 01, and one that needs 3 steps more in run 2.
        let results = [finished(110, 17), finished(18, 20), fault()];
        let tally = Tally::of(&contest(), &results);
        assert_eq!((tally.matches, tally.finished, tally.faults), (3, 2, 1));
        assert_eq!(tally.optimal, 1);
        let regret = tally.regret.expect("two scores");
        assert_eq!(regret.exploration, Mean::fraction(92, 60));
        assert_eq!(regret.speed, Mean::fraction(3, 2));
        assert_eq!(regret.total.to_string(), "3.033");
    }

    #[test]
    fn a_benchmark_is_beaten_by_a_lower_score_only() {
        // 17 + 144 / 30 is the lower benchmark itself.
        let results = [finished(110, 17), finished(144, 17), finished(174, 17)];
        let tally = Tally::of(&contest(), &results);
        let [_, lower, upper, ..] = tally.benchmarks;
        assert_eq!((lower.beaten, upper.beaten), (1, 3));
        // (34 + 0 - 30) / 30 / 3.
        assert_eq!(lower.margin, Some(Mean::fraction(4, 90)));
        assert_eq!(upper.margin, Some(Mean::fraction(4 + 3 * 144, 90)));
    }

    #[test]
    fn every_call_for_an_answer_is_a_decision() {
        let tally = Tally::of(&contest(), &[finished(30, 20), fault()]);
        assert_eq!((tally.decisions, tally.fuel), (53, 610));
        assert_eq!(tally.decision_fuel_mean(), 12);
        assert_eq!(tally.decision_fuel_max, 20);
    }

    #[test]
    fn nothing_has_no_averages() {
        let tally = Tally::of(&contest(), &[]);
        assert_eq!(tally, Tally::default());
        assert_eq!(tally.decision_fuel_mean(), 0);
    }
}
