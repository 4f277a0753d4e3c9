//! Plays the champion natively in mazes given as files and prints, for each folder, its
//! mean regret (score minus the score of a robot that knows the maze) with the standard
//! error of the mean, and what it is made of.
//!
//!     wasmouse maze generate gen:division:12..=20:1..=50 -o division
//!     wasmouse maze generate gen:tree,loops=12:12..=20:1..=50 -o tree
//!     cargo run --release -p robot-champion --example regret -- -d division/* tree/*
//!
//! Files are of the Udacity text format, with the contest's start and goal. Before them,
//! `-v` prints a line for each, and `-d` plays the variant `deep`.
//!
//! The parts of the regret, which add up to it, in steps of the speed run: what it took to
//! reach the goal for the first time, beyond the fewest steps and divided by 30; what
//! was explored from then on, divided by 30; what the speed run took beyond the fewest steps.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

use robot_champion::Champion;
use wasmouse_sdk::testing::{self, PlayOptions, Played};
use wasmouse_sdk::{Area, Cell, CellSet, Heading, Passages, Search};

fn main() {
    let mut files: Vec<String> = std::env::args().skip(1).collect();
    let verbose = files.iter().any(|it| it == "-v");
    let variant = u32::from(files.iter().any(|it| it == "-d"));
    files.retain(|it| !it.starts_with('-'));
    let options = PlayOptions::of_variant(variant);
    let mut sets: BTreeMap<String, Set> = BTreeMap::new();
    for file in &files {
        let text = std::fs::read_to_string(file).expect("a maze file");
        let clock = Instant::now();
        let played = testing::play::<Champion>(&text, &options);
        let milliseconds = clock.elapsed().as_secs_f64() * 1000.0;
        let parts = Parts::of(&played, &text);
        if verbose || parts.is_none() {
            let parts = parts.map_or_else(String::new, Parts::line);
            println!("{file}: {} {parts}", played.summary());
        }
        let folder = Path::new(file).parent().unwrap_or(Path::new(""));
        let set = sets.entry(folder.display().to_string()).or_default();
        set.milliseconds.push(milliseconds);
        set.scores += played.score.map_or(0, |it| it.thousandths());
        set.matches.extend(parts);
    }
    for (folder, set) in sets {
        println!("{folder}: {}", set.line());
    }
}

/// The regret of a match, in steps of the speed run.
#[derive(Clone, Copy)]
struct Parts {
    to_goal: f64,
    from_goal: f64,
    race: f64,
}

impl Parts {
    /// `None` of a match that was not finished.
    fn of(played: &Played, maze: &str) -> Option<Self> {
        played.score?;
        let passages = passages(maze);
        let goal = Area::center(passages.dimension());
        let mut search = Search::new(passages.dimension(), 3);
        search.fill(&passages, &CellSet::from(goal));
        let optimum = f64::from(search.steps(Cell::new(0, 0))?);
        let first = played.stops.iter().position(|it| goal.contains(it.cell))? as f64;
        let exploration = f64::from(played.exploration_steps) - 1.0;
        Some(Self {
            to_goal: (first - optimum) / 30.0,
            from_goal: (exploration - first) / 30.0,
            race: f64::from(played.speed_steps) - optimum,
        })
    }

    fn sum(self) -> f64 {
        self.to_goal + self.from_goal + self.race
    }

    fn line(self) -> String {
        format!(
            "regret {:.3} = to the goal {:.3} + from the goal {:.3} + race {:.3}",
            self.sum(),
            self.to_goal,
            self.from_goal,
            self.race
        )
    }
}

/// The matches in the mazes of a folder.
#[derive(Default)]
struct Set {
    /// Those that were finished.
    matches: Vec<Parts>,
    /// Their scores added up, in thousandths.
    scores: u64,
    /// How long each match took.
    milliseconds: Vec<f64>,
}

impl Set {
    fn line(&self) -> String {
        let mean = |part: fn(Parts) -> f64| mean(self.matches.iter().map(|it| part(*it)));
        let means = Parts {
            to_goal: mean(|it| it.to_goal),
            from_goal: mean(|it| it.from_goal),
            race: mean(|it| it.race),
        };
        let regrets: Vec<f64> = self.matches.iter().map(|it| it.sum()).collect();
        let times = self.milliseconds.iter().copied();
        format!(
            "{} finished, {} not; {} (standard error {:.3}); sum of scores {:.3}; \
             {:.1} ms a match, at most {:.1}",
            self.matches.len(),
            self.milliseconds.len() - self.matches.len(),
            means.line(),
            standard_error(&regrets),
            self.scores as f64 / 1000.0,
            times.clone().sum::<f64>() / self.milliseconds.len() as f64,
            times.fold(0.0, f64::max)
        )
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// Of the mean.
fn standard_error(values: &[f64]) -> f64 {
    let mean = mean(values.iter().copied());
    let squares: f64 = values.iter().map(|it| (it - mean).powi(2)).sum();
    let count = values.len() as f64;
    (squares / (count - 1.0) / count).sqrt()
}

/// The passages of a maze in the Udacity format.
fn passages(text: &str) -> Passages {
    let mut lines = text.lines();
    let dimension = lines.next().and_then(|it| it.trim().parse().ok());
    let mut passages = Passages::all_closed(dimension.expect("a dimension"));
    for (x, line) in (0..).zip(lines) {
        for (y, value) in (0..).zip(line.split(',')) {
            let value: u8 = value.trim().parse().expect("a number");
            for (bit, side) in Heading::ALL.into_iter().enumerate() {
                if value >> bit & 1 == 1 {
                    passages.open(Cell::new(x, y), side);
                }
            }
        }
    }
    passages
}
