//! `wasmouse maze solve`: the best that any robot could do in a maze.

use std::fmt::Write as _;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::mazes::{self, Legality, NamedMaze};
use super::super::output;
use wasmouse_core::maze::{Floor, Metric, Path, omniscient_floor, shortest_path};
use crate::report::maze_solve::{MazeSolve, SolutionJson, SolvedMaze};
use crate::sim::{Ruleset, Score};

const EXAMPLES: &str = "\
Examples:
  wasmouse maze solve test_maze_01
  wasmouse maze solve my-mazes gen:braid:16:1..=100 --brief
  wasmouse maze solve a.txt --lenient --json

Exit codes:
  0  every maze has a solution
  1  a maze has none";

/// Find the optimal paths of mazes, in steps and in cells.
///
/// A step drives up to three cells in a straight line, as the ruleset `udacity`
/// has it. Among the paths with the fewest steps the one with the fewest cells
/// is printed, and the other way round. The floor is the score of a robot that
/// knows the maze: it drives the optimal path, resets, and drives it again. No
/// robot can score lower.
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

/// The optimal ways to the goal of one maze.
struct Solution {
    fewest_steps: Path,
    fewest_cells: Path,
    floor: Floor,
    score: Score,
}

/// Runs the command: all mazes are solved, also after one without a solution.
pub fn run(args: Args) -> Result<Exit, Failure> {
    let mazes = mazes::load(&args.mazes, Legality::from_flag(args.lenient))?;
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

fn solve(named: &NamedMaze) -> Option<Solution> {
    let rules = Ruleset::default();
    let steps = Metric::Steps {
        longest_move: rules.longest_move,
    };
    let floor = omniscient_floor(&named.maze, rules.longest_move)?;
    Some(Solution {
        fewest_steps: shortest_path(&named.maze, steps)?,
        fewest_cells: shortest_path(&named.maze, Metric::Cells)?,
        floor,
        score: Score::new(
            floor.speed_steps,
            floor.exploration_steps,
            rules.exploration_divisor,
        ),
    })
}

fn listing(mazes: &[NamedMaze], solutions: &[Option<Solution>], brief: bool) -> String {
    let mut text = String::new();
    let mut line = |line: std::fmt::Arguments<'_>| {
        writeln!(text, "{line}").expect("writing to a string never fails");
    };
    for (named, solution) in mazes.iter().zip(solutions) {
        let name = &named.name;
        let Some(solution) = solution else {
            line(format_args!("{name}: no way leads to the goal"));
            continue;
        };
        let (steps, cells) = (&solution.fewest_steps, &solution.fewest_cells);
        let score = solution.score;
        line(format_args!("{name}: {}, floor {score}", length(steps)));
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
    format!("{} steps, {} cells", path.steps(), path.cells())
}

/// The path as a robot drives it: `up 3, right 1`.
fn directions(path: &Path) -> String {
    let moves = path
        .moves()
        .map(|(heading, cells)| format!("{heading} {cells}"));
    moves.collect::<Vec<_>>().join(", ")
}

fn json(mazes: &[NamedMaze], solutions: &[Option<Solution>]) -> String {
    let solved = mazes
        .iter()
        .zip(solutions)
        .map(|(named, solution)| SolvedMaze {
            maze: named.name.clone(),
            dimension: named.maze.dimension(),
            solution: solution.as_ref().map(|found| {
                SolutionJson::new(
                    &found.fewest_steps,
                    &found.fewest_cells,
                    found.floor,
                    found.score,
                )
            }),
        });
    MazeSolve::new(solved.collect()).to_json()
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_core::maze::{Maze, Walls};

    /// The official maze, and one without openings.
    fn two() -> (Vec<NamedMaze>, Vec<Option<Solution>>) {
        let mut mazes =
            mazes::load(&["test_maze_01".to_owned()], Legality::Contest).expect("bundled");
        let closed = Maze::contest(Walls::closed(12)).expect("room for both");
        mazes.push(NamedMaze {
            name: "closed".to_owned(),
            maze: closed,
        });
        let solutions = mazes.iter().map(solve).collect();
        (mazes, solutions)
    }

    #[test]
    fn listings_have_optimum_floor_and_path() {
        let (mazes, solutions) = two();
        assert_eq!(
            listing(&mazes, &solutions, false),
            "test_maze_01: 17 steps, 30 cells, floor 17.600\n  \
             fewest steps: up 2, right 1, down 2, right 3, up 2, right 2, down 1, right 1, \
             down 1, right 1, right 3, up 3, left 3, up 2, left 1, up 1, left 1\n  \
             fewest cells: the same path\n\
             closed: no way leads to the goal\n"
        );
        assert_eq!(
            listing(&mazes, &solutions, true),
            "test_maze_01: 17 steps, 30 cells, floor 17.600\n\
             closed: no way leads to the goal\n"
        );
    }

    #[test]
    fn json_is_exact() {
        let (mazes, solutions) = two();
        let text = json(&mazes, &solutions);
        let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(value["schema"], 1);
        let solution = &value["mazes"][0]["solution"];
        assert_eq!(solution["fewest_steps"]["steps"], 17);
        assert_eq!(
            solution["fewest_steps"]["stops"][1],
            serde_json::json!([0, 2])
        );
        assert_eq!(solution["fewest_cells"]["cells"], 30);
        assert_eq!(solution["floor"]["exploration_steps"], 18);
        assert_eq!(solution["floor"]["score"], "17.600");
        assert!(value["mazes"][1]["solution"].is_null());
    }
}
