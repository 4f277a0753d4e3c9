//! [`Scene`]: what is drawn of a maze, before it is drawn. Untrusted text in it is a
//! [`Label`], which has replaced what could do harm.

use wasmouse_core::maze::{Area, Cell, Heading, Maze};

use crate::report::picture::{Label, Paint, Wall};

/// How a path goes through a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A step ends there.
    End,
    /// A step passes through.
    Through,
}

/// What is shown in a cell. The default is nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mark {
    /// A number, such as a distance.
    pub number: Option<u32>,
    /// Heat from 0 to [`HEAT_LEVELS`](super::look::HEAT_LEVELS).
    pub heat: Option<u8>,
    /// A colour.
    pub paint: Option<Paint>,
    /// A short text; shown instead of the number.
    pub label: Label,
    /// The path of the robot.
    pub path: Option<Step>,
    /// A path that is possible or optimal; hidden by the other one.
    pub optimum: Option<Step>,
    /// Whether something is wrong with the cell.
    pub flagged: bool,
}

/// A maze, or what is known of it, and everything that is in it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Cells along each side.
    pub dimension: u8,
    /// The start.
    pub start: Cell,
    /// The goal.
    pub goal: Area,
    /// The robot.
    pub robot: Option<(Cell, Heading)>,
    /// The cell that keys act on.
    pub cursor: Option<Cell>,
    /// By cell index: the walls above and to the right of the cell.
    walls: Vec<[Wall; 2]>,
    marks: Vec<Mark>,
}

impl Scene {
    /// The scene of a maze of which these walls are shown. Each wall between two cells is asked
    /// for once, as a side up or right of a cell.
    pub fn new(maze: &Maze, wall: impl Fn(Cell, Heading) -> Wall) -> Self {
        let cells = maze.walls().cells();
        let walls: Vec<[Wall; 2]> = cells
            .map(|cell| {
                [Heading::Up, Heading::Right].map(|side| match maze.walls().neighbor(cell, side) {
                    Some(_) => wall(cell, side),
                    None => Wall::Closed,
                })
            })
            .collect();
        Self {
            dimension: maze.dimension(),
            start: maze.start(),
            goal: maze.goal(),
            robot: None,
            cursor: None,
            marks: vec![Mark::default(); walls.len()],
            walls,
        }
    }

    /// The scene of a maze with all its walls.
    pub fn of(maze: &Maze) -> Self {
        Self::new(maze, |cell, side| {
            if maze.walls().is_open(cell, side) {
                Wall::Open
            } else {
                Wall::Closed
            }
        })
    }

    /// What is shown in a cell; `None` outside the maze.
    pub fn mark_mut(&mut self, cell: Cell) -> Option<&mut Mark> {
        self.index(cell).map(|index| &mut self.marks[index])
    }

    /// What is shown in a cell of the maze.
    ///
    /// # Panics
    ///
    /// Outside the maze.
    pub fn mark(&self, cell: Cell) -> &Mark {
        &self.marks[self.index(cell).expect("a cell of the maze")]
    }

    /// Draws the path of the robot, given as the cells where its steps end.
    pub fn set_path(&mut self, stops: &[Cell]) {
        self.follow(stops, |mark| &mut mark.path);
    }

    /// Draws a path that is possible or optimal, given in the same way.
    pub fn set_optimum(&mut self, stops: &[Cell]) {
        self.follow(stops, |mark| &mut mark.optimum);
    }

    /// Shades cells by numbers, by cell index; the largest is hottest and 0 is not shaded.
    pub fn set_heat(&mut self, numbers: &[u32]) {
        let levels = u64::from(super::look::HEAT_LEVELS);
        let most = u64::from(numbers.iter().copied().max().unwrap_or(0).max(1));
        for (mark, &number) in self.marks.iter_mut().zip(numbers) {
            let level = (u64::from(number) * levels).div_ceil(most);
            mark.heat = (number > 0).then(|| u8::try_from(level).expect("at most the levels"));
        }
    }

    /// The wall on one side of a cell; closed at the perimeter and outside.
    pub fn wall(&self, cell: Cell, side: Heading) -> Wall {
        let place = self.place(cell, side);
        place.map_or(Wall::Closed, |(index, side)| self.walls[index][side])
    }

    /// Shows the wall on one side of a cell, for both its cells. The perimeter stays closed, and
    /// what is outside is ignored.
    pub fn set_wall(&mut self, cell: Cell, side: Heading, wall: Wall) {
        if let Some((index, place)) = self.place(cell, side) {
            self.walls[index][place] = wall;
        }
    }

    /// Where a wall between two cells is kept.
    fn place(&self, cell: Cell, side: Heading) -> Option<(usize, usize)> {
        let neighbor = cell.step(side)?;
        let (here, there) = (self.index(cell)?, self.index(neighbor)?);
        Some(match side {
            Heading::Up => (here, 0),
            Heading::Right => (here, 1),
            Heading::Down => (there, 0),
            Heading::Left => (there, 1),
        })
    }

    fn index(&self, cell: Cell) -> Option<usize> {
        let n = self.dimension;
        let inside = cell.x < n && cell.y < n;
        inside.then(|| usize::from(cell.x) * usize::from(n) + usize::from(cell.y))
    }

    fn follow(&mut self, stops: &[Cell], place: impl Fn(&mut Mark) -> &mut Option<Step>) {
        for pair in stops.windows(2) {
            for cell in straight(pair[0], pair[1]) {
                if let Some(mark) = self.mark_mut(cell) {
                    *place(mark) = Some(Step::Through);
                }
            }
        }
        for &stop in stops {
            if let Some(mark) = self.mark_mut(stop) {
                *place(mark) = Some(Step::End);
            }
        }
    }
}

/// The cells between two in a row or column; none for two that are in neither.
fn straight(from: Cell, to: Cell) -> Vec<Cell> {
    let between = |a: u8, b: u8| a.min(b)..a.max(b);
    if from.x == to.x {
        let ys = between(from.y, to.y);
        ys.map(|y| Cell::new(from.x, y)).collect()
    } else if from.y == to.y {
        let xs = between(from.x, to.x);
        xs.map(|x| Cell::new(x, from.y)).collect()
    } else {
        Vec::new()
    }
}
