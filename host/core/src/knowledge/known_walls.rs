//! [`Knowledge`]: the walls that are known, and the mazes that they leave possible.

use super::outlook::Outlook;
use crate::game::{Action, Event, Sensors, Step};
use crate::journal::Belief;
use crate::maze::{Area, Cell, Heading, Maze, Metric, Turn, Walls, distances_to_goal};

/// The walls of a maze that are known at some moment.
///
/// ```
/// use wasmouse_core::game::Sensors;
/// use wasmouse_core::journal::Belief;
/// use wasmouse_core::knowledge::Knowledge;
/// use wasmouse_core::maze::{Cell, Heading, Maze, Walls};
///
/// let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
/// let mut knowledge = Knowledge::of_nothing(&maze);
/// let start = Cell::new(0, 0);
/// assert_eq!(knowledge.wall(start, Heading::Up), Belief::Unknown);
/// assert_eq!(knowledge.wall(start, Heading::Left), Belief::Closed);
/// let learned = knowledge.see(start, Heading::Up, Sensors { left: 0, front: 2, right: 0 });
/// assert_eq!(learned, 4);
/// assert_eq!(knowledge.wall(start, Heading::Up), Belief::Open);
/// assert_eq!(knowledge.wall(Cell::new(0, 2), Heading::Up), Belief::Closed);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Knowledge {
    start: Cell,
    goal: Area,
    /// The walls that are known to be there; all others are open.
    optimistic: Walls,
    /// Open where there is known to be no wall.
    pessimistic: Walls,
}

impl Knowledge {
    /// What is known before the first reading: size, perimeter, start and goal of the maze.
    pub fn of_nothing(maze: &Maze) -> Self {
        Self {
            start: maze.start(),
            goal: maze.goal(),
            optimistic: Walls::open(maze.dimension()),
            pessimistic: Walls::closed(maze.dimension()),
        }
    }

    /// What is known of the wall on that side of a cell.
    ///
    /// # Panics
    ///
    /// If `cell` is outside the maze.
    pub fn wall(&self, cell: Cell, side: Heading) -> Belief {
        if !self.optimistic.is_open(cell, side) {
            Belief::Closed
        } else if self.pessimistic.is_open(cell, side) {
            Belief::Open
        } else {
            Belief::Unknown
        }
    }

    /// The number of walls between two cells that may or may not be there.
    pub fn unknown_walls(&self) -> usize {
        let edges = self.optimistic.edges();
        edges
            .filter(|&(cell, side)| self.wall(cell, side) == Belief::Unknown)
            .count()
    }

    /// The maze if no unknown wall is there. No consistent maze has a shorter path anywhere.
    pub fn optimistic(&self) -> Maze {
        self.maze(&self.optimistic)
    }

    /// The maze if all unknown walls are there. No consistent maze has a longer path anywhere.
    pub fn pessimistic(&self) -> Maze {
        self.maze(&self.pessimistic)
    }

    fn maze(&self, walls: &Walls) -> Maze {
        Maze::new(walls.clone(), self.start, self.goal).expect("start and goal of the maze")
    }

    /// The fewest and the most steps that the optimal speed run can have.
    pub fn outlook(&self, longest_move: u8) -> Outlook {
        let steps =
            |maze: &Maze| distances_to_goal(maze, Metric::Steps { longest_move }).get(maze.start());
        Outlook {
            optimistic: steps(&self.optimistic()),
            pessimistic: steps(&self.pessimistic()),
        }
    }

    /// Learns from a reading in a cell and heading; returns the number of walls that were unknown
    /// before. A reading that leads out of the maze is true of its part inside.
    pub fn see(&mut self, cell: Cell, heading: Heading, sensors: Sensors) -> u32 {
        let Sensors { left, front, right } = sensors;
        let readings = [
            (Turn::Left, left),
            (Turn::Straight, front),
            (Turn::Right, right),
        ];
        let learn = |(turn, reach)| self.learn(cell, heading.turned(turn), reach, true);
        readings.map(learn).iter().sum()
    }

    /// Learns what driving backwards shows: that there were no walls, and where it was bumped by
    /// one. Driving forwards shows nothing that the readings did not. Returns the number of walls
    /// that were unknown before.
    pub fn drive(&mut self, step: &Step) -> u32 {
        match (step.action, step.event) {
            (
                Action::Move { advance, .. },
                Event::Moved {
                    heading,
                    cells,
                    bumped,
                    ..
                },
            ) if advance < 0 => self.learn(step.cell, heading.opposite(), cells, bumped),
            _ => 0,
        }
    }

    /// Learns that `reach` cells are open in that direction, and whether a wall follows.
    fn learn(&mut self, from: Cell, direction: Heading, reach: u8, ends_at_wall: bool) -> u32 {
        let mut learned = 0;
        let mut cell = from;
        for _ in 0..reach {
            let Some(next) = self.optimistic.neighbor(cell, direction) else {
                return learned;
            };
            learned += self.set(cell, direction, true);
            cell = next;
        }
        if ends_at_wall && self.optimistic.neighbor(cell, direction).is_some() {
            learned += self.set(cell, direction, false);
        }
        learned
    }

    fn set(&mut self, cell: Cell, side: Heading, open: bool) -> u32 {
        let was_unknown = self.wall(cell, side) == Belief::Unknown;
        self.optimistic.set(cell, side, open);
        self.pessimistic.set(cell, side, open);
        u32::from(was_unknown)
    }
}
