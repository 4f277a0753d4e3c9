//! `wasmouse demo`: the bundled robots in the bundled mazes, to see what it is.

use std::path::PathBuf;

use wasmouse_core::maze::bundled as bundled_mazes;
use wasmouse_core::record::trace;
use wasmouse_engine::bundled::bundled as bundled_robots;

use super::complaints;
use super::entrants;
use super::exit::Exit;
use super::failure::Failure;
use super::mazes::{self, BadFiles, Legality};
use super::output::{self, Draft, Existing};
use super::page::PageBuilder;
use super::play::{Pace, play_all};
use super::robots::RobotSpec;
use super::setup::SetupArgs;
use super::terminal;
use super::verdict::{exit, print_faults};
use crate::contest::{
    BestMatch, ContestInfo, FaultSummary, Plan, Player, RESULTS_VERSION, RecordList, Results,
    Seeds, StandingsBuilder, SummaryBuilder, Tee,
};
use crate::report::escape::for_terminal;
use crate::report::paths;
use crate::report::table;

const EXAMPLES: &str = "\
Examples:
  wasmouse demo
  wasmouse demo --html demo.html
  wasmouse demo --ascii";

/// Run a contest of the bundled robots in the bundled mazes
///
/// Prints the standings and a picture of the best run: the path of the speed run
/// over how often the exploration run stopped in each cell. The web page has a
/// picture for every robot.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Output file for the web page; overwritten if it exists
    #[arg(long, value_name = "FILE", default_value = "wasmouse-demo.html")]
    html: PathBuf,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
    #[command(flatten)]
    setup: SetupArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let html = Draft::create(&args.html, Existing::Replace)?;
    let executor = args.setup.executor();
    let robots: Vec<RobotSpec> = bundled_robots().iter().map(RobotSpec::bundled).collect();
    let mazes: Vec<String> = bundled_mazes()
        .iter()
        .map(|maze| maze.name.to_owned())
        .collect();
    let plan = Plan {
        entrants: entrants::load(&robots, &executor)?,
        mazes: mazes::load(&mazes, Legality::Contest, BadFiles::Fail)?,
        seeds: Seeds { first: 0, count: 1 },
        rules: executor.rules().clone(),
    };
    let players = plan.players();
    let mut standings = StandingsBuilder::new(&plan, &players);
    let mut summary = SummaryBuilder::new();
    let mut faults = FaultSummary::default();
    let mut page = PageBuilder::new(&plan);
    let mut list = RecordList::new(u64::MAX);
    let mut sink = Tee(vec![&mut standings, &mut summary, &mut faults, &mut list]);
    sink.0.extend(page.sinks());
    let pace = Pace {
        jobs: args.setup.jobs(),
        robot_time: None,
    };
    play_all(&plan, &executor, pace, &mut sink)?;
    let results = Results {
        version: RESULTS_VERSION,
        contest: ContestInfo::new(&plan),
        matches: list.into_records().unwrap_or_default(),
        summary: summary.finish(&plan, standings.finish(&plan, &players)),
    };

    let layout = terminal::table_layout(args.ascii);
    let standings = &results.summary.standings;
    output::print(&table::standings(&results.contest, standings, layout))?;
    print_best_run(args, &plan, &players, &results, page.best())?;
    let complaints = complaints::collect(&plan, &players, &executor, &faults);
    print_faults(&plan, &players, &results, (&faults, &complaints));
    let digest = results.summary.digest;
    page.write(html, &args.html, &plan, (digest, &complaints))?;
    Ok(exit(&plan, &results))
}

/// Prints the best match of the robot that came first.
fn print_best_run(
    args: &Args,
    plan: &Plan,
    players: &[Player],
    results: &Results,
    best: &[Option<BestMatch>],
) -> Result<(), Failure> {
    let Some(first) = results.summary.standings.lines.first() else {
        return Ok(());
    };
    let is_first = |player: &Player| plan.entrants[player.entrants[0]].name == first.robot;
    let index = players.iter().position(is_first);
    let Some(BestMatch { played, maze }) = index.and_then(|index| best.get(index)?.as_ref()) else {
        return Ok(());
    };
    let (_, trace) =
        trace(&maze.maze, &plan.rules.game, &played.transcript).map_err(Failure::internal)?;
    let picture = paths(&maze.maze, &trace);
    let steps = played.record.steps;
    output::print(&format!(
        "\nBest run: `{}` in `{}`, {} after {} + {} steps\n\
         (line: speed run, with a dot where a step ended; shading: how often the exploration \
         run stopped in a cell)\n\n{}",
        for_terminal(&first.robot),
        for_terminal(&maze.name),
        played.record.verdict.title(),
        steps.exploration,
        steps.speed,
        picture.to_text(terminal::picture_style(args.ascii)),
    ))
}
