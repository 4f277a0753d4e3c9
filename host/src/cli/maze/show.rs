//! `wasmouse maze show`: a drawing of a maze.

use std::path::{Path, PathBuf};

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::mazes::{self, Legality, NamedMaze};
use super::super::output::{self, Existing, message};
use super::super::terminal;
use crate::report::picture::{Charset, Picture, TextStyle};
use wasmouse_core::maze::{Metric, distances_to_goal, shortest_path};

const LONG_HELP: &str = "\
In the drawing S is the start and G a goal cell. On a path, a filled circle (*
in ASCII) is where a step ends and an empty one (+) a cell driven through. Heat
fills cells that are farther from the goal with darker shades.

Examples:
  wasmouse maze show test_maze_01
  wasmouse maze show test_maze_01 --path steps --numbers steps
  wasmouse maze show gen:tree:16:42 --heat --color always | less -R
  wasmouse maze show a.txt --lenient --path cells --svg a.svg";

/// Draw a maze.
#[derive(clap::Args)]
#[command(after_long_help = format!("{}\n\n{LONG_HELP}", mazes::SPECIFICATION_HELP))]
pub struct Args {
    /// Bundled mazes, files, folders, generated mazes, or - for standard input
    #[arg(required = true, value_name = "MAZE")]
    mazes: Vec<String>,
    /// Draw an optimal path: the one with the fewest steps, or cells
    #[arg(long, value_name = "METRIC", default_value = "none")]
    path: PathChoice,
    /// Write into every cell how far it is from the goal
    #[arg(long, value_name = "METRIC")]
    numbers: Option<MetricChoice>,
    /// Shade cells by their distance from the goal, in steps unless --numbers
    /// says cells
    #[arg(long)]
    heat: bool,
    /// Use only ASCII characters
    #[arg(long, conflicts_with = "svg")]
    ascii: bool,
    /// Write an SVG drawing to a file, or to standard output with -
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Overwrite the SVG file if it exists
    #[arg(long, requires = "svg")]
    force: bool,
    /// Colour heat and path; auto means in a terminal, unless NO_COLOR is set
    #[arg(
        long,
        value_name = "WHEN",
        default_value = "auto",
        conflicts_with = "svg"
    )]
    color: ColorChoice,
    /// Accept mazes that break contest rules
    #[arg(long)]
    lenient: bool,
}

/// What to count.
#[derive(Clone, Copy, clap::ValueEnum)]
enum MetricChoice {
    /// Steps of up to three cells in a straight line
    Steps,
    /// Single cells
    Cells,
}

impl From<MetricChoice> for Metric {
    fn from(choice: MetricChoice) -> Self {
        match choice {
            MetricChoice::Steps => Self::STEPS,
            MetricChoice::Cells => Self::Cells,
        }
    }
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum PathChoice {
    /// The fewest steps, and among those the fewest cells
    Steps,
    /// The fewest cells, and among those the fewest steps
    Cells,
    /// No path
    None,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum ColorChoice {
    Auto,
    Always,
    Never,
}

/// Runs the command.
pub fn run(args: Args) -> Result<Exit, Failure> {
    let mazes = mazes::load_all(&args.mazes, Legality::from_flag(args.lenient))?;
    match &args.svg {
        Some(file) => save_svg(&mazes, file, &args)?,
        None => output::print_data(&texts(&mazes, &args))?,
    }
    Ok(Exit::Success)
}

fn save_svg(mazes: &[NamedMaze], file: &Path, args: &Args) -> Result<(), Failure> {
    let [named] = mazes else {
        let message = format!("an SVG file holds one maze, found {}", mazes.len());
        return Err(Failure::usage(message).hint("draw them one by one"));
    };
    let svg = picture(named, args).to_svg();
    if file == Path::new("-") {
        return output::print_data(&svg);
    }
    let existing = if args.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    output::save(file, svg.as_bytes(), existing)
}

/// All drawings; with several mazes each has its name above it.
fn texts(mazes: &[NamedMaze], args: &Args) -> String {
    let style = TextStyle {
        charset: if args.ascii {
            Charset::Ascii
        } else {
            Charset::Unicode
        },
        color: wants_color(args.color),
    };
    let mut text = String::new();
    for (place, named) in mazes.iter().enumerate() {
        if mazes.len() > 1 {
            let gap = if place > 0 { "\n" } else { "" };
            text.push_str(&format!("{gap}{}\n", named.name.escaped()));
        }
        text.push_str(&picture(named, args).to_text(style));
    }
    text
}

fn picture(named: &NamedMaze, args: &Args) -> Picture {
    let maze = &named.maze;
    let mut picture = Picture::of(maze);
    picture.set_title(&named.name);
    let path = match args.path {
        PathChoice::Steps => shortest_path(maze, Metric::STEPS),
        PathChoice::Cells => shortest_path(maze, Metric::Cells),
        PathChoice::None => None,
    };
    if let Some(path) = path {
        picture.set_path(&path);
    } else if !matches!(args.path, PathChoice::None) {
        message!(
            "warning: the goal of maze `{}` cannot be reached",
            named.name.escaped()
        );
    }
    if let Some(metric) = args.numbers {
        picture.set_numbers(&distances_to_goal(maze, metric.into()));
    }
    if args.heat {
        let metric = args.numbers.unwrap_or(MetricChoice::Steps);
        picture.set_heat(&distances_to_goal(maze, metric.into()));
    }
    picture
}

fn wants_color(choice: ColorChoice) -> bool {
    match choice {
        ColorChoice::Always => true,
        ColorChoice::Never => false,
        ColorChoice::Auto => terminal::wants_color(),
    }
}
