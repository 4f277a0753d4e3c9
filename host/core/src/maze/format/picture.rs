//! Pictures of a maze: competition text, simulator maps and block maps.
//!
//! ```text
//! o---o---o---o     1111111      rows of posts and horizontal walls, the top first
//! |         G |     1000001      rows of cells and vertical walls
//! o   o---o   o     1011101
//! |       |   |     1000101      a cell is four or two characters wide and two lines high,
//! o---o   o   o     1110101      counting one of its posts and walls
//! | S |       |     1010001
//! o---o---o---o     1111111
//! ```

use super::super::{Area, Cell, DIMENSIONS, Heading, Maze, Walls};
use super::ParseError;
use super::style::Style;
use super::text::{Line, quoted, quoted_character};

pub(super) fn parse(lines: &[Line<'_>], style: Style) -> Result<Maze, ParseError> {
    let dimension = dimension(lines, style)?;
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
        let length = picture.right() + 1;
        if row.characters.len() > length {
            let rest: String = row.characters[length..].iter().collect();
            let expected = format!("the end of the line after {dimension} cells");
            return Err(line.unexpected(length, expected, quoted(&rest)));
        }
    }
    picture.finish()
}

/// The size of the maze, from the length of the first line and the number of lines.
fn dimension(lines: &[Line<'_>], style: Style) -> Result<u8, ParseError> {
    let (first_line, wall_row) = match style {
        Style::Competition | Style::Map => (
            "a whole number of cells, four characters each, and a post",
            "a row of posts and walls",
        ),
        Style::Blocks => (
            "a whole number of cells, two characters each, and a wall",
            "a row of walls",
        ),
    };
    let length = |line| Row::new(line).characters.len();
    let width = length(&lines[0]);
    let columns = width / style.cell_width();
    if width % style.cell_width() != 1 {
        return Err(Row::new(&lines[0]).unexpected(width, first_line));
    }
    let dimension = u8::try_from(columns)
        .ok()
        .filter(|columns| DIMENSIONS.contains(columns))
        .ok_or(ParseError::Dimension { cells: columns })?;
    let is_cut_off = lines.len().is_multiple_of(2);
    // Below the picture, a line of another length is a comment; one of the same length is
    // another row.
    if let Some([last, line]) = lines.get(columns * 2..=columns * 2 + 1)
        && (length(line) != length(last) || is_cut_off)
    {
        let expected = format!("the end of the text after {columns} rows of cells");
        return Err(line.unexpected(0, expected, quoted(line.text())));
    }
    if is_cut_off {
        return Err(ParseError::Ended {
            line: lines.len() + 1,
            expected: wall_row.to_owned(),
        });
    }
    let rows = lines.len() / 2;
    if rows != columns {
        return Err(ParseError::NotSquare { columns, rows });
    }
    Ok(dimension)
}

/// A line with access by character.
struct Row<'a> {
    line: Line<'a>,
    characters: Vec<char>,
}

impl<'a> Row<'a> {
    fn new(line: &Line<'a>) -> Self {
        Self {
            line: *line,
            characters: line.text().chars().collect(),
        }
    }

    /// The character at `index`, counted from 0; `None` past the end.
    fn at(&self, index: usize) -> Option<char> {
        self.characters.get(index).copied()
    }

    /// The error that `expected` is not at `index`.
    fn unexpected(&self, index: usize, expected: impl Into<String>) -> ParseError {
        let found = quoted_character(self.at(index));
        self.line.unexpected(index, expected, found)
    }

    fn expect(&self, index: usize, character: char, expected: &str) -> Result<(), ParseError> {
        match self.at(index) {
            Some(found) if found == character => Ok(()),
            _ => Err(self.unexpected(index, expected)),
        }
    }
}

/// A maze while its picture is parsed.
struct Picture {
    style: Style,
    walls: Walls,
    start: Option<Cell>,
    goal: Vec<Cell>,
}

impl Picture {
    /// The index of the last character of a row.
    fn right(&self) -> usize {
        usize::from(self.walls.dimension()) * self.style.cell_width()
    }

    /// The y of the cells below the `above`-th row of walls from the top.
    fn y(&self, above: usize) -> u8 {
        let above = u8::try_from(above).expect("a picture has at most 64 rows of cells");
        self.walls.dimension() - 1 - above
    }

    /// Parses a row of posts and horizontal walls, the `above`-th from the top.
    fn posts(&mut self, row: &Row<'_>, above: usize) -> Result<(), ParseError> {
        let dimension = self.walls.dimension();
        let [_, drawn, ..] = self.style.drawn();
        let perimeter = above == 0 || above == usize::from(dimension);
        for x in 0..dimension {
            let left = usize::from(x) * self.style.cell_width();
            self.post(row, left, perimeter || x == 0)?;
            let wall = self.wall(row, left + 1, drawn, perimeter)?;
            for index in left + 2..left + self.style.cell_width() {
                if self.wall(row, index, drawn, perimeter)? != wall {
                    let expected = if wall { "`-`" } else { "a space" };
                    let expected = format!("{expected} like the character before");
                    return Err(row.unexpected(index, expected));
                }
            }
            if !perimeter {
                self.walls
                    .set(Cell::new(x, self.y(above)), Heading::Up, !wall);
            }
        }
        self.post(row, self.right(), true)
    }

    /// Parses a row of cells and vertical walls, the `above`-th from the top.
    fn cells(&mut self, row: &Row<'_>, above: usize) -> Result<(), ParseError> {
        let [_, _, drawn, _] = self.style.drawn();
        for x in 0..self.walls.dimension() {
            let left = usize::from(x) * self.style.cell_width();
            let cell = Cell::new(x, self.y(above));
            let wall = self.wall(row, left, drawn, x == 0)?;
            if x > 0 {
                self.walls.set(cell, Heading::Left, !wall);
            }
            if self.style == Style::Blocks {
                row.expect(left + 1, '0', "`0` (a cell is open)")?;
            } else {
                row.expect(left + 1, ' ', "a space")?;
                row.expect(left + 3, ' ', "a space")?;
                self.mark(row, left + 2, cell)?;
            }
        }
        self.wall(row, self.right(), drawn, true)?;
        Ok(())
    }

    fn post(&self, row: &Row<'_>, index: usize, perimeter: bool) -> Result<(), ParseError> {
        match (row.at(index), self.style) {
            (Some(found), style) if style.is_post(found) => Ok(()),
            (_, Style::Competition) => Err(row.unexpected(index, "a post `o`")),
            (_, Style::Map) => Err(row.unexpected(index, "a post")),
            (_, Style::Blocks) if perimeter => Err(row.unexpected(index, closed('1'))),
            (_, Style::Blocks) => Err(row.unexpected(index, "`1` (a post)")),
        }
    }

    /// Whether there is a wall, which is usually drawn as `drawn`.
    fn wall(
        &self,
        row: &Row<'_>,
        index: usize,
        drawn: char,
        perimeter: bool,
    ) -> Result<bool, ParseError> {
        let [.., open] = self.style.drawn();
        match row.at(index) {
            Some(found) if self.style.is_wall(found, drawn) => Ok(true),
            Some(found) if found == open && !perimeter => Ok(false),
            _ if perimeter => Err(row.unexpected(index, closed(drawn))),
            _ => {
                let open = quoted_character(Some(open));
                Err(row.unexpected(index, format!("`{drawn}` or {open}")))
            }
        }
    }

    /// Parses the character in the middle of a cell.
    fn mark(&mut self, row: &Row<'_>, index: usize, cell: Cell) -> Result<(), ParseError> {
        match (row.at(index), self.start) {
            (Some(' '), _) => {}
            (Some('G'), _) => self.goal.push(cell),
            (Some('S'), None) => self.start = Some(cell),
            (Some('S'), Some(first)) => {
                return Err(ParseError::SecondStart {
                    line: row.line.number(),
                    column: index + 1,
                    first,
                });
            }
            _ => return Err(row.unexpected(index, "a space, `S` or `G`")),
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

fn closed(drawn: char) -> String {
    format!("`{drawn}` (the perimeter is closed)")
}

pub(super) fn print(maze: &Maze, style: Style) -> String {
    let [_, _, wall, open] = style.drawn();
    let mut text = String::new();
    for y in (0..maze.dimension()).rev() {
        print_posts(maze, y, Heading::Up, style, &mut text);
        for x in 0..maze.dimension() {
            let cell = Cell::new(x, y);
            let is_open = maze.walls().is_open(cell, Heading::Left);
            text.push(if is_open { open } else { wall });
            match style {
                Style::Competition if maze.start() == cell => text.push_str(" S "),
                Style::Competition if maze.goal().contains(cell) => text.push_str(" G "),
                _ => text.extend((1..style.cell_width()).map(|_| open)),
            }
        }
        text.extend([wall, '\n']);
    }
    print_posts(maze, 0, Heading::Down, style, &mut text);
    text
}

fn print_posts(maze: &Maze, y: u8, side: Heading, style: Style, text: &mut String) {
    let [post, wall, _, open] = style.drawn();
    for x in 0..maze.dimension() {
        let is_open = maze.walls().is_open(Cell::new(x, y), side);
        let drawn = if is_open { open } else { wall };
        text.push(post);
        text.extend((1..style.cell_width()).map(|_| drawn));
    }
    text.extend([post, '\n']);
}
