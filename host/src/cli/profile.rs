//! `wasmouse profile`: the fuel of one match by function.

use std::io::Write as _;
use std::path::PathBuf;

use wasmouse_engine::Executor as _;

use super::entrants;
use super::exit::Exit;
use super::failure::Failure;
use super::mazes::{self, BadFiles, Legality};
use super::output::{self, Draft, Existing, message};
use super::robots;
use super::setup::{IsolationArgs, SetupArgs, TimeArgs};
use crate::contest::{NotAdmitted, Plan, Seeds};
use crate::report::escape::for_terminal;
use crate::report::profile::ProfiledMatch;
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Examples:
  wasmouse profile flood                                 a table of functions
  wasmouse profile my-robot --maze gen:tree:16:1 -o my-robot.speedscope.json
  wasmouse profile my-robot.wasm --format folded | inferno-flamegraph > fuel.svg

Open the file at https://www.speedscope.app. The Firefox profiler
(https://profiler.firefox.com) reads folded stacks. Nothing is sampled: fuel is
counted at every call and every return, so a match has the same profile
everywhere, and its sum is the fuel of the match. Functions need a name section, which release builds
of most toolchains have; others are shown as wasm-function[N]. The robot is
instrumented and compiled for it, and runs some ten to hundred times slower.

Exit codes:
  0  the profile was made
  4  the robot was rejected, or has no profile";

/// Show which functions of a robot use the fuel of a match
///
/// Plays one match and counts the fuel of each function, of itself and with what it calls.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!(
    "{}\n\n{}\n\n{EXAMPLES}", robots::SPECIFICATION_HELP, mazes::SPECIFICATION_HELP
))]
pub struct Args {
    /// A bundled robot, a file or a robot project
    robot: String,
    /// Maze to play in
    #[arg(long, short, value_name = "MAZE", default_value = "test_maze_01")]
    maze: String,
    /// Random seed; the robot's only source of randomness
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// What to write [default: speedscope with --output, otherwise table]
    #[arg(long, value_name = "FORMAT")]
    format: Option<Format>,
    /// Functions in the table, at most
    #[arg(long, value_name = "COUNT", default_value_t = 20,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    functions: u32,
    /// Write the profile to FILE, and the table to standard output
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite FILE if it exists
    #[arg(long, requires = "output")]
    force: bool,
    /// Accept mazes that break contest rules
    #[arg(long)]
    lenient: bool,
    #[command(flatten)]
    setup: SetupArgs,
    #[command(flatten)]
    isolation: IsolationArgs,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    /// JSON for speedscope
    Speedscope,
    /// A line for each path of calls, for flamegraph.pl, inferno and the Firefox profiler
    Folded,
    /// The functions that use most fuel
    Table,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let specs = robots::resolve(&args.robot)?;
    let [spec] = &specs[..] else {
        let message = format!("`{}` has {} robots", args.robot, specs.len());
        return Err(Failure::usage(message).hint("name one of its files"));
    };
    let legality = Legality::from_flag(args.lenient);
    let mut mazes = mazes::load(std::slice::from_ref(&args.maze), legality, BadFiles::Fail)?;
    if mazes.len() != 1 {
        let message = format!("`{}` has {} mazes", args.maze, mazes.len());
        return Err(Failure::usage(message).hint("a profile is of one match: name one maze"));
    }
    let existing = Existing::from_flag(args.force);
    let draft = args.output.as_deref();
    let draft = draft
        .map(|path| Draft::create(path, existing))
        .transpose()?;
    let executor = args
        .setup
        .executor_for_all(&args.isolation, &TimeArgs::default())?;
    let entrants = entrants::load(&specs, &executor)?;
    let plan = Plan {
        mazes: vec![mazes.remove(0)],
        entrants,
        seeds: Seeds {
            first: args.seed,
            count: 1,
        },
        rules: executor.rules().clone(),
    };
    let entrant = &plan.entrants[0];
    let name = for_terminal(&entrant.name);
    match &entrant.admission {
        Err(NotAdmitted::Rejected(rejection)) => {
            return Err(Failure::robot(text!(
                "rejected `{}`: {}",
                name,
                rejection.reason().escaped()
            ))
            .hint(rejection.hint().escaped()));
        }
        Err(NotAdmitted::Failed(reason)) => {
            let message = text!("`{}` could not be admitted: {}", name, reason.escaped());
            return Err(Failure::internal(message));
        }
        Ok(_) => {}
    }
    let players = plan.players();
    let player = &players[0];
    let maze = plan.mazes[0].prepare(&plan.rules.game);
    let key = plan.spec(plan.key_parts(), player, &maze, args.seed);
    let played = executor.execute_with_details(&player.robot, &key);
    let played = played.map_err(Failure::internal)?;
    let file = spec.read(executor.limits().admission.component_bytes_max)?;
    let profiled = executor.profile(&player.robot, &file, &key, &played);
    let profile = match profiled.map_err(Failure::internal)? {
        Ok(profile) => profile,
        Err(reason) => {
            return Err(Failure::robot(text!(
                "no profile of `{}`: {}",
                name,
                reason
            )));
        }
    };

    let record = &played.record;
    let verdict = record.verdict.title();
    let profiled = ProfiledMatch {
        robot: entrant.name.as_guest(),
        maze: maze.name.as_guest(),
        seed: args.seed,
        verdict: &verdict,
        steps: played.recording.step_fuel.len() as u64,
        profile: &profile,
    };
    let table = || profiled.table(usize::try_from(args.functions).unwrap_or(usize::MAX));
    let written = |format| match format {
        Format::Speedscope => profiled.speedscope(),
        Format::Folded => profiled.folded(),
        Format::Table => table(),
    };
    match (draft, &args.output) {
        (Some(mut draft), Some(path)) => {
            let text = written(args.format.unwrap_or(Format::Speedscope));
            let saved = draft.write_all(text.as_bytes());
            saved.map_err(|error| output::failure(path, &error))?;
            draft.commit()?;
            output::print(&table())?;
            message!("wrote {}", Text::of_path(path));
        }
        _ => output::print(&written(args.format.unwrap_or(Format::Table)))?,
    }
    Ok(Exit::Success)
}
