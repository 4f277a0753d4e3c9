//! `fuzz`: runs fuzz targets for as long as somebody wants, and keeps what they fail on.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use clap::Parser;
use wasmouse_tests::fuzz::{Finding, Fuzzer, Smith, Summary, Target, quiet_panics, targets};

/// Feed changed inputs to what reads a stranger's bytes, and keep what it fails on.
#[derive(Parser)]
struct Cli {
    /// Only these targets; --list tells their names
    #[arg(value_name = "TARGET")]
    only: Vec<String>,
    /// Minutes for each target
    #[arg(long, default_value = "30", value_name = "MINUTES", value_parser = minutes)]
    minutes: Duration,
    /// Where the random numbers begin; another one each time by default
    #[arg(long)]
    seed: Option<u64>,
    /// Where inputs go that something is wrong with
    #[arg(
        long,
        value_name = "FOLDER",
        default_value = "target/fuzz",
        overrides_with = "findings"
    )]
    findings: PathBuf,
    /// The program `smith`, which makes modules for the targets that take them
    #[arg(long, value_name = "FILE")]
    smith: Option<PathBuf>,
    /// Try the inputs in these files instead, with one target
    #[arg(long, value_name = "FILE", num_args = 1..)]
    replay: Vec<PathBuf>,
    /// Write the inputs that runs begin with to FOLDER/TARGET instead, for another fuzzer
    #[arg(long, value_name = "FOLDER")]
    seeds: Option<PathBuf>,
    /// Say what there is to fuzz
    #[arg(long)]
    list: bool,
}

/// The longest that an input may take, on a machine that may be busy with other things.
const INPUT_TIME_MAX: Duration = Duration::from_secs(60);

/// Time between two looks at the clock.
const LOOK_TIME: Duration = Duration::from_millis(500);

/// What the process may grow by while one target runs, in KiB.
const GROWTH_KIB_MAX: u64 = 512 << 10;

/// Inputs between two looks at the memory.
const LOOK_EVERY: usize = 16;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let is_meant =
        |target: &Target| cli.only.is_empty() || cli.only.iter().any(|it| it == target.name);
    let chosen: Vec<Target> = targets().into_iter().filter(is_meant).collect();
    if cli.list {
        for target in targets() {
            println!("{:<16} {}", target.name, target.about);
        }
        return ExitCode::SUCCESS;
    }
    if chosen.is_empty() {
        eprintln!("error: there is no such target; --list tells all");
        return ExitCode::FAILURE;
    }
    let outcome = match &cli.seeds {
        Some(folder) => write_seeds(folder, &chosen).map(|()| 0),
        None => run(&cli, &chosen),
    };
    match outcome {
        Ok(0) => ExitCode::SUCCESS,
        Ok(count) => {
            eprintln!("{count} findings, in {}", cli.findings.display());
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn write_seeds(folder: &Path, targets: &[Target]) -> io::Result<()> {
    for target in targets {
        let seeds = (target.seeds)();
        let folder = folder.join(target.name);
        for seed in &seeds {
            save(&folder, &format!("{:016x}", digest(seed)), seed)?;
        }
        println!("{} inputs in `{}`", seeds.len(), folder.display());
    }
    Ok(())
}

/// Runs the targets one after the other and counts what is wrong.
fn run(cli: &Cli, targets: &[Target]) -> io::Result<usize> {
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    ctrlc::set_handler(move || asked.store(true, Ordering::Relaxed)).map_err(io::Error::other)?;
    quiet_panics();
    let seed = cli.seed.unwrap_or_else(any_seed);
    let mut count = 0;
    for target in targets {
        let folder = cli.findings.join(target.name);
        let watch = Watch::start(folder.clone())?;
        count += if cli.replay.is_empty() {
            fuzz(*target, (cli, seed), &folder, (&watch, &stop))?
        } else {
            replay(*target, &cli.replay, &watch)?
        };
        watch.end();
        if stop.load(Ordering::Relaxed) {
            break;
        }
    }
    Ok(count)
}

/// A time in minutes, of which a part may be meant.
fn minutes(text: &str) -> Result<Duration, String> {
    let minutes: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    Duration::try_from_secs_f64(minutes * 60.0).map_err(|error| error.to_string())
}

fn any_seed() -> u64 {
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    now.map_or(0, |now| now.as_secs())
}

fn fuzz(
    target: Target,
    (cli, seed): (&Cli, u64),
    folder: &Path,
    (watch, stop): (&Watch, &AtomicBool),
) -> io::Result<usize> {
    let time = cli.minutes;
    let minutes = time.as_secs_f64() / 60.0;
    println!("{}: seed {seed}, {minutes} minutes", target.name);
    let mut smith = match &cli.smith {
        Some(program) if target.takes_modules => Some(Smith::start(program)?),
        _ => None,
    };
    let mut fuzzer = Fuzzer::new(target, seed);
    let begin = Instant::now();
    let mut told = begin;
    let mut memory = Memory::new();
    while begin.elapsed() < time && !stop.load(Ordering::Relaxed) {
        let number = fuzzer.summary().inputs;
        if let Some(smith) = &mut smith
            && number.is_multiple_of(2)
        {
            let module = smith.module(seed.wrapping_add(number))?;
            let wrapping = [u8::from(number.is_multiple_of(4))];
            fuzzer.add([&wrapping[..], &module].concat());
        }
        let input = fuzzer.next_input();
        watch.begin(&input);
        memory.remember(&input);
        let finding = fuzzer.feed(input);
        watch.pause();
        if let Some(finding) = finding {
            tell(target, &finding, folder)?;
        }
        memory.look(folder)?;
        if told.elapsed() >= Duration::from_secs(60) {
            told = Instant::now();
            println!("  {}", line(fuzzer.summary(), begin.elapsed(), &memory));
        }
    }
    let summary = fuzzer.summary();
    let line = line(summary, begin.elapsed(), &memory);
    println!("{}: {line}", target.name);
    Ok(summary.findings.len() + memory.findings)
}

fn line(summary: &Summary, time: Duration, memory: &Memory) -> String {
    let seconds = time.as_secs_f64().max(0.001);
    format!(
        "{:.1} min, {} inputs, {:.0}/s, {} behaviours, slowest {:.2} s, {} MiB (at first {}), \
         {} findings",
        seconds / 60.0,
        summary.inputs,
        summary.inputs as f64 / seconds,
        summary.behaviours,
        summary.slowest.as_secs_f64(),
        resident_kib("VmRSS:") >> 10,
        memory.first_kib >> 10,
        summary.findings.len() + memory.findings,
    )
}

fn tell(target: Target, finding: &Finding, folder: &Path) -> io::Result<()> {
    let name = format!("panic-{:016x}", digest(&finding.input));
    let path = save(folder, &name, &finding.input)?;
    println!("{}: {}", target.name, finding.panic);
    println!("  input: {}", path.display());
    Ok(())
}

fn save(folder: &Path, name: &str, input: &[u8]) -> io::Result<PathBuf> {
    fs::create_dir_all(folder)?;
    let path = folder.join(name);
    fs::write(&path, input)?;
    Ok(path)
}

/// A name for the input: FNV-1a.
fn digest(input: &[u8]) -> u64 {
    input.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

fn replay(target: Target, files: &[PathBuf], watch: &Watch) -> io::Result<usize> {
    let mut run = (target.make)();
    for file in files {
        let input = fs::read(file)
            .map_err(|error| io::Error::other(format!("`{}`: {error}", file.display())))?;
        watch.begin(&input);
        let begin = Instant::now();
        let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| run(&input)));
        watch.pause();
        let told = outcome.unwrap_or_else(|_| "PANIC".into());
        println!("{}: {told} ({:?})", file.display(), begin.elapsed());
    }
    Ok(0)
}

/// The memory of the process, and the inputs since somebody last looked at it.
struct Memory {
    first_kib: u64,
    peak_kib: u64,
    recent: Vec<Vec<u8>>,
    findings: usize,
}

impl Memory {
    fn new() -> Self {
        Self {
            first_kib: resident_kib("VmRSS:"),
            peak_kib: resident_kib("VmHWM:"),
            recent: Vec::new(),
            findings: 0,
        }
    }

    fn remember(&mut self, input: &[u8]) {
        self.recent.push(input.to_vec());
    }

    /// Keeps the recent inputs when one of them has taken much.
    fn look(&mut self, folder: &Path) -> io::Result<()> {
        if self.recent.len() < LOOK_EVERY {
            return Ok(());
        }
        let peak = resident_kib("VmHWM:");
        if peak > self.peak_kib + GROWTH_KIB_MAX {
            println!("memory grew from {} to {peak} KiB", self.peak_kib);
            for (number, input) in self.recent.iter().enumerate() {
                save(folder, &format!("memory-{peak}-{number}"), input)?;
            }
            self.findings += 1;
            self.peak_kib = peak;
        }
        self.recent.clear();
        Ok(())
    }
}

/// A line of the kernel's about this process, in KiB; 0 where there is none.
fn resident_kib(name: &str) -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(name));
    let number = line.and_then(|line| line.split_whitespace().next());
    number.and_then(|number| number.parse().ok()).unwrap_or(0)
}

/// Ends the process when an input takes too long, and keeps the input.
struct Watch {
    current: Arc<Mutex<Current>>,
}

#[derive(Default)]
struct Current {
    since: Option<Instant>,
    input: Vec<u8>,
    is_over: bool,
}

impl Watch {
    fn start(folder: PathBuf) -> io::Result<Self> {
        let current = Arc::new(Mutex::new(Current::default()));
        let watched = Arc::clone(&current);
        thread::Builder::new().name("watch".into()).spawn(move || {
            loop {
                let begin = Instant::now();
                thread::sleep(LOOK_TIME);
                // While the whole process is stopped, no input takes time.
                let stopped = begin.elapsed().saturating_sub(2 * LOOK_TIME);
                let mut current = lock(&watched);
                current.since = current.since.map(|since| since + stopped);
                if current.is_over {
                    return;
                }
                let is_late = |since: Instant| since.elapsed() > INPUT_TIME_MAX;
                if current.since.is_some_and(is_late) {
                    let name = format!("hang-{:016x}", digest(&current.input));
                    println!("an input takes more than {INPUT_TIME_MAX:?}");
                    match save(&folder, &name, &current.input) {
                        Ok(path) => println!("  input: {}", path.display()),
                        Err(error) => println!("  it cannot be kept: {error}"),
                    }
                    std::process::exit(1);
                }
            }
        })?;
        Ok(Self { current })
    }

    fn begin(&self, input: &[u8]) {
        let mut current = lock(&self.current);
        current.since = Some(Instant::now());
        current.input.clear();
        current.input.extend_from_slice(input);
    }

    fn pause(&self) {
        lock(&self.current).since = None;
    }

    fn end(&self) {
        lock(&self.current).is_over = true;
    }
}

fn lock(current: &Mutex<Current>) -> MutexGuard<'_, Current> {
    current.lock().unwrap_or_else(PoisonError::into_inner)
}
