//! The speed targets: measured, printed as a table, met or missed.
//!
//! Not criterion: a target is a ratio of two things, and those are timed in turns.
//! A missed target is no failure, because a busy machine misses them too.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;
use std::{env, fs};

use wasmouse_core::game::Ruleset;
use wasmouse_core::maze::Maze;
use wasmouse_core::record::Transcript;
use wasmouse_engine::{CompiledRobot, Recording, Runtime, bundled};

use super::boundary::{Bare, Drive};
use super::contest::{Place, Stage};
use super::pairs::{alone, side_by_side};
use super::{native, process, stage};

/// Matches after which the memory may not have grown.
const MATCHES: u32 = 100_000;

/// Whether this is a run of everything, or of the table of that name alone
/// (`cargo bench -- targets`): not of a choice of benchmarks, nor a test of them.
pub fn are_wanted(table: &str) -> bool {
    let arguments: Vec<String> = env::args().skip(1).collect();
    arguments.iter().all(|it| it == "--bench" || it == table)
        && arguments.iter().any(|it| it == "--bench")
}

/// Measures all targets and prints the table.
pub fn print() {
    println!(
        "\n{:<58} {:>10} {:>10}",
        "speed target", "at most", "measured"
    );
    boundary();
    first_answer();
    matches();
    whole_process();
    isolation();
    memory();
}

fn row(name: &str, most: &str, measured: &str, is_met: bool, detail: &str) {
    let verdict = if is_met { "met" } else { "MISSED" };
    println!("{name:<58} {most:>10} {measured:>10}  {verdict:<6}  {detail}");
}

fn ratio_row(name: &str, most: f64, measured: f64, detail: &str) {
    let [most_text, measured_text] = [most, measured].map(|ratio| format!("{ratio:.2}x"));
    row(name, &most_text, &measured_text, measured <= most, detail);
}

fn time_row(name: &str, most: Duration, measured: Duration) {
    let [most_text, measured_text] = [most, measured].map(|time| format!("{time:.1?}"));
    row(name, &most_text, &measured_text, measured <= most, "");
}

fn boundary() {
    let driver = stage::driver();
    let mut drive = Drive::new(&driver);
    drive.play();
    let readings = drive.readings();
    let mut bare = Bare::new(&driver);
    let pair = side_by_side(|| drive.play(), || bare.answer(&readings));
    let steps = readings.len() as f64;
    let [step, call] = [pair.first, pair.second].map(|it| it.as_secs_f64() * 1e9 / steps);
    ratio_row(
        "a step of a match / a bare typed call",
        1.5,
        pair.ratio,
        &format!("{step:.0} ns / {call:.0} ns"),
    );
}

fn first_answer() {
    let most = Duration::from_micros(10);
    let flood = bundled::find("flood").expect("a bundled robot").component;
    for (name, component) in [
        ("smallest robot", stage::driver()),
        ("flood", flood.to_vec()),
    ] {
        let mut drive = Drive::with_budget(&component, 1);
        let time = alone(10_000, || drive.play());
        time_row(&format!("instance to first answer, {name}"), most, time);
    }
}

/// In both variants: `certain` computes more in each step than `reset`.
fn matches() {
    let runtime = stage::runtime();
    let flood = stage::robot(&runtime, "flood");
    let mazes = stage::match_mazes();
    for (variant, variant_name) in [(0, "reset"), (1, "certain")] {
        for (name, maze) in &mazes {
            let name = format!("{variant_name}, {name}");
            one_match(&runtime, &flood, (maze, variant), &name);
        }
    }
}

fn one_match(runtime: &Runtime, flood: &CompiledRobot, (maze, variant): (&Maze, u32), name: &str) {
    let rules = Arc::new(Ruleset::default());
    let spec = stage::spec(flood, (maze, variant), &rules);
    let mut recording = Recording::default();
    let mut transcript = Transcript::default();
    let pair = side_by_side(
        || {
            black_box(stage::play(runtime, flood, &spec, &mut recording));
        },
        || native::play(black_box(maze), &rules.game, variant, &mut transcript),
    );
    assert_eq!(
        recording.transcript, transcript,
        "both have played the same match"
    );
    let (wasm, native) = (pair.first, pair.second);
    let steps = transcript.actions().count();
    let sandbox = wasm.saturating_sub(native).as_nanos() / steps as u128;
    ratio_row(
        &format!("flood in wasm / native, {name}"),
        2.0,
        pair.ratio,
        &format!("{wasm:.1?} / {native:.1?}, {steps} steps, {sandbox} ns a step more"),
    );
}

fn whole_process() {
    let cache = tempfile::tempdir().expect("a folder for temporary files");
    let cache = cache.path().join("robots");
    let time = alone(41, || process::run_flood(&cache));
    let name = "`wasmouse run flood test_maze_01`, warm cache";
    time_row(name, Duration::from_millis(60), time);
}

/// What it costs that robots run in sandboxed processes, and what a second thread is worth.
fn isolation() {
    let mazes = "gen:tree:16:1..=400";
    let stage = |place, jobs| Stage::new(&[("flood", 0)], mazes, jobs, place);
    let [inside, workers] = [Place::Here, Place::Workers].map(|place| stage(place, 2));
    let pair = side_by_side(|| workers.play(1), || inside.play(1));
    let (there, here) = (pair.first, pair.second);
    ratio_row(
        "400 matches in workers / here, 1 thread",
        1.1,
        pair.ratio,
        &format!("{there:.1?} / {here:.1?}"),
    );
    for (name, stage) in [("in process", &inside), ("in workers", &workers)] {
        let pair = side_by_side(|| stage.play(2), || stage.play(1));
        ratio_row(
            &format!("400 matches on two threads / one, {name}"),
            1.0 / 1.9,
            pair.ratio,
            &format!(
                "{:.1?} / {:.1?}, {:.2} times as fast",
                pair.first,
                pair.second,
                1.0 / pair.ratio
            ),
        );
    }
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let robot = folder.path().join("flood.wasm");
    let flood = bundled::find("flood").expect("a bundled robot").component;
    fs::write(&robot, flood).expect("a folder to write to");
    let cache = folder.path().join("robots");
    let pair = side_by_side(
        || process::run_file(&robot, &cache, &[]),
        || process::run_file(&robot, &cache, &["--trust"]),
    );
    time_row(
        "`wasmouse run FILE` more than with --trust, warm cache",
        Duration::from_millis(25),
        pair.first.saturating_sub(pair.second),
    );
}

/// Plays very many matches on one runtime. Prints nothing where the system does not say how much
/// memory a process has.
fn memory() {
    let runtime = stage::runtime();
    let flood = stage::robot(&runtime, "flood");
    let rules = Arc::new(Ruleset::default());
    let (_, maze) = stage::match_mazes().swap_remove(0);
    let spec = stage::spec(&flood, (&maze, 0), &rules);
    let mut recording = Recording::default();
    let mut many = |matches: u32| {
        for _ in 0..matches {
            black_box(stage::play(&runtime, &flood, &spec, &mut recording));
        }
        resident_kib()
    };
    let (Some(before), Some(after)) = (many(MATCHES / 100), many(MATCHES)) else {
        println!("memory: not measured, the system does not say");
        return;
    };
    let growth = after.saturating_sub(before);
    row(
        &format!("growth of memory in {MATCHES} matches"),
        "256 KiB",
        &format!("{growth} KiB"),
        growth <= 256,
        &format!("{before} KiB before, {after} KiB after"),
    );
}

/// Memory of this process that is resident, in KiB.
fn resident_kib() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}
