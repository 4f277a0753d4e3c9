//! Pictures: competition text, the format of public micromouse maze collections, and the
//! text map of micromouse simulators such as mms.
//!
//! ```text
//! o---o---o---o      rows of posts and horizontal walls, the top first
//! |         G |      rows of cells and vertical walls
//! o   o---o   o      a cell is four characters wide and two lines high,
//! |       |   |      counting one of its posts and walls
//! o---o   o   o
//! | S |       |
//! o---o---o---o
//! ```
//!
//! [`Style`] has the differences. In both styles `S` marks the start and `G` the goal cells.
//! Without `S` the start is (0, 0), without `G` the goal is the centre (training mazes have
//! neither).

use super::super::{Area, Cell, Heading, Maze, Walls};
use super::ParseError;
use super::row::{Drawing, Row, cell_row};
use super::text::Line;

const DRAWING: Drawing = Drawing {
    cell_width: CELL_WIDTH,
    first_line: "a whole number of cells, four characters each, and a post",
    wall_row: "a row of posts and walls",
};

/// Characters from one post to the next.
const CELL_WIDTH: usize = 4;

/// Which of the two formats is parsed or printed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Style {
    /// Posts `o`, walls `---` and `|`. Both marks are always printed.
    Competition,
    /// Any visible character is a wall; any character is a post, even a space, because
    /// simulators look at the walls only. Printed with posts `+` and without marks, which
    /// are not part of the format.
    Map,
}

impl Style {
    fn is_post(self, found: char) -> bool {
        match self {
            Self::Competition => found == 'o',
            Self::Map => found == ' ' || is_visible(found),
        }
    }

    fn is_wall(self, found: char, drawn: char) -> bool {
        match self {
            Self::Competition => found == drawn,
            Self::Map => is_visible(found),
        }
    }

    fn post(self) -> char {
        match self {
            Self::Competition => 'o',
            Self::Map => '+',
        }
    }
}

fn is_visible(character: char) -> bool {
    !character.is_whitespace() && !character.is_control()
}

pub(super) fn parse(lines: &[Line<'_>], style: Style) -> Result<Maze, ParseError> {
    let dimension = DRAWING.dimension(lines)?;
    let mut picture = Picture {
        style,
        walls: Walls::closed(dimension),
        start: None,
        goal: Vec::new(),
    };
    for (index, line) in lines.iter().enumerate() {
        let row = Row::new(line);
        if index % 2 == 0 {
            picture.posts(&row, index / 2)?;
        } else {
            picture.cells(&row, index / 2)?;
        }
        DRAWING.end(&row, usize::from(dimension))?;
    }
    picture.finish()
}

/// A maze while its picture is parsed.
struct Picture {
    style: Style,
    walls: Walls,
    start: Option<Cell>,
    goal: Vec<Cell>,
}

impl Picture {
    /// Parses a row of posts and horizontal walls, the `above`-th from the top.
    fn posts(&mut self, row: &Row<'_>, above: usize) -> Result<(), ParseError> {
        let rows = usize::from(self.walls.dimension());
        let perimeter = above == 0 || above == rows;
        for x in 0..self.walls.dimension() {
            let left = usize::from(x) * CELL_WIDTH;
            self.post(row, left)?;
            let wall = self.wall(row, left + 1, '-', perimeter)?;
            for index in [left + 2, left + 3] {
                if self.wall(row, index, '-', perimeter)? != wall {
                    let expected = if wall { "`-`" } else { "a space" };
                    return Err(
                        row.unexpected(index, format!("{expected} like the character before"))
                    );
                }
            }
            if !perimeter {
                let y = cell_row(self.walls.dimension(), above);
                self.walls.set(Cell::new(x, y), Heading::Up, !wall);
            }
        }
        self.post(row, rows * CELL_WIDTH)
    }

    /// Parses a row of cells and vertical walls, the `above`-th from the top.
    fn cells(&mut self, row: &Row<'_>, above: usize) -> Result<(), ParseError> {
        let dimension = self.walls.dimension();
        let y = cell_row(dimension, above);
        for x in 0..dimension {
            let left = usize::from(x) * CELL_WIDTH;
            let wall = self.wall(row, left, '|', x == 0)?;
            if x > 0 {
                self.walls.set(Cell::new(x, y), Heading::Left, !wall);
            }
            self.inside(row, left + 1, Cell::new(x, y))?;
        }
        self.wall(row, usize::from(dimension) * CELL_WIDTH, '|', true)?;
        Ok(())
    }

    fn post(&self, row: &Row<'_>, index: usize) -> Result<(), ParseError> {
        match row.at(index) {
            Some(found) if self.style.is_post(found) => Ok(()),
            _ if self.style == Style::Competition => Err(row.unexpected(index, "a post `o`")),
            _ => Err(row.unexpected(index, "a post")),
        }
    }

    /// Whether there is a wall, which competition text draws as `drawn`.
    fn wall(
        &self,
        row: &Row<'_>,
        index: usize,
        drawn: char,
        perimeter: bool,
    ) -> Result<bool, ParseError> {
        match row.at(index) {
            Some(found) if self.style.is_wall(found, drawn) => Ok(true),
            Some(' ') if !perimeter => Ok(false),
            _ if perimeter => {
                let expected = format!("`{drawn}` (the perimeter is closed)");
                Err(row.unexpected(index, expected))
            }
            _ => Err(row.unexpected(index, format!("`{drawn}` or a space"))),
        }
    }

    /// Parses the three characters inside a cell.
    fn inside(&mut self, row: &Row<'_>, index: usize, cell: Cell) -> Result<(), ParseError> {
        for index in [index, index + 2] {
            if row.at(index) != Some(' ') {
                return Err(row.unexpected(index, "a space"));
            }
        }
        match row.at(index + 1) {
            Some(' ') => {}
            Some('G') => self.goal.push(cell),
            Some('S') => {
                if let Some(first) = self.start {
                    return Err(ParseError::SecondStart {
                        line: row.number(),
                        column: index + 2,
                        first,
                    });
                }
                self.start = Some(cell);
            }
            _ => return Err(row.unexpected(index + 1, "a space, `S` or `G`")),
        }
        Ok(())
    }

    fn finish(self) -> Result<Maze, ParseError> {
        let start = self.start.unwrap_or(Cell::new(0, 0));
        let goal = match Area::bounding(&self.goal) {
            None => Area::center(self.walls.dimension()),
            // No cell is listed twice, so equal counts mean a filled rectangle.
            Some(area) if area.cells().count() == self.goal.len() => area,
            Some(_) => return Err(ParseError::GoalShape(self.goal)),
        };
        Ok(Maze::new(self.walls, start, goal)?)
    }
}

pub(super) fn print(maze: &Maze, style: Style) -> String {
    let dimension = maze.dimension();
    let mut text = String::new();
    for y in (0..dimension).rev() {
        print_posts(maze, y, Heading::Up, style, &mut text);
        for x in 0..dimension {
            let cell = Cell::new(x, y);
            let open = maze.walls().is_open(cell, Heading::Left);
            text.push(if open { ' ' } else { '|' });
            text.extend([' ', mark(maze, cell, style), ' ']);
        }
        text.push_str("|\n");
    }
    print_posts(maze, 0, Heading::Down, style, &mut text);
    text
}

fn print_posts(maze: &Maze, y: u8, side: Heading, style: Style, text: &mut String) {
    for x in 0..maze.dimension() {
        let open = maze.walls().is_open(Cell::new(x, y), side);
        text.push(style.post());
        text.push_str(if open { "   " } else { "---" });
    }
    text.push(style.post());
    text.push('\n');
}

fn mark(maze: &Maze, cell: Cell, style: Style) -> char {
    match style {
        Style::Competition if maze.start() == cell => 'S',
        Style::Competition if maze.goal().contains(cell) => 'G',
        Style::Competition | Style::Map => ' ',
    }
}
