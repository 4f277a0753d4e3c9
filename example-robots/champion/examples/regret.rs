//! Plays the champion natively in mazes given as files and prints its mean regret:
//! score minus the score of a robot that knows the maze.
//!
//!     wasmouse maze generate gen:division:12..=20:1..=50 -o mazes
//!     cargo run --release -p robot-champion --example regret -- mazes/*
//!
//! Files are of the Udacity text format, with the contest's start and goal. Before them,
//! `-v` prints a line for each, and `-d` plays the setting `deep`.

use robot_champion::Champion;
use wasmouse_sdk::testing::{self, PlayOptions, Stop};
use wasmouse_sdk::{Area, Cell, CellSet, Heading, Passages, Search};

fn main() {
    let mut files: Vec<String> = std::env::args().skip(1).collect();
    let verbose = files.iter().any(|it| it == "-v");
    let setting = u32::from(files.iter().any(|it| it == "-d"));
    files.retain(|it| !it.starts_with('-'));
    let (mut sum, mut scores, mut failed) = (0.0, 0.0, 0);
    let options = PlayOptions {
        setting,
        ..PlayOptions::default()
    };
    let clock = std::time::Instant::now();
    for file in &files {
        let text = std::fs::read_to_string(file).expect("a maze file");
        let played = testing::play::<Champion>(&text, &options);
        let Some(score) = played.score else {
            println!("{file}: {}", played.summary());
            failed += 1;
            continue;
        };
        let score = score.thousandths() as f64 / 1000.0;
        let regret = score - floor(&text);
        if verbose {
            let in_goal = |stop: &Stop| goal(&text).contains(stop.cell);
            let first = played.stops.iter().position(in_goal);
            println!(
                "{file}: {} regret {regret:.3} goal after {first:?}",
                played.summary()
            );
        }
        sum += regret;
        scores += score;
    }
    let count = files.len() - failed;
    println!(
        "{count} finished, {failed} not; mean regret {:.3}, sum of scores {scores:.3}, {:.1} ms a match",
        sum / count as f64,
        clock.elapsed().as_secs_f64() * 1000.0 / files.len() as f64
    );
}

fn goal(maze: &str) -> Area {
    Area::center(passages(maze).dimension())
}

fn floor(maze: &str) -> f64 {
    let passages = passages(maze);
    let mut search = Search::new(passages.dimension(), 3);
    search.fill(&passages, &CellSet::from(goal(maze)));
    let optimum = search
        .steps(Cell::new(0, 0))
        .expect("the goal is reachable");
    f64::from(optimum) + f64::from(optimum + 1) / 30.0
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
