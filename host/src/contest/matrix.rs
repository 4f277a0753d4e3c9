//! [`ScoreMatrix`]: what robots did in mazes, compact. Standings, comparisons, grades and reports
//! of contests are computed from it.
//!
//! It holds numbers only: 56 bytes a match, so that a million matches fit into memory. It comes
//! from a store, or from a contest in progress through [`MatrixBuilder`], which is a sink.

use std::collections::BTreeMap;
use std::io;

use wasmouse_core::game::{FaultKind, Ruleset, Score, Steps, Verdict};
use wasmouse_core::record::{FuelUse, MatchRecord};
use wasmouse_core::{Digest, GuestText};

use super::maze_source::ContestMaze;
use super::plan::{NotAdmitted, Plan, Seeds};
use super::sink::{ContestMatch, MatchFailure, Sink};

/// Robots by mazes by seeds.
#[derive(Clone, Debug)]
pub struct ScoreMatrix {
    /// The rules of all matches.
    pub rules: Ruleset,
    /// The seeds of every maze.
    pub seeds: Seeds,
    /// The robots, in the order of the plan.
    pub robots: Vec<MatrixRobot>,
    /// The sets that mazes belong to. At least one.
    pub sets: Vec<MazeSet>,
    /// The mazes that have been prepared, in the order of the plan.
    pub mazes: Vec<MatrixMaze>,
    /// By maze, then seed, then robot; `None` for a match that was not played.
    cells: Vec<Option<MatchScore>>,
}

/// A robot of a [`ScoreMatrix`].
#[derive(Clone, Debug)]
pub struct MatrixRobot {
    /// What the standings call it. Names are unique.
    pub name: GuestText,
    /// Who submitted it, if that is known.
    pub author: Option<GuestText>,
    /// The class that it competes in, such as a fuel class.
    pub class: Option<GuestText>,
    /// The digest of its file.
    pub digest: Digest,
    /// The number that chooses its mode.
    pub variant: u32,
    /// Why it plays no match, if so.
    pub not_admitted: Option<NotAdmitted>,
    /// Its faults by the name of the kind.
    pub faults: BTreeMap<&'static str, MatrixFault>,
    /// Matches that were not played, by reason: the host failed, or the robot was withdrawn.
    pub unplayed: BTreeMap<GuestText, u64>,
    /// How many of those the host failed to play.
    pub failed: u64,
}

/// The faults of one kind of one robot.
#[derive(Clone, Debug)]
pub struct MatrixFault {
    /// How many matches ended so.
    pub count: u64,
    /// The first of them, in the order of the plan.
    pub first: MatchRecord,
}

/// A set of mazes that is scored by itself, too.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MazeSet {
    /// What reports call it.
    pub name: String,
    /// Whether reports for contestants must not show its mazes.
    pub is_hidden: bool,
    /// How many times each of its mazes counts. Range: 1 to 1000.
    pub weight: u32,
}

/// A maze of a [`ScoreMatrix`].
#[derive(Clone, Debug)]
pub struct MatrixMaze {
    /// What results call it.
    pub name: GuestText,
    /// Its digest.
    pub digest: Digest,
    /// Cells along a side.
    pub dimension: u8,
    /// The score of a robot that knows the maze; `None` when the goal cannot be reached.
    pub oracle: Option<Score>,
    /// Index of its set.
    pub set: usize,
}

/// The numbers of a match that was played.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MatchScore {
    /// How it ended.
    pub outcome: Outcome,
    /// Steps of both runs; those of a finished match make its score.
    pub steps: Steps,
    /// The fuel that the robot used.
    pub fuel: FuelUse,
    /// The linear memory that it had at the end, in bytes.
    pub memory_bytes: u64,
}

/// How a match ended, without the details of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// With a score.
    Finished,
    /// The step budget is used up.
    BudgetUsedUp {
        /// Whether the exploration run had reached the goal.
        goal_reached: bool,
    },
    /// The robot failed.
    Fault(FaultKind),
}

impl MatchScore {
    /// The numbers of a record.
    pub fn new(record: &MatchRecord) -> Self {
        let outcome = match &record.verdict {
            Verdict::Finished { .. } => Outcome::Finished,
            Verdict::BudgetUsedUp { goal_reached } => Outcome::BudgetUsedUp {
                goal_reached: *goal_reached,
            },
            Verdict::Fault { fault } => Outcome::Fault(fault.kind),
        };
        Self {
            outcome,
            steps: record.steps,
            fuel: record.fuel,
            memory_bytes: record.memory_bytes,
        }
    }

    /// The score; `None` unless finished.
    pub fn score(&self, rules: &Ruleset) -> Option<Score> {
        let is_finished = self.outcome == Outcome::Finished;
        let Steps { exploration, speed } = self.steps;
        is_finished.then(|| rules.game.score(speed, exploration))
    }
}

impl MatrixRobot {
    /// A robot without matches.
    pub fn new(name: impl Into<GuestText>, digest: Digest, variant: u32) -> Self {
        Self {
            name: name.into(),
            author: None,
            class: None,
            digest,
            variant,
            not_admitted: None,
            faults: BTreeMap::new(),
            unplayed: BTreeMap::new(),
            failed: 0,
        }
    }

    /// Adds a fault to its summary, if the record has one. Records must come in the order of
    /// the plan.
    pub fn count_fault(&mut self, record: &MatchRecord) {
        if let Some(fault) = record.verdict.fault() {
            self.faults
                .entry(fault.kind.name())
                .and_modify(|it| it.count += 1)
                .or_insert_with(|| MatrixFault {
                    count: 1,
                    first: record.clone(),
                });
        }
    }
}

impl ScoreMatrix {
    /// A matrix without mazes, with one set of weight 1 that is called `mazes`.
    pub fn new(rules: Ruleset, seeds: Seeds, robots: Vec<MatrixRobot>) -> Self {
        let set = MazeSet {
            name: "mazes".to_owned(),
            is_hidden: false,
            weight: 1,
        };
        Self {
            rules,
            seeds,
            robots,
            sets: vec![set],
            mazes: Vec::new(),
            cells: Vec::new(),
        }
    }

    /// Adds a maze that no robot has played, and returns its index.
    pub fn push_maze(&mut self, maze: MatrixMaze) -> usize {
        let index = self.mazes.len();
        self.mazes.push(maze);
        let cells = self.cells.len() + self.robots.len() * self.seeds.count as usize;
        self.cells.resize(cells, None);
        index
    }

    /// The match of a robot in a maze with the seed at that position; `None` if it was not
    /// played.
    pub fn get(&self, robot: usize, maze: usize, seed: u32) -> Option<&MatchScore> {
        self.cells[self.index(robot, maze, seed)].as_ref()
    }

    /// The matches of all robots in a maze with the seed at that position, by robot.
    pub fn row(&self, maze: usize, seed: u32) -> &[Option<MatchScore>] {
        let first = self.index(0, maze, seed);
        &self.cells[first..first + self.robots.len()]
    }

    /// Records a match that was played.
    pub fn set(&mut self, robot: usize, maze: usize, seed: u32, score: MatchScore) {
        let index = self.index(robot, maze, seed);
        self.cells[index] = Some(score);
    }

    /// How often a maze counts.
    pub fn weight(&self, maze: usize) -> u32 {
        self.sets[self.mazes[maze].set].weight
    }

    /// How many matches were played.
    pub fn played(&self) -> u64 {
        self.cells.iter().flatten().count() as u64
    }

    fn index(&self, robot: usize, maze: usize, seed: u32) -> usize {
        let row = maze * self.seeds.count as usize + seed as usize;
        row * self.robots.len() + robot
    }
}

/// Fills a [`ScoreMatrix`] while a contest is played.
#[derive(Debug)]
pub struct MatrixBuilder {
    matrix: ScoreMatrix,
    /// By player, the robots that it stands for.
    robots: Vec<Vec<usize>>,
}

impl MatrixBuilder {
    /// The matrix of a plan, without mazes.
    pub fn new(plan: &Plan) -> Self {
        let robots = plan.entrants.iter().map(|entrant| {
            let mut robot = MatrixRobot::new(entrant.name.clone(), entrant.digest, entrant.variant);
            robot.not_admitted = entrant.admission.as_ref().err().cloned();
            robot
        });
        let rules = Ruleset::clone(&plan.rules);
        let players = plan.players().into_iter();
        Self {
            matrix: ScoreMatrix::new(rules, plan.seeds, robots.collect()),
            robots: players.map(|it| it.entrants).collect(),
        }
    }

    /// The matrix of everything that has arrived.
    pub fn finish(self) -> ScoreMatrix {
        self.matrix
    }

    fn unplayed(&mut self, failure: &MatchFailure, has_failed: bool) {
        let key = &failure.key;
        let robots = self.matrix.robots.iter_mut();
        for robot in robots.filter(|it| it.digest == key.robot && it.variant == key.variant) {
            *robot.unplayed.entry(failure.reason.clone()).or_default() += 1;
            robot.failed += u64::from(has_failed);
        }
    }
}

impl Sink for MatrixBuilder {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.matrix.push_maze(MatrixMaze {
            name: maze.name.clone(),
            digest: maze.digest,
            dimension: maze.maze.dimension(),
            oracle: maze.oracle,
            set: 0,
        });
        Ok(())
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        let maze = self.matrix.mazes.len() - 1;
        let seed = played.record.key.seed;
        let seed = seed.wrapping_sub(self.matrix.seeds.first) as u32;
        let score = MatchScore::new(&played.record);
        for &robot in &self.robots[played.player] {
            self.matrix.set(robot, maze, seed, score);
            self.matrix.robots[robot].count_fault(&played.record);
        }
        Ok(())
    }

    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.unplayed(failure, true);
        Ok(())
    }

    fn withdrawn(&mut self, failure: &MatchFailure) -> io::Result<()> {
        self.unplayed(failure, false);
        Ok(())
    }
}
