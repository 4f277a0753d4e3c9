//! The arguments of `wasmouse drive`.

use std::path::PathBuf;

use wasmouse_core::game::{GameRules, Ruleset, Verdict};
use wasmouse_core::journal::Journal;
use wasmouse_core::maze::Maze;
use wasmouse_core::playback::Playback;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::mazes::{self, Legality};
use super::super::output::{Draft, Existing, message};
use super::super::player::{self, Show};
use super::super::{output, setup, terminal, tui};
use super::driver::Driver;
use super::outcome::result;
use super::replay_file::{self, DRIVER};
use crate::report::text::{Text, text};

const LONG_HELP: &str = "\
The arrow keys turn and drive: up straight ahead, left and right after a quarter
turn, down backwards. A digit says how many cells a move drives; r is the reset.
Each move is one step, as a robot's. The map shows what the readings have shown so
far; with --blind there is none. `?` shows all keys.

Examples:
  wasmouse drive test_maze_01
  wasmouse drive gen:tree:16:7 --blind
  wasmouse drive test_maze_01 --replay mine.replay.json

Exit codes:
  0  the match ended, or was given up
  2  there is no terminal
  3  the maze cannot be read, or the replay file already exists";

/// Drive through a maze by hand, and be scored like a robot
///
/// Shows what a robot sees: three readings before each step, and a map of what was
/// seen so far. At the end come verdict, score, oracle score and regret, and the
/// match can be watched in the true maze.
#[derive(clap::Args)]
#[command(after_long_help = format!("{}\n\n{LONG_HELP}", mazes::SPECIFICATION_HELP))]
pub struct Args {
    /// A bundled maze, a file, or a generated maze
    maze: String,
    /// The rules of the match
    #[arg(long, value_name = "NAME", default_value = "udacity", value_parser = setup::rules)]
    rules: Ruleset,
    /// Show no map: only readings, steps, and whether the goal was reached
    #[arg(long)]
    blind: bool,
    /// Write the match to a replay file, if it is driven to its end
    #[arg(long, value_name = "FILE")]
    replay: Option<PathBuf>,
    /// Overwrite the replay file if it exists
    #[arg(long, requires = "replay")]
    force: bool,
    /// Accept a maze that breaks contest rules
    #[arg(long)]
    lenient: bool,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
}

/// What needs a terminal.
const WHAT: &str = "`wasmouse drive`";

/// What to do without one.
const HINT: &str = "run it in a terminal; `wasmouse run` plays robots without one";

/// Runs the command: until the match ends, or the driver gives up.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let mazes = mazes::load_all(
        std::slice::from_ref(&args.maze),
        Legality::from_flag(args.lenient),
    )?;
    let [named] = &mazes[..] else {
        let count = mazes.len();
        return Err(Failure::usage(text!(
            "a drive is through one maze, and `{}` names {}",
            args.maze,
            count
        )));
    };
    let existing = Existing::from_flag(args.force);
    let draft = args.replay.as_ref();
    let draft = draft.map(|path| Ok((path, Draft::create(path, existing)?)));
    let draft = draft.transpose()?;
    let rules = args.rules.game;
    let mut driver = Driver::new(
        named.name.clone(),
        &named.maze,
        &rules,
        terminal::look(args.ascii),
    );
    driver.has_map = !args.blind;
    let exit = tui::run(&mut driver, WHAT, HINT)?;
    if exit != Exit::Success {
        return Ok(exit);
    }
    let lines: Vec<String> = result(&driver).into_iter().map(|(line, _)| line).collect();
    output::print(&format!("{}\n", lines.join("\n")))?;
    if let Some((path, draft)) = draft {
        if driver.verdict().is_some() {
            replay_file::save(draft, path, &driver, (&named.maze, &args.rules))?;
            message!("wrote {}", Text::of_path(path));
        } else {
            message!("no replay was written: the match did not end");
        }
    }
    match (driver.wants_to_watch, driver.verdict()) {
        (true, Some(verdict)) => watch(&driver, &named.maze, rules, verdict, args.ascii),
        _ => Ok(exit),
    }
}

fn watch(
    driver: &Driver<'_>,
    maze: &Maze,
    rules: GameRules,
    verdict: Verdict,
    ascii: bool,
) -> Result<Exit, Failure> {
    let trace = driver.trace.clone();
    let playback = Playback::new(maze.clone(), rules, trace, verdict, Journal::default());
    let options = player::Options {
        delay: std::time::Duration::from_millis(120),
        position: 0,
        playing: true,
        ascii,
        what: WHAT,
        hint: HINT,
    };
    player::play(vec![Show::new(DRIVER, &driver.name, playback)], &options)
}
