//! `wasmouse maze convert`: one maze, in another format.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser as _};

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::mazes::{self, Legality};
use super::super::output::{self, Existing};
use wasmouse_core::maze::format::{self, Format};

const LONG_HELP: &str = "\
Formats:
  udacity      the dimension, then one line per column from the left: for each
               cell from the bottom up the sum of its open sides, 1 up, 2 right,
               4 down, 8 left
  competition  a picture with posts o, walls --- and |, start S, goal cells G
  map          the same picture with posts + and no marks, for simulators
  num          one line per cell: x y north east south west, 1 is a wall
  blocks       a picture with one character a block, 1 a wall and 0 open; a maze
               of n x n cells has 2n + 1 lines of 2n + 1 blocks
The format that is read is recognised by content. Only competition holds a start
other than (0, 0) or a goal other than the centre.

Examples:
  wasmouse maze convert test_maze_01 --to competition
  wasmouse maze convert a.txt --to num -o a.num
  wasmouse maze convert - --to udacity < a.map > a.txt";

/// Print a maze in another file format.
///
/// The maze need not be a legal contest maze; see `wasmouse maze check`. The
/// file given with --output is written completely or not at all.
#[derive(clap::Args)]
#[command(after_long_help = LONG_HELP)]
pub struct Args {
    /// A bundled maze, a file, or - for standard input
    maze: String,
    /// The format to print
    #[arg(long, value_name = "FORMAT", value_parser = format_parser())]
    to: Format,
    /// Write to a file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file if it exists
    #[arg(long, requires = "output")]
    force: bool,
}

fn format_parser() -> impl clap::builder::TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name)).try_map(|name| name.parse::<Format>())
}

/// Runs the command.
pub fn run(args: Args) -> Result<Exit, Failure> {
    let mazes = mazes::load_all(&[args.maze], Legality::Lenient)?;
    let [maze] = &mazes[..] else {
        let message = format!(
            "only one maze can be converted, the folder has {}",
            mazes.len()
        );
        return Err(Failure::usage(message));
    };
    let text = format::print(&maze.maze, args.to).map_err(|error| {
        let name = maze.name.escaped();
        Failure::input(format!("failed to convert maze `{name}`: {error}"))
            .hint("--to competition holds any start and goal")
    })?;
    match args.output {
        None => output::print_data(&text)?,
        Some(path) => {
            let existing = if args.force {
                Existing::Replace
            } else {
                Existing::Keep
            };
            output::save(&path, text.as_bytes(), existing)?;
        }
    }
    Ok(Exit::Success)
}
