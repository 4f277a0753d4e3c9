//! `wasmouse compare`: whether one robot is better than others.

use clap::ValueEnum;

use super::exit::Exit;
use super::failure::Failure;
use super::trial::{Trial, TrialArgs};
use super::{mazes, output, robots, terminal};
use crate::contest::{PairedVerdict, Scoring};
use crate::report::comparison::Comparisons;

const EXAMPLES: &str = "\
Examples:
  wasmouse compare flood dfs
  wasmouse compare my-robot flood --mazes gen:tree:16:1..=200 mazes
  wasmouse compare new.wasm old.wasm --require no-worse
  wasmouse compare flood:certain flood random --repeat 5 --json

Exit codes:
  0  every comparison was made, whatever came of it
  1  the first robot is not what --require asks for
  4  a robot was rejected
  5  internal error, or a robot took too long or could not be admitted or played
     for a reason of the host
  130  interrupted; the comparison covers what was played by then";

/// The mazes of a comparison that names none. No bundled robot was tuned on these seeds.
const DEFAULT_MAZES: &str = "gen:braid:12..=16:500001..=500100";

/// Compare a robot with others over the same mazes
///
/// The first robot is compared with each of the others: better, worse or undecided,
/// by the 95 % confidence interval of the average difference of their scores, a
/// bootstrap over mazes. An unfinished match counts as the worst score that the
/// rules allow. Without --mazes, 100 generated mazes of each of the sizes 12, 14
/// and 16 are played.
#[derive(clap::Args, Debug)]
#[command(after_long_help = format!(
    "{}\n\n{}\n\n{EXAMPLES}", robots::SPECIFICATION_HELP, mazes::SPECIFICATION_HELP
))]
pub struct Args {
    /// The robot to judge, and those to compare it with
    #[arg(value_name = "ROBOT", required = true)]
    robots: Vec<String>,
    /// Fail unless the first robot is found to be better than each of the others, or
    /// to be worse than none
    #[arg(long, value_name = "VERDICT")]
    require: Option<Requirement>,
    /// Print the comparison as JSON
    #[arg(long)]
    json: bool,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
    #[command(flatten)]
    trial: TrialArgs,
}

/// What the first robot has to be.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Requirement {
    Better,
    NoWorse,
}

impl Requirement {
    const fn verdicts(self) -> &'static [PairedVerdict] {
        match self {
            Self::Better => &[PairedVerdict::Better],
            Self::NoWorse => &[PairedVerdict::Better, PairedVerdict::Undecided],
        }
    }
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let mut robots = Vec::new();
    for argument in &args.robots {
        robots.extend(robots::resolve(argument)?);
    }
    if robots.len() < 2 {
        return Err(Failure::usage("one robot cannot be compared")
            .hint("name two robots or more, and mazes after --mazes"));
    }
    let Trial { matrix, exit } = args.trial.play(&robots, DEFAULT_MAZES)?;
    let comparisons = Comparisons::new(&matrix, &Scoring::default());
    if args.json {
        output::print_data(&comparisons.to_json())?;
    } else {
        output::print(&comparisons.to_text(terminal::table_layout(args.ascii)))?;
    }
    let is_met = |it: Requirement| comparisons.all(it.verdicts());
    if exit == Exit::Success && !args.require.is_none_or(is_met) {
        return Ok(Exit::CheckFailed);
    }
    Ok(exit)
}
