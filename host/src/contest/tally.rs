//! [`Tally`]: the matches of one robot, counted and added up exactly.

use wasmouse_core::game::{Phase, Score, Verdict};
use wasmouse_core::record::MatchRecord;

use super::mean::Mean;

/// Some matches of one robot under one ruleset.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Matches played.
    pub matches: u64,
    /// Matches finished with a score.
    pub finished: u64,
    /// Matches whose budget ran out after the exploration run had reached the goal.
    pub goal_reached: u64,
    /// Matches that ended in a fault.
    pub faults: u64,
    /// Finished matches whose speed run took as few steps as the maze allows.
    pub optimal: u64,
    /// Steps of the robot in all matches, and the calls in which it failed.
    pub steps: u64,
    /// Fuel of all steps together.
    pub fuel: u64,
    /// Fuel of the most expensive step.
    pub step_fuel_max: u64,
    /// The scores, added up.
    score: Sum,
    /// Steps beyond the oracle's in each run of the finished matches, added up.
    exploration: i64,
    speed: i64,
    /// Finished matches whose maze has an oracle score.
    compared: u64,
}

/// Scores with one divisor, added up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Sum {
    exploration_steps: u64,
    speed_steps: u64,
    divisor: u32,
}

/// How much worse than a robot that knows the maze, on average over the finished matches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Regret {
    /// Score minus oracle score: the sum of the two parts.
    pub total: Mean,
    /// The part of the exploration run: its steps beyond the optimal path and the reset, over
    /// the ruleset's divisor.
    pub exploration: Mean,
    /// The part of the speed run: its steps beyond the optimal path.
    pub speed: Mean,
}

impl Tally {
    /// Adds a match in a maze with that oracle score.
    pub fn add(&mut self, record: &MatchRecord, oracle: Option<Score>) {
        self.matches += 1;
        match &record.verdict {
            Verdict::Finished { score } => self.add_score(*score, oracle),
            Verdict::BudgetUsedUp { goal_reached } => self.goal_reached += u64::from(*goal_reached),
            Verdict::Fault { fault } => {
                self.faults += 1;
                self.steps += u64::from(fault.phase == Phase::NextMove);
            }
        }
        self.steps += u64::from(record.steps.total());
        self.fuel += record.fuel.steps;
        self.step_fuel_max = self.step_fuel_max.max(record.fuel.step_max);
    }

    fn add_score(&mut self, score: Score, oracle: Option<Score>) {
        self.finished += 1;
        self.score.exploration_steps += u64::from(score.exploration_steps());
        self.score.speed_steps += u64::from(score.speed_steps());
        self.score.divisor = score.divisor();
        if let Some(oracle) = oracle {
            let more = |ours: u32, least: u32| i64::from(ours) - i64::from(least);
            let speed = more(score.speed_steps(), oracle.speed_steps());
            self.exploration += more(score.exploration_steps(), oracle.exploration_steps());
            self.speed += speed;
            self.optimal += u64::from(speed == 0);
            self.compared += 1;
        }
    }

    /// Adds all matches of another tally.
    pub fn merge(&mut self, other: &Self) {
        self.matches += other.matches;
        self.finished += other.finished;
        self.goal_reached += other.goal_reached;
        self.faults += other.faults;
        self.optimal += other.optimal;
        self.steps += other.steps;
        self.fuel += other.fuel;
        self.step_fuel_max = self.step_fuel_max.max(other.step_fuel_max);
        self.score.exploration_steps += other.score.exploration_steps;
        self.score.speed_steps += other.score.speed_steps;
        self.score.divisor = self.score.divisor.max(other.score.divisor);
        self.exploration += other.exploration;
        self.speed += other.speed;
        self.compared += other.compared;
    }

    /// The average score of the finished matches; `None` when there is none.
    pub fn mean_score(&self) -> Option<Mean> {
        let divisor = i128::from(self.score.divisor);
        let speed = i128::from(self.score.speed_steps) * divisor;
        let sum = speed + i128::from(self.score.exploration_steps);
        (self.finished > 0).then(|| Mean::fraction(sum, divisor * i128::from(self.finished)))
    }

    /// The average regret of the finished matches; `None` when there is none.
    pub fn mean_regret(&self) -> Option<Regret> {
        if self.compared == 0 {
            return None;
        }
        let count = i128::from(self.compared);
        let divisor = i128::from(self.score.divisor);
        let (exploration, speed) = (i128::from(self.exploration), i128::from(self.speed));
        Some(Regret {
            total: Mean::fraction(exploration + speed * divisor, divisor * count),
            exploration: Mean::fraction(exploration, divisor * count),
            speed: Mean::fraction(speed, count),
        })
    }

    /// Average fuel of a step, to the nearest unit; 0 without steps.
    pub const fn step_fuel_mean(&self) -> u64 {
        match self.steps {
            0 => 0,
            steps => (self.fuel + steps / 2) / steps,
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use wasmouse_core::game::{Counts, Fault, FaultKind, Run, Steps};
    use wasmouse_core::journal::JournalCounts;
    use wasmouse_core::maze::Cell;
    use wasmouse_core::record::{FuelUse, MatchKey, RecordVersion};
    use wasmouse_core::{Digest, GuestText};

    use super::*;

    /// The oracle score of maze 01.
    const ORACLE: Score = Score::new(17, 18, 30);

    fn record(verdict: Verdict, steps: [u32; 2], fuel: (u64, u64)) -> MatchRecord {
        let digest = Digest::of(b"");
        MatchRecord {
            version: RecordVersion,
            key: MatchKey {
                engine: digest,
                rules: digest,
                robot: digest,
                variant: 0,
                maze: digest,
                seed: 0,
            },
            verdict,
            steps: Steps {
                exploration: steps[0],
                speed: steps[1],
            },
            counts: Counts::default(),
            fuel: FuelUse {
                start: 1_000_000,
                steps: fuel.0,
                step_max: fuel.1,
            },
            memory_bytes: 65_536,
            journal: JournalCounts::default(),
            transcript: digest,
        }
    }

    pub(in super::super) fn finished(exploration: u32, speed: u32) -> MatchRecord {
        let score = Score::new(speed, exploration, 30);
        record(Verdict::Finished { score }, [exploration, speed], (600, 20))
    }

    pub(in super::super) fn fault(kind: FaultKind) -> MatchRecord {
        let fault = Fault {
            kind,
            phase: Phase::NextMove,
            run: Run::Exploration,
            step: 3,
            cell: Cell::new(0, 0),
            detail: GuestText::new(),
        };
        record(Verdict::Fault { fault }, [2, 0], (10, 9))
    }

    fn tally(records: &[MatchRecord]) -> Tally {
        let mut tally = Tally::default();
        for record in records {
            tally.add(record, Some(ORACLE));
        }
        tally
    }

    #[test]
    fn regret_is_split_into_its_parts() {
        // Minnett's final robot in maze 01, and one that needs 3 steps more in the speed run.
        let records = [finished(110, 17), finished(18, 20), fault(FaultKind::Panic)];
        let tally = tally(&records);
        assert_eq!((tally.matches, tally.finished, tally.faults), (3, 2, 1));
        assert_eq!(tally.optimal, 1);
        let regret = tally.mean_regret().expect("two scores");
        assert_eq!(regret.exploration, Mean::fraction(92, 60));
        assert_eq!(regret.speed, Mean::fraction(3, 2));
        assert_eq!(regret.total.to_string(), "3.033");
        let mean = tally.mean_score().expect("two scores");
        assert_eq!(mean, Mean::fraction(37 * 30 + 128, 60));
    }

    #[test]
    fn tallies_add_up() {
        let records = [finished(110, 17), fault(FaultKind::Panic), finished(18, 20)];
        let mut sum = tally(&records[..1]);
        sum.merge(&tally(&records[1..]));
        assert_eq!(sum, tally(&records));
        assert_eq!((sum.steps, sum.fuel), (127 + 3 + 38, 1210));
        assert_eq!((sum.step_fuel_mean(), sum.step_fuel_max), (7, 20));
    }

    #[test]
    fn nothing_has_no_averages() {
        let tally = Tally::default();
        assert_eq!((tally.mean_score(), tally.mean_regret()), (None, None));
        assert_eq!(tally.step_fuel_mean(), 0);
    }
}
