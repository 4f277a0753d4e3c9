//! The contest rules for mazes: which of them a maze breaks, and in which cells.
//!
//! A [`Maze`] is always square and consistent, with a closed perimeter. Mazes of real
//! competitions may still break contest rules: they have several entrances to the goal,
//! unreachable cells or a goal elsewhere. Matches in such mazes are possible if the user
//! allows it.

use std::fmt;

use super::listed::Listed;
use super::{Area, Cell, Heading, Maze, Metric, distances_from};

/// The smallest contest maze, in cells along each side.
const CONTEST_DIMENSION_MIN: u8 = 12;

/// The largest contest maze, in cells along each side. The specification of the contest
/// allows 16; its reports go up to 20.
const CONTEST_DIMENSION_MAX: u8 = 20;

/// The start of contest mazes.
const CONTEST_START: Cell = Cell::new(0, 0);

/// An open edge between the goal and a cell outside.
///
/// Both cells identify it, because a goal cell in a corner may have two entrances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entrance {
    /// The cell outside the goal.
    pub outside: Cell,
    /// The goal cell.
    pub inside: Cell,
}

impl fmt::Display for Entrance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", self.outside, self.inside)
    }
}

/// A wall between two cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InnerWall {
    /// The cell to the left of or below the wall.
    pub cell: Cell,
    /// The cell on the other side.
    pub neighbor: Cell,
}

impl fmt::Display for InnerWall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} | {}", self.cell, self.neighbor)
    }
}

/// A contest rule that a maze breaks, with the cells that break it.
///
/// The message states the rule, then what the maze has. It names at most eight cells and
/// counts the others.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Violation {
    /// The size is odd or outside 12..=20.
    #[error(
        "the size must be an even number from {CONTEST_DIMENSION_MIN} to \
         {CONTEST_DIMENSION_MAX}: it is {dimension}"
    )]
    Dimension {
        /// Cells along each side.
        dimension: u8,
    },
    /// The start is not (0, 0).
    #[error("the start must be {CONTEST_START}: it is {start}")]
    Start {
        /// The start of the maze.
        start: Cell,
    },
    /// The start is closed at the top or open elsewhere.
    #[error("the start must be open at the top only: {start} is {}", open_sides_text(.open))]
    StartWalls {
        /// The start of the maze.
        start: Cell,
        /// Its open sides, clockwise from up; may be empty.
        open: Vec<Heading>,
    },
    /// The goal is not the room in the centre.
    #[error("the goal must be the 2 x 2 room in the centre: it is {} x {} cells at {}",
        .goal.width(), .goal.height(), .goal.origin())]
    Goal {
        /// The goal of the maze.
        goal: Area,
    },
    /// There are walls between goal cells.
    #[error("the goal must not have inner walls: {}", Listed(.0))]
    GoalWalls(
        /// All of them, by cell.
        Vec<InnerWall>,
    ),
    /// The goal has no entrance, or several.
    #[error("the goal must have exactly one entrance: {}", entrances(.0))]
    Entrances(
        /// All of them, by goal cell.
        Vec<Entrance>,
    ),
    /// Goal cells cannot be reached from the start.
    #[error("every goal cell must be reachable from the start: {} cannot be reached", Listed(.0))]
    GoalUnreachable(
        /// All of them, in the order of the cells.
        Vec<Cell>,
    ),
    /// Other cells cannot be reached from the start.
    #[error("every cell must be reachable from the start: {} cannot be reached", cells(.0))]
    Unreachable(
        /// All of them outside the goal, in the order of the cells.
        Vec<Cell>,
    ),
}

impl Violation {
    /// The name of the rule in JSON. It never changes once published.
    pub const fn rule(&self) -> &'static str {
        match self {
            Self::Dimension { .. } => "dimension",
            Self::Start { .. } => "start",
            Self::StartWalls { .. } => "start-walls",
            Self::Goal { .. } => "goal",
            Self::GoalWalls(_) => "goal-walls",
            Self::Entrances(_) => "entrances",
            Self::GoalUnreachable(_) => "goal-unreachable",
            Self::Unreachable(_) => "unreachable",
        }
    }

    /// All cells that break the rule, without a limit; empty if it is about the whole maze.
    ///
    /// For an entrance: the goal cell, then the cell outside. For a wall: both of its cells.
    pub fn cells(&self) -> Vec<Cell> {
        match self {
            Self::Dimension { .. } => Vec::new(),
            Self::Start { start } | Self::StartWalls { start, .. } => vec![*start],
            Self::Goal { goal } => goal.cells().collect(),
            Self::GoalWalls(walls) => walls
                .iter()
                .flat_map(|wall| [wall.cell, wall.neighbor])
                .collect(),
            Self::Entrances(entrances) => entrances
                .iter()
                .flat_map(|entrance| [entrance.inside, entrance.outside])
                .collect(),
            Self::GoalUnreachable(cells) | Self::Unreachable(cells) => cells.clone(),
        }
    }
}

fn open_sides_text(open: &[Heading]) -> String {
    match open {
        [] => "closed on all sides".to_owned(),
        _ => format!("open {}", Listed(open)),
    }
}

fn entrances(entrances: &[Entrance]) -> String {
    match entrances {
        [] => "it has none".to_owned(),
        _ => format!("it has {}: {}", entrances.len(), Listed(entrances)),
    }
}

fn cells(cells: &[Cell]) -> String {
    match cells {
        [cell] => cell.to_string(),
        _ => format!("{} cells ({})", cells.len(), Listed(cells)),
    }
}

/// All contest rules that the maze breaks, in the order of [`Violation`]; empty for a legal
/// contest maze.
///
/// ```
/// use wasmouse_core::maze::{Maze, Walls, violations};
/// let maze = Maze::contest(Walls::open(10)).expect("start and goal fit");
/// let broken: Vec<String> = violations(&maze).iter().map(ToString::to_string).collect();
/// assert_eq!(broken[0], "the size must be an even number from 12 to 20: it is 10");
/// assert_eq!(broken[1], "the start must be open at the top only: (0, 0) is open up, right");
/// assert!(broken[2].starts_with("the goal must have exactly one entrance: it has 8: (4, 3) to (4, 4)"));
/// ```
pub fn violations(maze: &Maze) -> Vec<Violation> {
    let mut broken = Vec::new();
    let dimension = maze.dimension();
    let sizes = CONTEST_DIMENSION_MIN..=CONTEST_DIMENSION_MAX;
    if !sizes.contains(&dimension) || !dimension.is_multiple_of(2) {
        broken.push(Violation::Dimension { dimension });
    }
    let start = maze.start();
    if start != CONTEST_START {
        broken.push(Violation::Start { start });
    }
    let open = open_sides(maze, start);
    if open != [Heading::Up] {
        broken.push(Violation::StartWalls { start, open });
    }
    let goal = maze.goal();
    if goal != Area::center(dimension) {
        broken.push(Violation::Goal { goal });
    }
    let walls = goal_walls(maze);
    if !walls.is_empty() {
        broken.push(Violation::GoalWalls(walls));
    }
    let entrances = goal_entrances(maze);
    if entrances.len() != 1 {
        broken.push(Violation::Entrances(entrances));
    }
    let (in_goal, elsewhere): (Vec<Cell>, Vec<Cell>) = unreachable_cells(maze)
        .into_iter()
        .partition(|&cell| goal.contains(cell));
    if !in_goal.is_empty() {
        broken.push(Violation::GoalUnreachable(in_goal));
    }
    if !elsewhere.is_empty() {
        broken.push(Violation::Unreachable(elsewhere));
    }
    broken
}

/// Whether the maze follows all contest rules.
pub fn is_contest_legal(maze: &Maze) -> bool {
    violations(maze).is_empty()
}

/// The entrances to the goal, by goal cell and then clockwise from up.
pub fn goal_entrances(maze: &Maze) -> Vec<Entrance> {
    let goal = maze.goal();
    let mut entrances = Vec::new();
    for inside in goal.cells() {
        for heading in open_sides(maze, inside) {
            let outside = maze.walls().neighbor(inside, heading);
            if let Some(outside) = outside.filter(|&cell| !goal.contains(cell)) {
                entrances.push(Entrance { outside, inside });
            }
        }
    }
    entrances
}

/// The cells that a robot cannot reach from the start, in the order of the cells.
pub fn unreachable_cells(maze: &Maze) -> Vec<Cell> {
    let distances = distances_from(maze, maze.start(), Metric::Cells);
    let cells = maze.walls().cells();
    cells
        .filter(|&cell| distances.get(cell).is_none())
        .collect()
}

fn open_sides(maze: &Maze, cell: Cell) -> Vec<Heading> {
    let is_open = |heading: &Heading| maze.walls().is_open(cell, *heading);
    Heading::ALL.into_iter().filter(is_open).collect()
}

fn goal_walls(maze: &Maze) -> Vec<InnerWall> {
    let (walls, goal) = (maze.walls(), maze.goal());
    let closed = walls
        .edges()
        .filter(|&(cell, side)| !walls.is_open(cell, side));
    let between_cells = closed.filter_map(|(cell, side)| {
        let neighbor = walls.neighbor(cell, side)?;
        Some(InnerWall { cell, neighbor })
    });
    between_cells
        .filter(|wall| goal.contains(wall.cell) && goal.contains(wall.neighbor))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maze::Walls;
    use crate::maze::format::parse;

    const LEGAL: &str = include_str!("../../mazes/test_maze_01.txt");

    /// A legal maze with changed walls, start and goal.
    fn changed(changes: &[(u8, u8, Heading, bool)], start: Cell, goal: Area) -> Maze {
        let mut walls: Walls = parse(LEGAL).expect("a maze").maze.walls().clone();
        for &(x, y, heading, open) in changes {
            walls.set(Cell::new(x, y), heading, open);
        }
        Maze::new(walls, start, goal).expect("start and goal fit")
    }

    #[track_caller]
    fn check(changes: &[(u8, u8, Heading, bool)], expected: &[&str]) {
        let maze = changed(changes, CONTEST_START, Area::center(12));
        let found: Vec<String> = violations(&maze).iter().map(ToString::to_string).collect();
        assert_eq!(found, expected, "{changes:?}");
        assert_eq!(is_contest_legal(&maze), expected.is_empty());
    }

    #[test]
    fn rules_about_walls_name_their_cells() {
        use Heading::{Down, Left, Right, Up};
        check(&[], &[]);
        check(
            &[(0, 0, Right, true)],
            &["the start must be open at the top only: (0, 0) is open up, right"],
        );
        check(
            &[(5, 5, Right, false)],
            &["the goal must not have inner walls: (5, 5) | (6, 5)"],
        );
        check(
            &[(5, 5, Left, true)],
            &[
                "the goal must have exactly one entrance: it has 2: (4, 5) to (5, 5), (7, 6) to (6, 6)",
            ],
        );
        check(
            &[
                (11, 0, Up, false),
                (11, 0, Left, false),
                (11, 1, Down, false),
            ],
            &["every cell must be reachable from the start: (11, 0) cannot be reached"],
        );
        check(
            &[(6, 6, Right, false)],
            &[
                "the goal must have exactly one entrance: it has none",
                "every goal cell must be reachable from the start: (5, 5), (5, 6), (6, 5), (6, 6) \
                 cannot be reached",
            ],
        );
    }

    #[test]
    fn nothing_is_reachable_from_a_closed_start() {
        check(
            &[(0, 0, Heading::Up, false)],
            &[
                "the start must be open at the top only: (0, 0) is closed on all sides",
                "every goal cell must be reachable from the start: (5, 5), (5, 6), (6, 5), (6, 6) \
                 cannot be reached",
                "every cell must be reachable from the start: 139 cells ((0, 1), (0, 2), (0, 3), \
                 (0, 4), (0, 5), (0, 6), (0, 7), (0, 8) and 131 more) cannot be reached",
            ],
        );
    }

    #[test]
    fn another_start_and_goal_break_rules() {
        let goal = Area::new(Cell::new(8, 3), 3, 3).expect("not empty");
        let maze = changed(&[], Cell::new(0, 1), goal);
        let rules: Vec<&str> = violations(&maze).iter().map(Violation::rule).collect();
        assert_eq!(rules[..3], ["start", "start-walls", "goal"]);
        let broken = violations(&maze);
        assert_eq!(
            broken[0].to_string(),
            "the start must be (0, 0): it is (0, 1)"
        );
        assert_eq!(
            broken[2].to_string(),
            "the goal must be the 2 x 2 room in the centre: it is 3 x 3 cells at (8, 3)"
        );
        assert_eq!(broken[2].cells().len(), 9);
    }

    #[test]
    fn sizes_are_even_and_from_12_to_20() {
        for dimension in 3..=64 {
            let maze = Maze::contest(Walls::open(dimension)).expect("start and goal fit");
            let broken = violations(&maze).contains(&Violation::Dimension { dimension });
            assert_eq!(!broken, [12, 14, 16, 18, 20].contains(&dimension));
        }
    }
}
