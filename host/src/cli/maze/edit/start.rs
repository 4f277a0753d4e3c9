//! The arguments of `wasmouse maze edit`.

use std::fs;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser as _};
use wasmouse_core::maze::format::Format;
use wasmouse_core::maze::{Area, Cell, DIMENSIONS, Heading, Maze, Walls, bundled, goal_entrances};

use super::super::super::exit::Exit;
use super::super::super::failure::Failure;
use super::super::super::maze_source;
use super::super::super::terminal;
use super::super::super::tui::{self, Look};
use super::editor::Editor;
use super::file::MazeFile;
use crate::report::text::{Text, text};

const LONG_HELP: &str = "\
Arrow keys go from cell to cell, w a s d toggle the walls of a cell, and a click of
the mouse toggles the wall that it points at. Beside the maze is what it breaks,
with the cells, the optimum in steps and cells, the oracle score by the ruleset
udacity, and what makes it hard. `?` shows all keys.

The file is saved with ctrl-s, as a whole or not at all, in the format that it was
read in. Start and goal stay where they are: in a new maze in the corner and in the
centre.

Examples:
  wasmouse maze edit maze.txt
  wasmouse maze edit maze.txt --new 16
  wasmouse maze edit maze.txt --new gen:braid:16:7 --format competition
  wasmouse maze edit maze.txt --new test_maze_01

Exit codes:
  0  the editor was left
  2  there is no terminal
  3  the file cannot be read, or with --new, it already exists";

/// Edit a maze in the terminal
///
/// Shows live whether the maze is legal, its optimum and its oracle score. With
/// --new, FILE is created when it is saved.
#[derive(clap::Args)]
#[command(after_long_help = LONG_HELP)]
pub struct Args {
    /// The maze file
    file: PathBuf,
    /// Begin a new file: an empty maze of that size in cells (3 to 64), or a copy
    /// of a maze such as gen:tree:16:7 or test_maze_01
    #[arg(long, value_name = "SIZE|MAZE")]
    new: Option<String>,
    /// The format of a new file
    #[arg(long, requires = "new", default_value = "udacity", value_parser = format_parser())]
    format: Format,
    /// Draw with ASCII characters only
    #[arg(long)]
    ascii: bool,
}

fn format_parser() -> impl clap::builder::TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name)).try_map(|name| name.parse::<Format>())
}

/// Runs the command: until the editor is left.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let (file, maze, is_saved) = match &args.new {
        Some(from) => {
            if fs::symlink_metadata(&args.file).is_ok() {
                return Err(Failure::input(text!(
                    "`{}` already exists",
                    Text::of_path(&args.file)
                ))
                .hint("edit it without --new, or choose another name"));
            }
            let file = MazeFile::new(args.file.clone(), args.format);
            (file, new_maze(from)?, false)
        }
        None => {
            let opened = MazeFile::open(&args.file);
            let (file, maze) = opened.map_err(|failure| with_hint(failure, &args.file))?;
            (file, maze, true)
        }
    };
    let look: Look = terminal::look(args.ascii);
    let mut editor = Editor::new(file, maze, is_saved, look);
    tui::run(
        &mut editor,
        "`wasmouse maze edit`",
        "run it in a terminal; `wasmouse maze check` needs none",
    )
}

fn with_hint(failure: Failure, path: &Path) -> Failure {
    let name = path.to_str().unwrap_or_default();
    if path.exists() {
        failure
    } else if bundled().iter().any(|maze| maze.name == name) {
        failure.hint(text!(
            "`wasmouse maze edit FILE --new {}` edits a copy",
            name
        ))
    } else {
        failure.hint("--new SIZE begins a new maze")
    }
}

/// The maze that a new file begins with.
fn new_maze(from: &str) -> Result<Maze, Failure> {
    let sizes = 3..=*DIMENSIONS.end();
    if let Ok(size) = from.parse::<u64>() {
        let size = u8::try_from(size).ok().filter(|size| sizes.contains(size));
        return size.map(empty).ok_or_else(|| {
            Failure::usage(text!(
                "a new maze has from 3 to {} cells along each side, found {}",
                sizes.end(),
                from
            ))
        });
    }
    let sources = maze_source::resolve(from)?;
    let [source] = &sources[..] else {
        return Err(Failure::usage(text!(
            "a new maze is a copy of one maze, and `{}` names {}",
            from,
            sources.len()
        )));
    };
    Ok(source.read()?.0)
}

/// A maze with as few walls as the contest rules allow: they close the sides of the start, and
/// the goal but for one entrance.
fn empty(size: u8) -> Maze {
    let mut walls = Walls::open(size);
    walls.set(Cell::new(0, 0), Heading::Right, false);
    let goal = Area::center(size);
    for cell in goal.cells() {
        for side in Heading::ALL {
            let inside = walls
                .neighbor(cell, side)
                .is_some_and(|it| goal.contains(it));
            if !inside {
                walls.set(cell, side, false);
            }
        }
    }
    walls.set(goal.origin(), Heading::Left, true);
    let maze = Maze::contest(walls).expect("a size of 3 has room for start and goal");
    debug_assert_eq!(goal_entrances(&maze).len(), 1);
    maze
}

#[cfg(test)]
mod tests {
    use wasmouse_core::maze::{Violation, violations};

    use super::*;

    #[test]
    fn new_mazes_are_legal_where_their_size_is() {
        for size in 3..=64 {
            let broken = violations(&empty(size));
            let only_size = broken
                .iter()
                .all(|it| matches!(it, Violation::Dimension { .. }));
            assert!(size == 3 || only_size, "{size}: {broken:?}");
            let is_legal = (12..=20).contains(&size) && size % 2 == 0;
            assert_eq!(broken.is_empty(), is_legal, "{size}: {broken:?}");
        }
    }

    #[test]
    fn new_mazes_are_sizes_or_copies() {
        assert_eq!(new_maze("16").expect("a size").dimension(), 16);
        assert_eq!(new_maze("gen:tree:14:3").expect("a maze").dimension(), 14);
        assert_eq!(new_maze("test_maze_01").expect("a maze").dimension(), 12);
        for (from, message) in [
            (
                "2",
                "error: a new maze has from 3 to 64 cells along each side, found 2",
            ),
            (
                "300",
                "error: a new maze has from 3 to 64 cells along each side, found 300",
            ),
            (
                "gen:tree:14:1..=3",
                "error: a new maze is a copy of one maze, and `gen:tree:14:1..=3` names 3",
            ),
        ] {
            assert_eq!(new_maze(from).expect_err(from).to_string(), message);
        }
        new_maze("no such maze").expect_err("it does not exist");
    }
}
