//! `wasmouse maze solve`: the best that any robot could do in a maze.

use std::fmt::Write as _;

use wasmouse_core::game::{GameRules, Score};
use wasmouse_core::maze::{Metric, Path, shortest_path};

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::mazes::{self, BadFiles, Legality};
use super::super::output;
use crate::contest::ContestMaze;
use crate::report::maze_solve::{MazeSolve, Solution as SolutionJson, SolvedMaze};
use crate::report::number::counted;

const EXAMPLES: &str = "\
Examples:
  wasmouse maze solve test_maze_01
  wasmouse maze solve my-mazes gen:braid:16:1..=100 --brief
  wasmouse maze solve a.txt --lenient --json

Exit codes:
  0  every maze has a solution
  1  a maze has none";

/// Find the optimal paths of mazes, in steps and in cells
///
/// A step covers up to three cells in a straight line, as in the ruleset
/// `udacity`. Of the paths with the fewest steps, the one with the fewest cells
/// is printed, and vice versa. The oracle score is that of a robot that knows
/// the maze: it drives the optimal path, resets, and drives it again. No robot
/// can score lower.
#[derive(clap::Args)]
#[command(after_long_help = format!("{}\n\n{EXAMPLES}", mazes::SPECIFICATION_HELP))]
pub struct Args {
    /// Bundled mazes, files, folders, generated mazes, or - for standard input
    #[arg(required = true, value_name = "MAZE")]
    mazes: Vec<String>,
    /// Accept mazes that break contest rules
    #[arg(long)]
    lenient: bool,
    /// Print one line per maze, without the paths
    #[arg(long, conflicts_with = "json")]
    brief: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// The optimal paths to the goal of one maze.
struct Solution {
    fewest_steps: Path,
    fewest_cells: Path,
    oracle: Score,
}

/// Runs the command: all mazes are solved, also after one without a solution.
pub fn run(args: Args) -> Result<Exit, Failure> {
    let legality = Legality::from_flag(args.lenient);
    let mazes = mazes::load(&args.mazes, legality, BadFiles::Fail)?;
    let rules = GameRules::default();
    let mazes: Vec<ContestMaze> = mazes.iter().map(|maze| maze.prepare(&rules)).collect();
    let solutions: Vec<Option<Solution>> = mazes.iter().map(solve).collect();
    output::print(&if args.json {
        json(&mazes, &solutions)
    } else {
        listing(&mazes, &solutions, args.brief)
    })?;
    Ok(if solutions.iter().all(Option::is_some) {
        Exit::Success
    } else {
        Exit::CheckFailed
    })
}

fn solve(maze: &ContestMaze) -> Option<Solution> {
    Some(Solution {
        fewest_steps: shortest_path(&maze.maze, Metric::STEPS)?,
        fewest_cells: shortest_path(&maze.maze, Metric::Cells)?,
        oracle: maze.oracle?,
    })
}

fn listing(mazes: &[ContestMaze], solutions: &[Option<Solution>], brief: bool) -> String {
    let mut text = String::new();
    let mut line = |line: std::fmt::Arguments<'_>| {
        writeln!(text, "{line}").expect("writing to a string never fails");
    };
    for (maze, solution) in mazes.iter().zip(solutions) {
        let name = maze.name.escaped();
        let Some(solution) = solution else {
            line(format_args!("{name}: the goal cannot be reached"));
            continue;
        };
        let (steps, cells) = (&solution.fewest_steps, &solution.fewest_cells);
        let oracle = solution.oracle;
        line(format_args!(
            "{name}: {}, oracle score {oracle}",
            length(steps)
        ));
        if brief {
            continue;
        }
        line(format_args!("  fewest steps: {}", directions(steps)));
        if cells.cells() == steps.cells() {
            line(format_args!("  fewest cells: the same path"));
        } else {
            line(format_args!("  fewest cells: {}", length(cells)));
            line(format_args!("    {}", directions(cells)));
        }
    }
    text
}

fn length(path: &Path) -> String {
    format!(
        "{}, {}",
        counted(path.steps(), "step"),
        counted(path.cells(), "cell")
    )
}

/// The path as a robot drives it: `up 3, right 1`.
fn directions(path: &Path) -> String {
    let moves = path
        .moves()
        .map(|(heading, cells)| format!("{heading} {cells}"));
    moves.collect::<Vec<_>>().join(", ")
}

fn json(mazes: &[ContestMaze], solutions: &[Option<Solution>]) -> String {
    let solved = mazes.iter().zip(solutions).map(|(maze, solution)| {
        let solution = solution.as_ref();
        let json =
            solution.map(|it| SolutionJson::new(&it.fewest_steps, &it.fewest_cells, it.oracle));
        SolvedMaze::new(&maze.name, &maze.maze, json)
    });
    MazeSolve::new(solved.collect()).to_json()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use wasmouse_core::maze::{Maze, Walls};

    use super::*;
    use crate::contest::MazeSource;

    /// The official maze, and one without openings.
    fn two() -> (Vec<ContestMaze>, Vec<Option<Solution>>) {
        let names = ["test_maze_01".to_owned()];
        let mut mazes =
            mazes::load(&names, Legality::Contest, BadFiles::Fail).expect("a bundled maze");
        let closed = Maze::contest(Walls::closed(12)).expect("room for both");
        mazes.push(MazeSource::Loaded {
            name: "closed".into(),
            maze: Arc::new(closed),
        });
        let rules = GameRules::default();
        let mazes: Vec<ContestMaze> = mazes.iter().map(|maze| maze.prepare(&rules)).collect();
        let solutions = mazes.iter().map(solve).collect();
        (mazes, solutions)
    }

    #[test]
    fn listings_have_optimum_oracle_score_and_path() {
        let (mazes, solutions) = two();
        assert_eq!(
            listing(&mazes, &solutions, false),
            "test_maze_01: 17 steps, 30 cells, oracle score 17.600\n  \
             fewest steps: up 2, right 1, down 2, right 3, up 2, right 2, down 1, right 1, \
             down 1, right 1, right 3, up 3, left 3, up 2, left 1, up 1, left 1\n  \
             fewest cells: the same path\n\
             closed: the goal cannot be reached\n"
        );
        assert_eq!(
            listing(&mazes, &solutions, true),
            "test_maze_01: 17 steps, 30 cells, oracle score 17.600\n\
             closed: the goal cannot be reached\n"
        );
    }

    #[test]
    fn json_is_exact() {
        let (mazes, solutions) = two();
        let text = json(&mazes, &solutions);
        let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let solution = &value["mazes"][0]["solution"];
        assert_eq!(solution["fewest_steps"]["steps"], 17);
        assert_eq!(
            solution["fewest_steps"]["stops"][1],
            serde_json::json!([0, 2])
        );
        assert_eq!(solution["fewest_cells"]["cells"], 30);
        assert_eq!(solution["oracle"]["thousandths"], 17600);
        assert!(value["mazes"][1]["solution"].is_null());
    }
}
