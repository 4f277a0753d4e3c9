//! `wasmouse run`: robots in mazes, with a verdict and a score for each match.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use super::exit::Exit;
use super::failure::Failure;
use super::mazes::{self, Legality};
use super::output::{self, Existing};
use super::robots::{self, Specification};
use super::setup::{IsolationArgs, SetupArgs};
use super::{explain, interrupt, journal, page, terminal, twice, watch};
use crate::contest::{Contest, ContestMaze, Entrant, MatchResult, Pairing, Played, standings};
use crate::maze::bundled as bundled_mazes;
use crate::report::result::ContestReport;
use crate::report::table;
use crate::report::visible;
use crate::robot::bundled::bundled as bundled_robots;
use crate::robot::{Referee, Verdict};

const EXAMPLES: &str = "\
Examples:
  wasmouse run flood                          a bundled robot in the bundled mazes
  wasmouse run my-robot.wasm maze.txt         your robot in your maze
  wasmouse run flood dfs gen:tree:16:1..=100  two robots in 100 generated mazes
  wasmouse run random --maze test_maze_01 --repeat 20
  wasmouse run flood test_maze_01 --watch
  wasmouse run flood old-contest --lenient --json > results.json

Exit codes:
  0  every robot was admitted and every match ended without a fault; a robot
     that did not finish within its steps is no fault
  4  a robot was refused or ended a match with a fault; all others were played
  5  the host failed, or --twice found a difference
  130  interrupted; what was played by then has been printed";

/// Run robots in mazes and print verdicts, scores and standings.
///
/// Among the arguments, the names of bundled robots and files that end in .wasm
/// are robots; everything else is a maze. Without a maze, the bundled ones are
/// used. Every robot plays every maze, each match in a fresh sandbox.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!(
    "{}\n\n{}\n\n{EXAMPLES}", robots::SPECIFICATION_HELP, mazes::SPECIFICATION_HELP
))]
pub struct Args {
    /// Robots and mazes, in any order
    #[arg(value_name = "ROBOT|MAZE")]
    arguments: Vec<String>,
    /// A robot, whatever its file is called
    #[arg(long = "robot", value_name = "ROBOT")]
    robots: Vec<String>,
    /// A maze, whatever its file is called
    #[arg(long = "maze", short, value_name = "MAZE")]
    mazes: Vec<String>,
    /// The first seed; a robot's only source of chance
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Play each robot in each maze this many times, with seed, seed + 1, ...
    #[arg(long, value_name = "COUNT", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    repeat: u32,
    /// Play everything twice, in another way the second time, and fail when any
    /// byte is not the same
    #[arg(long)]
    twice: bool,
    /// Use mazes that break contest rules as they are
    #[arg(long)]
    lenient: bool,
    /// Print JSON: every match with hashes, steps and fuel
    #[arg(long, conflicts_with = "html")]
    json: bool,
    /// Also write a web page with the standings and pictures
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Replace FILE when it is there
    #[arg(long, requires = "html")]
    force: bool,
    /// Print what the robots write to their journals, on standard error
    #[arg(long)]
    log: bool,
    /// Show the match step by step on the terminal; for one robot in one maze
    #[arg(long, conflicts_with_all = ["json", "html", "log"])]
    watch: bool,
    /// Time between the steps that --watch shows, in milliseconds
    #[arg(long, value_name = "MS", default_value_t = 120, requires = "watch",
          value_parser = clap::value_parser!(u64).range(0..=60_000))]
    delay: u64,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let (specifications, maze_specs) = args.sort_arguments()?;
    if let Some(path) = &args.html {
        output::check(path, args.existing())?;
    }
    let legality = Legality::from_flag(args.lenient);
    let mazes = mazes::load(&maze_specs, legality)?;
    let referee = args.setup.referee_for_all(&args.isolation)?;
    let contest = Contest {
        entrants: robots::load(&specifications, &referee)?,
        mazes: mazes
            .into_iter()
            .map(|named| ContestMaze::new(named.name, named.maze, &args.setup.rules))
            .collect(),
        seeds: args.seeds()?,
        rules: args.setup.rules,
    };
    let threads = args.setup.threads();
    let played = play(&contest, &referee, threads)?;
    let twice = if args.twice {
        twice::check(&contest, &played, &specifications, threads, &args.isolation)?
    } else {
        Exit::Success
    };
    if args.watch && !played.results.is_empty() {
        let delay = Duration::from_millis(args.delay);
        watch::watch(&contest, &referee, &played.results, delay, args.ascii)?;
    }
    if args.log {
        journal::print(&contest, &referee, &played.results)?;
    }
    args.report(&contest, &referee, &played)?;
    if !args.json {
        explain::tell(&contest, &referee, &specifications, &played.results)?;
    }
    let exit = exit(&contest, &played);
    Ok(match twice {
        Exit::Success => exit,
        interrupted => interrupted,
    })
}

/// Plays a contest with a progress bar on a terminal; Ctrl-C ends it early.
pub fn play(contest: &Contest, referee: &Referee, threads: usize) -> Result<Played, Failure> {
    play_only(contest, &contest.pairings(), referee, threads)
}

/// Plays these matches of a contest as [`play`] plays all.
pub fn play_only(
    contest: &Contest,
    pairings: &[Pairing],
    referee: &Referee,
    threads: usize,
) -> Result<Played, Failure> {
    let cancelled: &AtomicBool = interrupt::listen()?;
    let total = u64::try_from(pairings.len()).unwrap_or(u64::MAX);
    let bar = ProgressBar::new(total).with_style(
        ProgressStyle::with_template("{bar:40} {pos}/{len} matches, {per_sec}, {eta} left")
            .expect("a constant template"),
    );
    let played = contest
        .run_only(pairings, referee, threads, cancelled, &|| bar.inc(1))
        .map_err(Failure::host);
    bar.finish_and_clear();
    played
}

/// The exit code that goes with what was played; tells on standard error what
/// was not.
pub fn exit(contest: &Contest, played: &Played) -> Exit {
    for failed in &played.failed {
        let robot = visible(&contest.entrants[failed.entrant].name);
        let maze = visible(&contest.mazes[failed.maze].name);
        let (seed, error) = (failed.seed, &failed.error);
        tell!("error: `{robot}` in `{maze}`, seed {seed}, was not played: {error}");
    }
    let missing = contest.matches() - played.results.len() - played.failed.len();
    if missing > 0 {
        tell!("interrupted: {missing} matches were not played");
        return Exit::Interrupted;
    }
    let is_fault = |result: &MatchResult| matches!(result.outcome.verdict, Verdict::Fault(_));
    let is_refused = |entrant: &Entrant| entrant.admission.is_err();
    if !played.failed.is_empty() {
        Exit::Host
    } else if contest.entrants.iter().any(is_refused) || played.results.iter().any(is_fault) {
        Exit::Robot
    } else {
        Exit::Success
    }
}

/// Tells on standard error why robots were refused or failed.
pub fn tell_failures(contest: &Contest, results: &[MatchResult]) {
    for entrant in &contest.entrants {
        if let Err(refusal) = &entrant.admission {
            let (name, reason) = (visible(&entrant.name), visible(&refusal.to_string()));
            tell!("refused `{name}`: {reason}\n  hint: {}", refusal.hint());
        }
    }
    // The same fault in every maze is told once for each, up to a screenful.
    const TOLD_MAX: usize = 20;
    let faults = results
        .iter()
        .filter_map(|result| match &result.outcome.verdict {
            Verdict::Fault(fault) => Some((result, fault)),
            Verdict::Finished(_) | Verdict::BudgetUsedUp { .. } => None,
        });
    let count = faults.clone().count();
    for (result, fault) in faults.take(TOLD_MAX) {
        let robot = visible(&contest.entrants[result.entrant].name);
        let maze = visible(&contest.mazes[result.maze].name);
        let fault = visible(&fault.to_string());
        tell!("fault of `{robot}` in `{maze}`: {fault}");
    }
    if count > TOLD_MAX {
        tell!("and {} more faults; --json lists all", count - TOLD_MAX);
    }
}

impl Args {
    /// Which arguments are robots and which are mazes.
    fn sort_arguments(&self) -> Result<(Vec<Specification>, Vec<String>), Failure> {
        let mut robots = Vec::new();
        let mut mazes = Vec::new();
        for argument in &self.arguments {
            if Specification::is_meant_by(argument) {
                robots.push(Specification::parse(argument)?);
            } else {
                mazes.push(argument.clone());
            }
        }
        for text in &self.robots {
            robots.push(Specification::parse(text)?);
        }
        mazes.extend(self.mazes.iter().cloned());
        if robots.is_empty() {
            return Err(self.no_robot());
        }
        if mazes.is_empty() {
            mazes.extend(bundled_mazes().iter().map(|maze| maze.name.to_owned()));
        }
        Ok((robots, mazes))
    }

    fn no_robot(&self) -> Failure {
        let message = match self.arguments.first() {
            None => "no robot is given".to_owned(),
            Some(argument) => format!(
                "no robot is given: `{}` is neither a bundled robot nor a file that ends in .wasm",
                visible(argument)
            ),
        };
        let names: Vec<&str> = bundled_robots().iter().map(|robot| robot.name).collect();
        Failure::usage(message).hint(format!(
            "bundled robots are {}; --robot takes a file of any name",
            names.join(", ")
        ))
    }

    fn seeds(&self) -> Result<Vec<u64>, Failure> {
        let last = self.seed.checked_add(u64::from(self.repeat - 1));
        let last = last.ok_or_else(|| {
            Failure::usage(format!(
                "seed {} repeated {} times passes the largest seed",
                self.seed, self.repeat
            ))
            .hint("choose a smaller --seed")
        })?;
        Ok((self.seed..=last).collect())
    }

    fn report(&self, contest: &Contest, referee: &Referee, played: &Played) -> Result<(), Failure> {
        let results = &played.results;
        let standings = standings(contest, results);
        if self.json {
            return output::print(&ContestReport::new(contest, played, &standings).to_json());
        }
        let lines = terminal::table_lines(self.ascii);
        if !results.is_empty() {
            output::print(&table::matches(contest, results, lines))?;
        }
        if contest.entrants.len() > 1 || results.len() > 1 {
            output::print(&format!(
                "\n{}",
                table::standings(contest, &standings, lines)
            ))?;
        }
        tell_failures(contest, results);
        if let Some(path) = &self.html {
            page::write(path, self.existing(), contest, referee, results, &standings)?;
        }
        Ok(())
    }

    const fn existing(&self) -> Existing {
        if self.force {
            Existing::Replace
        } else {
            Existing::Keep
        }
    }
}
