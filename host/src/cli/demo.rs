//! `wasmouse demo`: the bundled robots in the bundled mazes, to see what it is.

use std::path::PathBuf;

use super::exit::Exit;
use super::failure::Failure;
use super::mazes::{self, Legality};
use super::output::{self, Existing};
use super::robots::{self, Specification};
use super::run;
use super::setup::SetupArgs;
use super::{page, terminal};
use crate::contest::{Contest, ContestMaze, MatchResult, Standing, standings};
use wasmouse_core::maze::bundled as bundled_mazes;
use crate::report::replay;
use crate::report::table;
use crate::report::escape::for_terminal as visible;
use crate::robot::bundled::bundled as bundled_robots;
use crate::robot::{Recorder, Referee};

const EXAMPLES: &str = "\
Examples:
  wasmouse demo
  wasmouse demo --html demo.html
  wasmouse demo --ascii";

/// Run a contest of the bundled robots in the bundled mazes.
///
/// Prints the standings and a picture of the best run: the way of run 2, over
/// how often run 1 stopped in each cell. The page has a picture for every robot.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Where to write the web page; replaced when it is there
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
    output::check(&args.html, Existing::Replace)?;
    let referee = args.setup.referee();
    let contest = contest(args, &referee)?;
    let played = run::play(&contest, &referee, args.setup.threads())?;
    let results = &played.results;
    let standings = standings(&contest, results);

    let lines = terminal::table_lines(args.ascii);
    output::print(&table::standings(&contest, &standings, lines))?;
    print_best_run(args, &contest, &referee, results, &standings)?;
    run::tell_failures(&contest, results);
    page::write(
        &args.html,
        Existing::Replace,
        &contest,
        &referee,
        results,
        &standings,
    )?;
    Ok(run::exit(&contest, &played))
}

fn contest(args: &Args, referee: &Referee) -> Result<Contest, Failure> {
    let robots: Vec<Specification> = bundled_robots()
        .iter()
        .map(|robot| Specification::parse(robot.name))
        .collect::<Result<_, _>>()?;
    let names: Vec<String> = bundled_mazes()
        .iter()
        .map(|maze| maze.name.to_owned())
        .collect();
    let rules = args.setup.rules;
    let mazes = mazes::load(&names, Legality::Contest)?;
    Ok(Contest {
        entrants: robots::load(&robots, referee)?,
        mazes: mazes
            .into_iter()
            .map(|named| ContestMaze::new(named.name, named.maze, &rules))
            .collect(),
        seeds: vec![0],
        rules,
    })
}

fn print_best_run(
    args: &Args,
    contest: &Contest,
    referee: &Referee,
    results: &[MatchResult],
    standings: &[Standing],
) -> Result<(), Failure> {
    let Some(best) = standings.first() else {
        return Ok(());
    };
    let Some(index) = page::best_match(contest, results, best.entrant) else {
        return Ok(());
    };
    let result = &results[index];
    let mut recorder = Recorder::default();
    contest
        .replay(referee, result, &mut recorder)
        .map_err(Failure::internal)?;
    let maze = &contest.mazes[result.maze];
    let picture = replay::ways(&maze.maze, &recorder.trace);
    let robot = visible(&contest.entrants[result.entrant].name);
    let [exploration, speed] = result.outcome.steps;
    output::print(&format!(
        "\nThe best run: `{robot}` in `{}`, {} after {exploration} + {speed} steps\n\
         (the line is run 2, with a dot where a step ended; shaded cells are where run 1 stopped)\n\n{}",
        visible(&maze.name),
        result.outcome.verdict.title(),
        picture.to_text(terminal::picture_style(args.ascii)),
    ))
}
