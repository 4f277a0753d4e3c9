//! [`Facts`]: what follows from the walls of a maze: the rules that it breaks, the optimum, and
//! what makes it hard.

use wasmouse_core::game::{GameRules, Score};
use wasmouse_core::maze::{Heading, Maze, Metric, Path, Violation, shortest_path, violations};

/// What is shown beside a maze that is edited.
pub struct Facts {
    /// The contest rules that it breaks.
    pub broken: Vec<Violation>,
    /// The path with the fewest steps; `None` if the goal cannot be reached.
    pub fewest_steps: Option<Path>,
    /// The path with the fewest cells.
    pub fewest_cells: Option<Path>,
    /// The score of a robot that knows the maze, by the ruleset `udacity`.
    pub oracle: Option<Score>,
    /// Cells with one open side, without the start.
    pub dead_ends: usize,
    /// Cells with three or four open sides, without the goal.
    pub junctions: usize,
    /// Walls that would have to be built until there is only one path between any two cells that
    /// are connected now.
    pub loops: usize,
    /// Turns on the path with the fewest steps.
    pub turns: usize,
}

impl Facts {
    /// The facts about a maze.
    pub fn of(maze: &Maze) -> Self {
        let walls = maze.walls();
        let fewest_steps = shortest_path(maze, Metric::STEPS);
        let open_sides = |cell| walls.value(cell).count_ones();
        let dead_end = |&cell: &_| open_sides(cell) == 1 && cell != maze.start();
        let junction = |&cell: &_| open_sides(cell) >= 3 && !maze.goal().contains(cell);
        Self {
            broken: violations(maze),
            oracle: GameRules::default().oracle_score(maze),
            dead_ends: walls.cells().filter(dead_end).count(),
            junctions: walls.cells().filter(junction).count(),
            loops: loops(maze),
            turns: fewest_steps.as_ref().map_or(0, turns),
            fewest_cells: shortest_path(maze, Metric::Cells),
            fewest_steps,
        }
    }
}

fn turns(path: &Path) -> usize {
    let headings: Vec<Heading> = path.moves().map(|(heading, _)| heading).collect();
    let bends = headings.windows(2).filter(|pair| pair[0] != pair[1]);
    // A run starts heading up.
    let first = headings.first().is_some_and(|it| *it != Heading::Up);
    bends.count() + usize::from(first)
}

/// The openings beyond those of a tree in each connected part: openings - cells + parts.
fn loops(maze: &Maze) -> usize {
    let walls = maze.walls();
    let openings: usize = walls
        .cells()
        .map(|cell| walls.value(cell).count_ones() as usize)
        .sum();
    let mut seen = vec![false; walls.cells().count()];
    let mut parts = 0;
    for first in walls.cells() {
        if seen[walls.index(first)] {
            continue;
        }
        parts += 1;
        let mut open = vec![first];
        seen[walls.index(first)] = true;
        while let Some(cell) = open.pop() {
            for side in Heading::ALL {
                let neighbor = walls.neighbor(cell, side);
                let Some(next) = neighbor.filter(|_| walls.is_open(cell, side)) else {
                    continue;
                };
                if !seen[walls.index(next)] {
                    seen[walls.index(next)] = true;
                    open.push(next);
                }
            }
        }
    }
    openings / 2 + parts - seen.len()
}

#[cfg(test)]
mod tests {
    use wasmouse_core::maze::{Cell, Walls, bundled, format};

    use super::*;

    #[test]
    fn the_first_official_maze() {
        let maze = format::parse(bundled()[0].text).expect("a maze").maze;
        let facts = Facts::of(&maze);
        assert!(facts.broken.is_empty());
        let steps = facts.fewest_steps.expect("a path");
        assert_eq!((steps.steps(), facts.turns), (17, 15));
        assert_eq!(facts.oracle.expect("a score").to_string(), "17.600");
    }

    #[test]
    fn loops_and_dead_ends_are_counted() {
        let mut walls = Walls::closed(3);
        let facts = |walls: &Walls| Facts::of(&Maze::contest(walls.clone()).expect("it fits"));
        assert_eq!(facts(&walls).loops, 0);
        // A square of four cells, and a dead end beside it.
        for (x, y, side) in [
            (0, 0, Heading::Up),
            (0, 0, Heading::Right),
            (1, 0, Heading::Up),
            (0, 1, Heading::Right),
            (1, 0, Heading::Right),
        ] {
            walls.set(Cell::new(x, y), side, true);
        }
        let found = facts(&walls);
        assert_eq!((found.loops, found.dead_ends, found.junctions), (1, 1, 1));
        assert_eq!(facts(&Walls::open(3)).loops, 4);
    }
}
