//! `wasmouse replay`: matches that were played, from replay files and stores of contests.

use std::path::PathBuf;
use std::time::Duration;

use wasmouse_core::replay::Replay;

use super::exit::Exit;
use super::failure::Failure;
use super::output::{self, Existing, message};
use super::player::{self, Show};
use super::replays::SourceArgs;
use super::terminal;
use crate::report::text::Text;
use crate::report::{audit, table};

const EXAMPLES: &str = "\
Replays are written by `wasmouse run --replays DIR`; a contest keeps the transcripts that its
file asks for. Reading one verifies it: the digests of its parts, and that the record
follows from the robot's actions.

Examples:
  wasmouse replay replays/flood-reset.test_maze_01.0.replay.json
  wasmouse replay cup/contest.db --list
  wasmouse replay cup/contest.db --match flood/test_maze_01 --match dfs/test_maze_01
  wasmouse replay cup/contest.db --match flood/test_maze_01/0 --save flood.replay.json
  wasmouse replay cup/contest.db --match flood --json > audit.json

Exit codes:
  0  success
  2  there are other than 1 to 4 matches in one maze to watch, or no terminal
  3  a file cannot be read or is damaged, or there is no such match";

/// Watch matches that were played, and see what their robots could have known
///
/// Plays one match on the terminal, or up to four in one maze side by side. The keys are those of
/// `run --watch`; `?` shows them.
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
    /// Begin after that many steps, paused
    #[arg(long, value_name = "STEP", conflicts_with = "what")]
    step: Option<usize>,
    /// Time between steps, in milliseconds (keys change it)
    #[arg(long, value_name = "MS", default_value_t = 120, conflicts_with = "what",
          value_parser = clap::value_parser!(u64).range(0..=60_000))]
    delay: u64,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
}

/// Matches side by side, at most.
const SHOWN_MAX: usize = 4;

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
    } else if args.audit {
        let texts: Vec<String> = replays.iter().map(audit::to_text).collect();
        output::print(&texts.join("\n"))?;
    } else {
        return watch(args, &replays);
    }
    Ok(Exit::Success)
}

fn watch(args: &Args, replays: &[Replay]) -> Result<Exit, Failure> {
    let maze = |replay: &Replay| replay.parts().record.key.maze;
    let is_other = |replay: &Replay| maze(replay) != maze(&replays[0]);
    if replays.len() > SHOWN_MAX || replays.iter().any(is_other) {
        let what = "1 to 4 matches in one maze can be watched at once";
        return Err(several(replays.len(), what));
    }
    let shows = replays.iter().map(|replay| {
        let parts = replay.parts();
        Show::new(&parts.robot, &parts.maze_name, replay.playback())
    });
    let position = args.step.or_else(|| args.source.step());
    let options = player::Options {
        delay: Duration::from_millis(args.delay),
        position: position.unwrap_or(0),
        playing: position.is_none(),
        ascii: args.ascii,
        what: "`wasmouse replay`",
        hint: "--audit and --list print to a file or a pipe",
    };
    player::play(shows.collect(), &options)
}

fn several(count: usize, what: &str) -> Failure {
    Failure::usage(format!("{what}, and there are {count}"))
        .hint("choose one with --match ROBOT/MAZE/SEED; --list shows them")
}
