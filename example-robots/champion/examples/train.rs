//! Trains the champion's parameters and writes `src/parameters.rs`.
//!
//!     cargo build
//!     cargo run --release -p robot-champion --example train
//!     cargo run --release -p robot-champion --example train -- tune
//!
//! Counts, for each kind of maze that `training.toml` names, how often a wall is open
//! under each of the 256 patterns of its neighbours, in mazes that the `wasmouse`
//! binary generates (`$WASMOUSE`, else `target/debug/wasmouse`). The scalars stay as
//! they are; `tune` searches for them anew. From the start that `training.toml` gives, it
//! changes those of one kind after the other, each scalar up and down in turn, and keeps a
//! change that makes the mean regret of `fast` in the tuning mazes of that kind smaller
//! (coordinate search; Hooke and Jeeves, *Direct Search Solution of Numerical and
//! Statistical Problems*, 1961). It takes some twenty minutes on two cores. The same seeds
//! give the same file, byte for byte.

use std::path::{Path, PathBuf};
use std::process::Command;

use robot_champion::parameters::{KINDS, SCALARS};
use robot_champion::{Champion, Parameters};
use serde::Deserialize;
use wasmouse_sdk::testing::{self, PlayOptions, Score};
use wasmouse_sdk::{
    Action, Area, Briefing, Cell, CellSet, Grid, Heading, Passages, Robot, Search, Sensors,
};

#[derive(Deserialize)]
struct Training {
    patterns: Patterns,
    tuning: Tuning,
}

#[derive(Deserialize)]
struct Patterns {
    #[serde(flatten)]
    set: Set,
    smoothing: f64,
}

#[derive(Deserialize)]
struct Tuning {
    #[serde(flatten)]
    set: Set,
    start: [[f32; Parameters::COUNT]; KINDS],
}

#[derive(Deserialize)]
struct Set {
    kinds: Vec<String>,
    sizes: String,
    first_seed: u64,
    last_seed: u64,
}

fn main() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(home.join("training.toml")).expect("training.toml");
    let training: Training = toml::from_str(&text).expect("training.toml has the tables");
    let Patterns { set, smoothing } = &training.patterns;
    assert_eq!(
        training.tuning.set.kinds, set.kinds,
        "scalars go with the tables"
    );
    let scalars = match std::env::args().nth(1).as_deref() {
        None => SCALARS,
        Some("tune") => tune(&training.tuning),
        Some(other) => panic!("`{other}` is not `tune`"),
    };
    let tables: Vec<[u16; 256]> = set
        .kinds
        .iter()
        .map(|kind| count(&set.mazes(kind), *smoothing))
        .collect();
    let path = home.join("src/parameters.rs");
    std::fs::write(&path, print(set, &scalars, &tables)).expect("the sources can be written");
    eprintln!("wrote {}", path.display());
}

impl Set {
    /// The mazes of one kind, in the Udacity format.
    fn mazes(&self, kind: &str) -> Vec<String> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let spec = format!(
            "gen:{kind}:{}:{}..={}",
            self.sizes, self.first_seed, self.last_seed
        );
        let status = Command::new(wasmouse())
            .args(["maze", "generate", &spec, "--output"])
            .arg(folder.path())
            .arg("--force")
            .status();
        let made = status.expect("the wasmouse binary runs: `cargo build` makes it");
        assert!(made.success(), "wasmouse maze generate {spec}: {made}");
        let files = std::fs::read_dir(folder.path()).expect("a folder of mazes");
        let mut files: Vec<PathBuf> = files.map(|it| it.expect("a file").path()).collect();
        files.sort();
        let read = |path: &PathBuf| std::fs::read_to_string(path).expect("a maze");
        files.iter().map(read).collect()
    }
}

fn wasmouse() -> PathBuf {
    let built = || {
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(
            || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target"),
            PathBuf::from,
        );
        target.join("debug/wasmouse")
    };
    std::env::var_os("WASMOUSE").map_or_else(built, PathBuf::from)
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

/// For each pattern the chance of an open wall, in 65536ths.
fn count(mazes: &[String], smoothing: f64) -> [u16; 256] {
    // Closed and open, by pattern; a wall counts for its four mirror images alike.
    let mut counts = [[0u64; 2]; 256];
    for maze in mazes {
        count_maze(&passages(maze), &mut counts);
    }
    let open: u64 = counts.iter().map(|it| it[1]).sum();
    let all: u64 = counts.iter().map(|it| it[0] + it[1]).sum();
    let mean = open as f64 / all as f64;
    counts.map(|[closed, open]| {
        // A quarter for each mirror image.
        let (closed, open) = (closed as f64 / 4.0, open as f64 / 4.0);
        let chance = (open + smoothing * mean) / (closed + open + smoothing);
        (chance.clamp(0.004, 0.996) * 65536.0) as u16
    })
}

fn count_maze(passages: &Passages, counts: &mut [[u64; 2]; 256]) {
    let grid = Grid::new(passages.dimension());
    let goal = Area::center(passages.dimension());
    // Walls beyond the perimeter count as open, as in the robot's belief.
    let mut open = vec![true; grid.wall_count()];
    let area = Area::new(Cell::new(0, 0), passages.dimension(), passages.dimension());
    for cell in area.cells() {
        for side in Heading::ALL {
            open[grid.wall(grid.cell(cell), side)] = passages.is_open(cell, side);
        }
    }
    for wall in grid.inner_walls() {
        let cells = grid.sides(wall).map(|it| grid.at(it));
        // Given by the contest's rules, not drawn.
        let by_start = cells == [Cell::new(0, 0), Cell::new(1, 0)];
        if by_start || cells.iter().any(|&it| goal.contains(it)) {
            continue;
        }
        let around = grid.neighborhood(wall).map(|it| open[it]);
        for image in mirror_images(around) {
            let bits = image.iter().enumerate();
            let pattern = bits.fold(0, |sum, (place, &it)| sum | usize::from(it) << place);
            counts[pattern][usize::from(open[wall])] += 1;
        }
    }
}

/// Along the wall, across it, and both.
fn mirror_images(it: [bool; 8]) -> [[bool; 8]; 4] {
    let along = |it: [bool; 8]| [it[1], it[0], it[4], it[5], it[2], it[3], it[6], it[7]];
    let across = |it: [bool; 8]| [it[0], it[1], it[3], it[2], it[5], it[4], it[7], it[6]];
    [it, along(it), across(it), along(across(it))]
}

fn print(set: &Set, scalars: &[Parameters], tables: &[[u16; 256]]) -> String {
    let mut text = format!(
        "//! The champion's parameters. Written by `examples/train.rs` from the generated mazes\n\
         //! that `training.toml` names; do not edit.\n\n\
         use crate::Parameters;\n\n\
         /// How many kinds of mazes there are parameters for.\n\
         pub const KINDS: usize = {};\n\n\
         /// By kind ({}): the scalars with which the robot plays best.\n\
         #[rustfmt::skip]\n\
         pub const SCALARS: [Parameters; KINDS] = {scalars:#?};\n\n\
         /// By kind ({}) and pattern of the neighbours:\n\
         /// the chance that a wall is open, in 65536ths.\n\
         #[rustfmt::skip]\n\
         pub const PATTERNS: [[u16; 256]; KINDS] = [\n",
        tables.len(),
        set.kinds.join("; "),
        set.kinds.join("; ")
    );
    for table in tables {
        text += "    [\n";
        for row in table.chunks(16) {
            let row: Vec<String> = row.iter().map(u16::to_string).collect();
            text += &format!("        {},\n", row.join(", "));
        }
        text += "    ],\n";
    }
    text + "];\n"
}

/// The champion with the scalars of this thread.
struct Tuned(Champion);

thread_local! {
    static TRIED: std::cell::Cell<[Parameters; KINDS]> = const { std::cell::Cell::new(SCALARS) };
}

impl Robot for Tuned {
    fn start(briefing: &Briefing) -> Self {
        Self(Champion::with_parameters(briefing, TRIED.get()))
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        self.0.next_move(sensors)
    }
}

/// What a scalar is multiplied by.
const FACTORS: [f32; 2] = [1.25, 0.8];

/// A change has to make the mean regret smaller by this much.
const GAIN_MIN: f64 = 0.001;

/// The scalars of each kind after the search.
fn tune(Tuning { set, start }: &Tuning) -> [Parameters; KINDS] {
    let mut best = start.map(Parameters::from_array);
    for (index, kind) in set.kinds.iter().enumerate() {
        let mazes = set.mazes(kind);
        let mut least = mean_regret(&mazes, &best);
        eprintln!("{kind}: {least:.4}");
        // The last change that helped; the search ends when all others have been tried.
        let mut helped = (Parameters::COUNT - 1, 1);
        'search: loop {
            for scalar in 0..Parameters::COUNT {
                for (turn, factor) in FACTORS.into_iter().enumerate() {
                    let mut tried = best;
                    let mut scalars = tried[index].to_array();
                    scalars[scalar] *= factor;
                    tried[index] = Parameters::from_array(scalars);
                    let regret = mean_regret(&mazes, &tried);
                    if regret < least - GAIN_MIN {
                        (best, least, helped) = (tried, regret, (scalar, turn));
                        eprintln!("{kind}: {least:.4} with {:?}", best[index]);
                    } else if helped == (scalar, turn) {
                        break 'search;
                    }
                }
            }
        }
    }
    best
}

/// Regret: score minus oracle score, in steps.
fn mean_regret(mazes: &[String], parameters: &[Parameters; KINDS]) -> f64 {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let part = mazes.len().div_ceil(threads);
    // Whole numbers: their sum is the same on any number of threads.
    let sum: i64 = std::thread::scope(|scope| {
        let parts: Vec<_> = mazes
            .chunks(part)
            .map(|mazes| {
                scope.spawn(|| {
                    TRIED.set(*parameters);
                    mazes.iter().map(|it| regret(it)).sum::<i64>()
                })
            })
            .collect();
        let sums = parts.into_iter().map(|it| it.join().expect("no panic"));
        sums.sum()
    });
    sum as f64 / 1000.0 / mazes.len() as f64
}

/// Score minus the score of a robot that knows the maze, in thousandths of a step.
fn regret(maze: &str) -> i64 {
    let played = testing::play::<Tuned>(maze, &PlayOptions::default());
    let score = played.score.expect("the champion finishes");
    score.thousandths() as i64 - oracle_score(maze).thousandths() as i64
}

/// The score of a robot that knows the maze.
fn oracle_score(maze: &str) -> Score {
    let passages = passages(maze);
    let goal = CellSet::from(Area::center(passages.dimension()));
    let mut search = Search::new(passages.dimension(), 3);
    search.fill(&passages, &goal);
    let optimum = search.steps(Cell::new(0, 0)).expect("a legal maze");
    Score::new(optimum, optimum + 1, 30)
}
