//! [`MazeSet`]: the matches of all robots in some mazes, counted as they are played.

use std::collections::BTreeMap;
use std::io;

use wasmouse::contest::{ContestMatch, ContestMaze, MatchFailure, Mean, Sink, Tally};
use wasmouse_core::game::Verdict;
use wasmouse_core::journal::JournalCounts;
use wasmouse_core::record::MatchRecord;
use wasmouse_core::{Digest, GuestText};

use crate::published::{BENCHMARK_SCALE, BENCHMARKS};

/// Some matches of one robot.
#[derive(Clone, Copy, Default)]
pub struct Counts {
    /// Scores, regrets and fuel.
    pub tally: Tally,
    /// Finished matches with a score below each benchmark.
    pub beaten: [u64; BENCHMARKS.len()],
    /// Benchmarks minus scores of the finished matches, added up, times [`BENCHMARK_SCALE`].
    margins: [i64; BENCHMARKS.len()],
}

impl Counts {
    fn add(&mut self, record: &MatchRecord, maze: &ContestMaze) {
        self.tally.add(record, maze.oracle);
        let (Verdict::Finished { score }, Some(oracle)) = (&record.verdict, maze.oracle) else {
            return;
        };
        let cells = i64::from(maze.maze.dimension()).pow(2);
        let thirtieths =
            i64::from(score.exploration_steps()) * BENCHMARK_SCALE / i64::from(score.divisor());
        let speed = i64::from(score.speed_steps()) - i64::from(oracle.speed_steps());
        for (position, (_, per_cell)) in BENCHMARKS.iter().enumerate() {
            let margin = cells * per_cell - speed * BENCHMARK_SCALE - thirtieths;
            self.beaten[position] += u64::from(margin > 0);
            self.margins[position] += margin;
        }
    }

    /// Adds all matches of others.
    pub fn sum<'a>(all: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut sum = Self::default();
        for counts in all {
            sum.tally.merge(&counts.tally);
            for position in 0..BENCHMARKS.len() {
                sum.beaten[position] += counts.beaten[position];
                sum.margins[position] += counts.margins[position];
            }
        }
        sum
    }

    /// By how much the scores of the finished matches are below a benchmark, on average.
    pub fn margin(&self, benchmark: usize) -> Option<Mean> {
        let count = i128::from(self.tally.finished) * i128::from(BENCHMARK_SCALE);
        (count > 0).then(|| Mean::fraction(self.margins[benchmark].into(), count))
    }
}

/// The matches of one robot in a [`MazeSet`].
#[derive(Clone, Default)]
pub struct RobotCounts {
    /// By size of the maze.
    pub by_size: BTreeMap<u8, Counts>,
    /// Matches in which the robot wrote nothing to its journal.
    pub silent: Counts,
    /// The names of the mazes that it did not finish.
    pub unfinished: Vec<GuestText>,
}

impl RobotCounts {
    /// All matches.
    pub fn all(&self) -> Counts {
        Counts::sum(self.by_size.values())
    }
}

/// Some mazes that belong together, with the matches in them.
pub struct MazeSet {
    /// What the page calls them.
    pub name: String,
    /// How many there are.
    pub mazes: u64,
    /// One entry for each robot.
    pub robots: Vec<RobotCounts>,
    digests: Vec<u8>,
    maze: Option<ContestMaze>,
}

impl MazeSet {
    /// A set without matches.
    pub fn new(name: impl Into<String>, robots: usize) -> Self {
        Self {
            name: name.into(),
            mazes: 0,
            robots: vec![RobotCounts::default(); robots],
            digests: Vec::new(),
            maze: None,
        }
    }

    /// The digest of the digests of all mazes, in their order.
    pub fn digest(&self) -> Digest {
        Digest::of(&self.digests)
    }
}

impl Sink for MazeSet {
    fn maze(&mut self, maze: &ContestMaze) -> io::Result<()> {
        self.mazes += 1;
        self.digests.extend(maze.digest.as_bytes());
        self.maze = Some(maze.clone());
        Ok(())
    }

    fn played(&mut self, played: &ContestMatch) -> io::Result<()> {
        let maze = self.maze.as_ref().expect("a maze precedes its matches");
        let robot = &mut self.robots[played.player];
        let record = &played.record;
        let of_size = robot.by_size.entry(maze.maze.dimension()).or_default();
        of_size.add(record, maze);
        if record.journal == JournalCounts::default() {
            robot.silent.add(record, maze);
        }
        if record.verdict.score().is_none() {
            robot.unfinished.push(maze.name.clone());
        }
        Ok(())
    }

    /// A page without some of the matches would mislead.
    fn failed(&mut self, failure: &MatchFailure) -> io::Result<()> {
        Err(io::Error::other(failure.reason.escaped().to_string()))
    }
}
