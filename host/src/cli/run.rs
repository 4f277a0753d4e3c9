//! `wasmouse run`: robots in mazes, with a verdict and a score for each match.

use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use wasmouse_core::maze::bundled as bundled_mazes;
use wasmouse_engine::LocalExecutor;

use super::entrants;
use super::exit::Exit;
use super::failure::Failure;
use super::keep::{KeepArgs, ReplaySink};
use super::maze_source;
use super::mazes::{self, BadFiles, Legality};
use super::output::{self, Draft, Existing, Stdout, message};
use super::page::PageBuilder;
use super::play::{Pace, play_all};
use super::robots::{self, RobotSpec};
use super::setup::{IsolationArgs, SeedArgs, SetupArgs, TimeArgs};
use super::verdict::{exit, print_faults};
use super::{
    backtrace, complaints, explain, fail_under, interrupt, log, player, reproduce, terminal,
};
use crate::contest::grade::Thresholds;
use crate::contest::{
    Complaints, ContestInfo, FaultSummary, MatrixBuilder, Plan, Player, RESULTS_VERSION,
    RecordList, Results, ScoreMatrix, Sink, StandingsBuilder, Summary, SummaryBuilder, Tee,
};
use crate::report::escape::for_terminal;
use crate::report::jsonl::JsonLines;
use crate::report::results_json::ResultsWriter;
use crate::report::table;
use crate::report::text::Text;
use crate::report::text::text;

const EXAMPLES: &str = "\
Examples:
  wasmouse run flood                          a bundled robot in the bundled mazes
  wasmouse run my-robot                       build a robot project and run it
  wasmouse run my-robot.wasm maze.txt         your robot in your maze
  wasmouse run submissions mazes -o out.json  every robot of a folder in every maze of another
  wasmouse run flood dfs gen:tree:16:1..=100  two robots in 100 generated mazes
  wasmouse run random --maze test_maze_01 --repeat 20
  wasmouse run flood test_maze_01 --watch
  wasmouse run flood champion test_maze_01 --watch
  wasmouse run my-robot test_maze_01 --explain
  wasmouse run flood dfs --replays replays    keeps the best match of each
  wasmouse run my-robot --fail-under finished=95%,regret=12.5,faults=0

Exit codes:
  0  every robot was admitted, no match ended in a fault, and at least one was
     finished
  1  a robot missed a threshold of --fail-under, or --reproduce found a difference
  4  a robot was rejected or faulted; all other robots still played
  5  internal error, or a robot took too long or could not be admitted or played
     for a reason of the host; everything else was played
  6  no robot finished any match
  129, 130, 143  ended by SIGHUP, Ctrl-C or SIGTERM; what was played by then has
     been written";

/// More matches than this are only listed when asked for.
const LISTED_MAX: u64 = 40;

/// Run robots in mazes and print verdicts, scores and standings
///
/// Names of bundled robots, files that end in .wasm or .wat, folders of them and
/// robot projects are robots; everything else is a maze. Without a maze, the bundled
/// mazes are used. Every robot plays every maze, each match in a fresh sandbox.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!(
    "{}\n\n{}\n\n{EXAMPLES}", robots::SPECIFICATION_HELP, mazes::SPECIFICATION_HELP
))]
#[command(group = clap::ArgGroup::new("files").multiple(true))]
pub struct Args {
    /// Robots and mazes, in any order
    #[arg(value_name = "ROBOT|MAZE")]
    arguments: Vec<String>,
    /// Treat this argument as a robot, whatever its file extension
    #[arg(long = "robot", value_name = "ROBOT")]
    robots: Vec<String>,
    /// Treat this argument as a maze, whatever its file extension
    #[arg(long = "maze", short, value_name = "MAZE")]
    mazes: Vec<String>,
    #[command(flatten)]
    seeds: SeedArgs,
    /// Play every match twice, the second time reordered and recompiled, and fail
    /// if results differ
    #[arg(long)]
    reproduce: bool,
    /// Fail if a robot misses one of these: KEY=VALUE, separated by commas. At least
    /// finished=PERCENT; at most score=STEPS and regret=STEPS on average (an unfinished match
    /// counts as the worst score), faults=MATCHES, fuel=UNITS (a step, on average)
    #[arg(long, value_name = "LIST", value_parser = thresholds)]
    fail_under: Option<Thresholds>,
    /// Accept mazes that break contest rules
    #[arg(long)]
    lenient: bool,
    /// Fail on a bad maze file in a folder instead of skipping it
    #[arg(long)]
    strict: bool,
    /// Print the results as JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Write the results to FILE: JSON, or one match per line if it ends in .jsonl
    #[arg(long, short, value_name = "FILE", group = "files")]
    output: Option<PathBuf>,
    /// Write a web page with the standings and pictures to FILE
    #[arg(long, value_name = "FILE", group = "files")]
    html: Option<PathBuf>,
    /// Overwrite FILE if it exists
    #[arg(long, requires = "files")]
    force: bool,
    /// Print the table of matches even if it is long (more than 40 matches)
    #[arg(long, conflicts_with = "json")]
    matches: bool,
    /// Print robot log messages to stderr
    #[arg(long)]
    log: bool,
    /// Print the match step by step: readings, action, fuel, log lines, paints and labels, and the
    /// backtrace of its fault; for one robot in one maze
    #[arg(long, conflicts_with_all = ["json", "log", "watch"])]
    explain: bool,
    /// Show the match step by step on the terminal; for one robot in one maze, or two
    /// side by side
    #[arg(long, conflicts_with_all = ["json", "log"])]
    watch: bool,
    /// Time between the steps that --watch shows, in milliseconds (keys change it)
    #[arg(long, value_name = "MS", default_value_t = 120, requires = "watch",
          value_parser = clap::value_parser!(u64).range(0..=60_000))]
    delay: u64,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
    #[command(flatten)]
    keep: KeepArgs,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
    #[command(flatten)]
    time: TimeArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let (robots, mazes) = args.sort_arguments()?;
    let existing = Existing::from_flag(args.force);
    let draft = |path: &PathBuf| Draft::create(path, existing);
    let file = args.output.as_ref().map(draft).transpose()?;
    let html = args.html.as_ref().map(draft).transpose()?;
    let executor = args.setup.executor_for_all(&args.isolation, &args.time)?;
    let bad_files = if args.strict {
        BadFiles::Fail
    } else {
        BadFiles::Skip
    };
    let legality = Legality::from_flag(args.lenient);
    let plan = Plan {
        mazes: mazes::distinct(mazes::load(&mazes, legality, bad_files)?),
        entrants: entrants::load(&robots, &executor)?,
        seeds: args.seeds.seeds()?,
        rules: executor.rules().clone(),
    };
    let players = plan.players();
    let pace = Pace {
        jobs: args.setup.jobs(),
        robot_time: args.time.robot_time(),
    };
    let mut replays = args.keep.sink(&plan)?;
    let played = args.play(&plan, &players, &executor, pace, (file, replays.as_mut()))?;

    // Results come first, whatever happens to what is replayed for the user afterwards.
    let results = &played.results;
    if !args.json {
        args.print_tables(&plan, results)?;
    }
    let complaints = match interrupt::flag().is_set() {
        true => Complaints::default(),
        false => complaints::collect(&plan, &players, &executor, &played.faults),
    };
    print_faults(&plan, &players, results, (&played.faults, &complaints));
    if let (Some(html), Some(path), Some(page)) = (html, &args.html, played.page) {
        page.write(html, path, &plan, (results.summary.digest, &complaints))?;
    }
    if let Some(replays) = replays {
        let players = players.as_slice();
        args.keep
            .write(replays, &plan, players, &executor, existing)?;
    }
    let mut exit = exit(&plan, results);
    if exit == Exit::Interrupted {
        return Ok(exit);
    }
    if let (Some(thresholds), Some(matrix)) = (&args.fail_under, &played.matrix) {
        exit = fail_under::exit(thresholds, matrix, exit);
    }
    interrupt::stop_listening();
    if args.explain {
        let executor = (robots.as_slice(), &executor);
        explain::print(&plan, &players, executor, (results, &played.faults))?;
    } else if !args.json {
        backtrace::print(&plan, &players, &robots, &executor, &played.faults);
    }
    if args.log {
        log::print(&plan, &players, &executor, results);
    }
    if args.watch {
        let delay = Duration::from_millis(args.delay);
        let shown = player::watch(&plan, &players, &executor, results, delay, args.ascii)?;
        if shown != Exit::Success {
            return Ok(shown);
        }
    }
    if args.reproduce {
        let executor = (&args.isolation, &args.time);
        let again = reproduce::check(&plan, results, &robots, pace, executor)?;
        if again != Exit::Success {
            return Ok(again);
        }
    }
    Ok(exit)
}

/// What came of a contest.
struct Played {
    /// With matches only when there are few, or when they are needed.
    results: Results,
    faults: FaultSummary,
    page: Option<PageBuilder>,
    /// Only when there are thresholds.
    matrix: Option<ScoreMatrix>,
}

fn thresholds(text: &str) -> Result<Thresholds, String> {
    text.parse()
}

impl Args {
    /// Which arguments are robots and which are mazes.
    fn sort_arguments(&self) -> Result<(Vec<RobotSpec>, Vec<String>), Failure> {
        let mut robots = Vec::new();
        let mut mazes = Vec::new();
        for argument in &self.arguments {
            if robots::is_robot(argument) {
                robots.extend(robots::resolve(argument)?);
            } else {
                mazes.push(argument.clone());
            }
        }
        for argument in &self.robots {
            robots.extend(robots::resolve(argument)?);
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
        let unknown = self
            .arguments
            .iter()
            .find(|it| !maze_source::is_meant_by(it));
        match unknown {
            None => {
                let is_folder = |it: &&String| Path::new(it).is_dir();
                let failure = match self.arguments.iter().find(is_folder) {
                    Some(folder) => Failure::usage(text!(
                        "no robot specified: folder `{}` has no robots and is no robot project",
                        folder
                    )),
                    None => Failure::usage("no robot specified"),
                };
                failure.hint(robots::unknown_hint(""))
            }
            Some(argument) => Failure::usage(format!("unknown robot `{}`", for_terminal(argument)))
                .hint(robots::unknown_hint(argument)),
        }
    }

    /// Plays the plan and writes its results as they come.
    fn play(
        &self,
        plan: &Plan,
        players: &[Player],
        executor: &LocalExecutor,
        pace: Pace,
        (file, replays): (Option<Draft>, Option<&mut ReplaySink>),
    ) -> Result<Played, Failure> {
        let contest = ContestInfo::new(plan);
        let mut standings = StandingsBuilder::new(plan, players);
        let mut summary = SummaryBuilder::new();
        let mut faults = FaultSummary::default();
        let mut page = self.html.as_ref().map(|_| PageBuilder::new(plan));
        let mut matrix = self.fail_under.as_ref().map(|_| MatrixBuilder::new(plan));
        let needs_list = self.matches || self.log || self.watch || self.explain || self.reproduce;
        let mut list = RecordList::new(if needs_list { u64::MAX } else { LISTED_MAX });
        let path = self.output.as_deref().unwrap_or(Path::new(""));
        let file_failed = |error: io::Error| {
            Failure::internal(format!("failed to write `{}`: {error}", path.display()))
        };
        let mut file = file.map(|draft| FileWriter::new(draft, path, &contest));
        let mut stdout = self
            .json
            .then(|| ResultsWriter::new(Stdout::default(), &contest));

        let mut sinks: Vec<&mut dyn Sink> =
            vec![&mut standings, &mut summary, &mut faults, &mut list];
        sinks.extend(page.iter_mut().flat_map(PageBuilder::sinks));
        sinks.extend(matrix.as_mut().map(|it| it as &mut dyn Sink));
        sinks.extend(replays.map(|it| it as &mut dyn Sink));
        sinks.extend(file.as_mut().map(FileWriter::sink));
        sinks.extend(stdout.as_mut().map(|it| it as &mut dyn Sink));
        play_all(plan, executor, pace, &mut Tee(sinks))?;

        let summary = summary.finish(plan, standings.finish(plan, players));
        if let Some(file) = file {
            file.finish(&summary).map_err(file_failed)?.commit()?;
            message!("wrote {}", Text::of_path(path));
        }
        if let Some(stdout) = stdout {
            let written = stdout.finish(&summary);
            written.map_err(|error| output::stdout_failure(&error))?;
        }
        let results = Results {
            version: RESULTS_VERSION,
            contest,
            matches: list.into_records().unwrap_or_default(),
            summary,
        };
        Ok(Played {
            results,
            faults,
            page,
            matrix: matrix.map(MatrixBuilder::finish),
        })
    }

    fn print_tables(&self, plan: &Plan, results: &Results) -> Result<(), Failure> {
        let layout = terminal::table_layout(self.ascii);
        let (contest, summary) = (&results.contest, &results.summary);
        let played = results.summary.matches;
        let is_listed = self.matches || played <= LISTED_MAX;
        if is_listed && played > 0 {
            output::print(&table::matches(
                contest,
                &summary.mazes,
                &results.matches,
                layout,
            ))?;
        }
        if plan.entrants.len() > 1 || played > 1 {
            let separator = if is_listed { "\n" } else { "" };
            let standings = table::standings(contest, &summary.standings, layout);
            output::print(&format!("{separator}{standings}"))?;
        }
        if !is_listed {
            message!(
                "{} matches were played; --matches lists them, -o FILE stores them",
                played
            );
        }
        Ok(())
    }
}

/// The file of `--output`, in the format that its name asks for.
enum FileWriter {
    Document(ResultsWriter<Draft>),
    Lines(JsonLines<Draft>),
}

impl FileWriter {
    fn new(draft: Draft, path: &Path, contest: &ContestInfo) -> Self {
        if path.extension() == Some(OsStr::new("jsonl")) {
            Self::Lines(JsonLines::new(draft))
        } else {
            Self::Document(ResultsWriter::new(draft, contest))
        }
    }

    fn sink(&mut self) -> &mut dyn Sink {
        match self {
            Self::Document(writer) => writer,
            Self::Lines(writer) => writer,
        }
    }

    fn finish(self, summary: &Summary) -> io::Result<Draft> {
        match self {
            Self::Document(writer) => writer.finish(summary),
            Self::Lines(writer) => writer.finish(),
        }
    }
}
