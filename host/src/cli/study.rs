//! `wasmouse study`: a robot against the benchmarks of Minnett's report.

use super::exit::Exit;
use super::failure::Failure;
use super::trial::{Trial, TrialArgs};
use super::{mazes, output, robots, terminal};
use crate::report::study::Study;

const EXAMPLES: &str = "\
Examples:
  wasmouse study minnett:final
  wasmouse study my-robot flood --json
  wasmouse study my-robot --mazes gen:tree:12..=20:1..=100

Exit codes:
  0  the study was made, whatever came of it
  4  a robot was rejected
  5  internal error, or a robot took too long or could not be admitted or played
     for a reason of the host
  130  interrupted; the study covers what was played by then";

/// The mazes of a study that names none: 100 of each size, as the report has them. No bundled
/// robot was tuned on these seeds.
const DEFAULT_MAZES: &str = "gen:stretches:12..=20:500001..=500100";

/// Measure robots against the benchmarks of Minnett's report
///
/// Plays 500 generated mazes, 100 of each of the sizes 12, 14, 16, 18 and 20, or
/// those of --mazes, and prints for each size how often and by how much the robot's
/// score beats the lower and the upper benchmark: the optimal speed run after an
/// exploration run with one or two steps for each cell.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!(
    "{}\n\n{}\n\n{EXAMPLES}", robots::SPECIFICATION_HELP, mazes::SPECIFICATION_HELP
))]
pub struct Args {
    /// The robots to measure
    #[arg(value_name = "ROBOT", required = true)]
    robots: Vec<String>,
    /// Print the study as JSON
    #[arg(long)]
    json: bool,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
    #[command(flatten)]
    trial: TrialArgs,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let mut robots = Vec::new();
    for argument in &args.robots {
        robots.extend(robots::resolve(argument)?);
    }
    let Trial { matrix, exit } = args.trial.play(&robots, DEFAULT_MAZES)?;
    let study = Study::new(&matrix);
    if args.json {
        output::print_data(&study.to_json())?;
    } else {
        let lines = terminal::table_layout(args.ascii).lines;
        output::print(&study.to_text(lines))?;
    }
    Ok(exit)
}
