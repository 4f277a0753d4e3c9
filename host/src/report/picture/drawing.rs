//! [`Picture`]: what is drawn, before it is drawn.
//!
//! A picture is filled from a maze, a distance map, a path or the beliefs of a robot, and then
//! drawn as [text](Picture::to_text) or [SVG](Picture::to_svg). Untrusted text in it is made
//! harmless when it enters ([`Label`]).

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::maze::{Area, Cell, Distances, Heading, Maze, Path};

use super::label::{Label, replace_hostile};
use super::paint::Paint;

/// What a picture shows of the wall on one side of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wall {
    /// Nobody has looked: drawn as dots.
    Unknown,
    /// Nothing stands there.
    Open,
    /// A wall stands there.
    Closed,
}

/// What a picture shows in one cell. The default shows nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mark {
    /// A number, such as a distance.
    pub number: Option<u32>,
    /// Warmth on a scale of its own: the warmest cell of the picture is hot,
    /// 0 is cold, and `None` has no temperature.
    pub heat: Option<u32>,
    /// A colour.
    pub paint: Option<Paint>,
    /// A short text; shown instead of the number where there is room for one.
    pub label: Label,
}

/// A drawing of a maze or of what is known of it.
///
/// ```
/// use wasmouse_core::maze::{Maze, Metric, Walls, shortest_path};
/// use wasmouse::report::picture::{Picture, TextStyle};
/// let maze = Maze::contest(Walls::open(4)).expect("a start outside the goal");
/// let mut picture = Picture::of(&maze);
/// picture.set_path(&shortest_path(&maze, Metric::STEPS).expect("nothing is in the way"));
/// let text = picture.to_text(TextStyle::ASCII);
/// assert!(text.ends_with("| S             |\no---o---o---o---o\n"), "{text}");
/// ```
#[derive(Clone, Debug)]
pub struct Picture {
    pub(super) title: String,
    pub(super) dimension: u8,
    pub(super) start: Cell,
    pub(super) goal: Area,
    /// By cell index: the walls above and to the right of the cell.
    walls: Vec<[Wall; 2]>,
    pub(super) marks: Vec<Mark>,
    pub(super) stops: Vec<Cell>,
    pub(super) optimum: Vec<Cell>,
    pub(super) robot: Option<(Cell, Heading)>,
    /// What is hot, at least.
    hot: u32,
}

impl Picture {
    /// The picture of a maze, with all its walls.
    pub fn of(maze: &Maze) -> Self {
        let mut picture = Self::unknown(maze.dimension(), maze.start(), maze.goal());
        for cell in maze.walls().cells() {
            for side in [Heading::Up, Heading::Right] {
                let wall = if maze.walls().is_open(cell, side) {
                    Wall::Open
                } else {
                    Wall::Closed
                };
                picture.set_wall(cell, side, wall);
            }
        }
        picture
    }

    /// The picture of a maze of which nothing is known but its size, perimeter,
    /// start and goal. The dimension is in cells.
    pub fn unknown(dimension: u8, start: Cell, goal: Area) -> Self {
        let cells = usize::from(dimension).pow(2);
        Self {
            title: String::from("maze"),
            dimension,
            start,
            goal,
            walls: vec![[Wall::Unknown; 2]; cells],
            marks: vec![Mark::default(); cells],
            stops: Vec::new(),
            optimum: Vec::new(),
            robot: None,
            hot: 1,
        }
    }

    /// Names what is drawn. Default: `maze`. Any text; renderers escape it.
    pub fn set_title<'a>(&mut self, title: impl Into<GuestStr<'a>>) {
        self.title = replace_hostile(title);
    }

    /// Shows the wall on one side of a cell, for both its cells. Cells outside
    /// the maze are ignored, and the perimeter stays closed.
    pub fn set_wall(&mut self, cell: Cell, side: Heading, wall: Wall) {
        if let Some((index, place)) = self.wall_place(cell, side) {
            self.walls[index][place] = wall;
        }
    }

    /// Puts the robot into a cell, looking in a direction.
    pub const fn set_robot(&mut self, cell: Cell, heading: Heading) {
        self.robot = Some((cell, heading));
    }

    /// Draws a path from the start.
    pub fn set_path(&mut self, path: &Path) {
        self.set_stops(path.stops());
    }

    /// Draws a path as the cells where its steps end. Each should lie in a
    /// straight line from the one before; cells outside the maze are left out.
    pub fn set_stops(&mut self, stops: &[Cell]) {
        let inside = |cell: &Cell| self.index(*cell).is_some();
        self.stops = stops.iter().copied().filter(inside).collect();
    }

    /// Draws an optimal path behind the other one. Only SVG shows it: text has one character for a
    /// place on a path.
    pub fn set_optimum(&mut self, path: &Path) {
        let inside = |cell: &Cell| self.index(*cell).is_some();
        self.optimum = path.stops().iter().copied().filter(inside).collect();
    }

    /// Writes its distance into every cell that has one.
    pub fn set_numbers(&mut self, distances: &Distances) {
        self.for_each_mark(|cell, mark| mark.number = distances.get(cell));
    }

    /// Colours every cell that has a distance, the farthest hottest.
    pub fn set_heat(&mut self, distances: &Distances) {
        self.for_each_mark(|cell, mark| mark.heat = distances.get(cell));
    }

    /// Sets the least temperature that is hot, so that pictures in which all cells are about as warm
    /// are not all hot. Default: 1.
    pub const fn set_hot(&mut self, heat: u32) {
        self.hot = heat;
    }

    /// What is shown in a cell; `None` outside the maze.
    pub fn mark_mut(&mut self, cell: Cell) -> Option<&mut Mark> {
        self.index(cell).map(|index| &mut self.marks[index])
    }

    fn for_each_mark(&mut self, change: impl Fn(Cell, &mut Mark)) {
        for cell in cells(self.dimension) {
            let index = self.index(cell).expect("the cells of the picture");
            change(cell, &mut self.marks[index]);
        }
    }

    pub(super) fn index(&self, cell: Cell) -> Option<usize> {
        let n = self.dimension;
        let inside = cell.x < n && cell.y < n;
        inside.then(|| usize::from(cell.x) * usize::from(n) + usize::from(cell.y))
    }

    /// Where a wall is kept; `None` for the perimeter and outside.
    pub(super) fn wall_place(&self, cell: Cell, side: Heading) -> Option<(usize, usize)> {
        self.index(cell)?;
        let neighbor = cell.step(side)?;
        self.index(neighbor)?;
        match side {
            Heading::Up => Some((self.index(cell)?, 0)),
            Heading::Right => Some((self.index(cell)?, 1)),
            Heading::Down => Some((self.index(neighbor)?, 0)),
            Heading::Left => Some((self.index(neighbor)?, 1)),
        }
    }

    /// The wall on one side of a cell of the picture.
    pub(super) fn wall(&self, cell: Cell, side: Heading) -> Wall {
        match self.wall_place(cell, side) {
            Some((index, place)) => self.walls[index][place],
            None => Wall::Closed,
        }
    }

    pub(super) fn mark(&self, cell: Cell) -> &Mark {
        let index = self.index(cell).expect("renderers stay in the picture");
        &self.marks[index]
    }

    /// Whether nobody has looked at any side of the cell.
    pub(super) fn is_unknown(&self, cell: Cell) -> bool {
        let inner = |&side: &Heading| self.wall_place(cell, side).is_some();
        let mut sides = Heading::ALL.into_iter().filter(inner);
        sides.all(|side| self.wall(cell, side) == Wall::Unknown)
    }

    /// How hot a cell is, from 0 to `levels`; a temperature of 0 is level 0.
    pub(super) fn heat_level(&self, cell: Cell, levels: u32) -> Option<u32> {
        let heat = self.mark(cell).heat?;
        let hottest = self
            .marks
            .iter()
            .filter_map(|mark| mark.heat)
            .max()?
            .max(self.hot)
            .max(1);
        // 64 bits, because any number may be given as a temperature.
        let level = (u64::from(heat) * u64::from(levels)).div_ceil(u64::from(hottest));
        Some(u32::try_from(level).expect("at most `levels`"))
    }

    /// The picture in words, for those who cannot see it.
    pub(super) fn description(&self) -> String {
        let n = self.dimension;
        let mut text = format!("{n} x {n} cells, start {}", self.start);
        if let (Some(last), steps @ 1..) = (self.stops.last(), self.stops.len().saturating_sub(1)) {
            text.push_str(&format!(", path of {steps} steps to {last}"));
        }
        if let Some((cell, heading)) = self.robot {
            text.push_str(&format!(", robot at {cell} heading {heading}"));
        }
        text
    }
}

/// All cells of a square, column by column.
pub(super) fn cells(dimension: u8) -> impl Iterator<Item = Cell> {
    (0..dimension).flat_map(move |x| (0..dimension).map(move |y| Cell::new(x, y)))
}
