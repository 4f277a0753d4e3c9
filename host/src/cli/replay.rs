//! `wasmouse replay`: matches that were played, from replay files and stores of contests.

use std::path::PathBuf;

use super::exit::Exit;
use super::failure::Failure;
use super::output::{self, Existing, message};
use super::replays::SourceArgs;
use super::terminal;
use crate::report::text::Text;
use crate::report::{audit, table};

const EXAMPLES: &str = "\
Replays are written by `wasmouse run --replays DIR`; a contest keeps the transcripts that its
file asks for. Reading one verifies it: the digests of its parts, and that the record
follows from the robot's actions.

Examples:
  wasmouse replay replays/flood.test_maze_01.0.replay.json --audit
  wasmouse replay cup/contest.db --list
  wasmouse replay cup/contest.db --match flood/test_maze_01/0 --save flood.replay.json
  wasmouse replay cup/contest.db --match flood --json > audit.json

Exit codes:
  0  success
  3  a file cannot be read or is damaged, or there is no such match";

/// Show matches that were played, and what their robots could have known
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
#[command(group = clap::ArgGroup::new("what").multiple(false))]
pub struct Args {
    #[command(flatten)]
    source: SourceArgs,
    /// List the matches
    #[arg(long, group = "what")]
    list: bool,
    /// Print what the robot could have known: from which step on the best path was certain, what
    /// might still have been saved, steps that showed nothing new, false beliefs
    #[arg(long, group = "what")]
    audit: bool,
    /// Print the same as JSON, with the digest of the trace
    #[arg(long, group = "what")]
    json: bool,
    /// Write the match to FILE, as a replay
    #[arg(long, value_name = "FILE", group = "what")]
    save: Option<PathBuf>,
    /// Overwrite FILE if it exists
    #[arg(long, requires = "save")]
    force: bool,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let replays = args.source.load()?;
    if args.list {
        let layout = terminal::table_layout(args.ascii);
        output::print(&table::replays(&replays, layout))?;
    } else if args.json {
        output::print_data(&audit::to_json(&replays))?;
    } else if let Some(path) = &args.save {
        let [replay] = &replays[..] else {
            return Err(several(replays.len(), "--save writes one match"));
        };
        let mut json = serde_json::to_vec(replay).expect("a replay has a JSON form");
        json.push(b'\n');
        output::save(path, &json, Existing::from_flag(args.force))?;
        message!("wrote {}", Text::of_path(path));
    } else {
        let texts: Vec<String> = replays.iter().map(audit::to_text).collect();
        output::print(&texts.join("\n"))?;
    }
    Ok(Exit::Success)
}

fn several(count: usize, what: &str) -> Failure {
    Failure::usage(format!("{what}, and there are {count}"))
        .hint("choose one with --match ROBOT/MAZE/SEED; --list shows them")
}
