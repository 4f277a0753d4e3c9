//! `corpus`: plays the hostile corpus through the `wasmouse` binary and prints a table, or
//! writes the files for another host.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

use clap::Parser;
use serde_json::{Value, json};
use wasmouse_tests::binary;
use wasmouse_tests::corpus::{Bench, Case, Judgement, Mode, cases};

/// Play the hostile corpus and print the outcome of each case.
#[derive(Parser)]
struct Cli {
    /// Only cases with this number, or with this in their name
    #[arg(value_name = "CASE")]
    only: Vec<String>,
    /// Also play the cases that take up to minutes each
    #[arg(long)]
    long: bool,
    /// Also print the reason of each rejection and fault
    #[arg(long)]
    reasons: bool,
    /// Only this mode: `sandboxed` or `trusted`
    #[arg(long, value_name = "MODE", value_parser = mode)]
    mode: Option<Mode>,
    /// Write the files and `index.json` to this folder and play nothing
    #[arg(long, value_name = "FOLDER")]
    write: Option<PathBuf>,
    /// The program to test [default: the one beside this program]
    #[arg(long, value_name = "FILE")]
    wasmouse: Option<PathBuf>,
}

fn mode(name: &str) -> Result<Mode, String> {
    Mode::ALL
        .into_iter()
        .find(|mode| mode.name() == name)
        .ok_or_else(|| "expected `sandboxed` or `trusted`".to_owned())
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let cases: Vec<Case> = cases()
        .into_iter()
        .filter(|case| is_meant(&cli, case))
        .collect();
    if cases.is_empty() {
        eprintln!("error: no such case (--long adds some)");
        return ExitCode::FAILURE;
    }
    let outcome = match &cli.write {
        Some(folder) => write(folder, &cases).map(|()| true),
        None => play(&cli, &cases),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn is_meant(cli: &Cli, case: &Case) -> bool {
    let fits = |text: &String| match text.parse::<u8>() {
        Ok(number) => case.numbers.contains(&number),
        Err(_) => case.name.contains(text.as_str()),
    };
    let is_played = cli.long || !case.is_long || cli.write.is_some();
    is_played && (cli.only.is_empty() || cli.only.iter().any(fits))
}

/// Plays the cases, in both modes at the same time; `true` when all have passed.
fn play(cli: &Cli, cases: &[Case]) -> io::Result<bool> {
    let is_meant = |mode: &Mode| cli.mode.is_none_or(|only| only == *mode);
    println!(
        "{:<6} {:<44} {:<9} {:<34} {:>6} {:>5} {:>5} {:>7}  ok",
        "number", "name", "mode", "verdict", "s", "MiB", "all", "ns/fuel"
    );
    let begin = Instant::now();
    let totals: Vec<Total> = thread::scope(|scope| {
        let modes: Vec<_> = Mode::ALL
            .into_iter()
            .filter(is_meant)
            .map(|mode| scope.spawn(move || play_in(cli, cases, mode)))
            .collect();
        let join = |mode: ScopedJoinHandle<'_, _>| {
            mode.join()
                .unwrap_or_else(|_| Err(io::Error::other("a thread panicked")))
        };
        modes.into_iter().map(join).collect::<io::Result<_>>()
    })?;
    for total in &totals {
        println!(
            "{}: {} cases in {:.0} s, {} failed; peak memory {} MiB in the process that was \
             started, {} MiB in all processes",
            total.mode.name(),
            total.count,
            total.time.as_secs_f64(),
            total.bad,
            total.first_bytes >> 20,
            total.all_bytes >> 20,
        );
    }
    println!("{:.0} s", begin.elapsed().as_secs_f64());
    Ok(totals.iter().all(|total| total.bad == 0))
}

/// The outcomes of all cases in a mode.
struct Total {
    mode: Mode,
    count: u32,
    bad: u32,
    time: Duration,
    first_bytes: u64,
    all_bytes: u64,
}

fn play_in(cli: &Cli, cases: &[Case], mode: Mode) -> io::Result<Total> {
    let program = cli.wasmouse.clone().unwrap_or_else(binary::path);
    let bench = Bench::new(&program)?;
    let begin = Instant::now();
    let mut total = Total {
        mode,
        count: 0,
        bad: 0,
        time: Duration::ZERO,
        first_bytes: 0,
        all_bytes: 0,
    };
    for case in cases {
        let judgement = bench.judge(case, mode)?;
        println!("{}", row(cli, case, mode, &judgement));
        total.count += 1;
        total.bad += u32::from(!judgement.is_well());
        total.first_bytes = total.first_bytes.max(judgement.first_bytes);
        total.all_bytes = total.all_bytes.max(judgement.all_bytes);
    }
    total.time = begin.elapsed();
    Ok(total)
}

fn row(cli: &Cli, case: &Case, mode: Mode, judgement: &Judgement) -> String {
    let mut row = format!(
        "{:<6} {:<44} {:<9} {:<34} {:>6.2} {:>5} {:>5} {:>7}  {}",
        case.numbers_text(),
        case.name,
        mode.name(),
        judgement.verdict,
        judgement.time.as_secs_f64(),
        judgement.first_bytes >> 20,
        judgement.all_bytes >> 20,
        nanoseconds_per_fuel(judgement),
        if judgement.is_well() { "ok" } else { "NO" },
    );
    if cli.reasons && !judgement.reason.is_empty() {
        row += &format!("\n       {}", judgement.reason.escape_debug());
    }
    for problem in &judgement.problems {
        row += &format!(
            "\n       expected {}; {}",
            judgement.expected,
            problem.escape_debug()
        );
    }
    row
}

/// Where a robot used so much fuel that the rest does not count.
fn nanoseconds_per_fuel(judgement: &Judgement) -> String {
    const FUEL_MIN: u64 = 500_000_000;
    /// What starting the program and the good robot take.
    const AROUND: Duration = Duration::from_millis(60);
    if judgement.fuel < FUEL_MIN {
        return String::new();
    }
    let nanoseconds = judgement.time.saturating_sub(AROUND).as_secs_f64() * 1e9;
    #[expect(clippy::cast_precision_loss, reason = "a figure to look at")]
    let each = nanoseconds / judgement.fuel as f64;
    format!("{each:.2}")
}

/// Writes every file as `NAME.wasm`, and the cases as `index.json`.
fn write(folder: &Path, cases: &[Case]) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let mut index = Vec::new();
    for case in cases {
        let mut names = Vec::new();
        let files = case.files();
        for (at, file) in files.iter().enumerate() {
            let name = if files.len() > 1 {
                format!("{}-{at:05}.wasm", case.name)
            } else {
                format!("{}.wasm", case.name)
            };
            fs::write(folder.join(&name), file)?;
            names.push(name);
        }
        index.push(entry(case, &names));
    }
    let index = json!({"schema": 1, "cases": index});
    let text = serde_json::to_string_pretty(&index)?;
    fs::write(folder.join("index.json"), format!("{text}\n"))?;
    println!("{} cases in `{}`", cases.len(), folder.display());
    Ok(())
}

fn entry(case: &Case, files: &[String]) -> Value {
    json!({
        "numbers": case.numbers,
        "name": case.name,
        "files": files,
        "expected_one_of": case.expected,
        "seconds_max": case.seconds_max,
        "mebibytes_max": case.megabytes_max,
        "arguments": case.arguments,
    })
}
