//! Block maps: the format of the sketch-city report, one character per block.
//!
//! ```text
//! 1111111      `1` is a wall and `0` is open; the first line is the top
//! 1000001      cells are the blocks in odd rows and columns, always `0`
//! 1011101      posts are the blocks in even rows and columns, always `1`
//! 1000101      the others are the walls between cells, or the gaps
//! 1110101
//! 1010001
//! 1111111
//! ```
//!
//! A maze of n x n cells has 2n + 1 lines of 2n + 1 characters. A post is `1` even if no
//! wall touches it, and a cell is `0` even if it has no exit. Other files are rejected:
//! their robots could stand where a robot of this contest cannot, or pass where no edge of
//! a cell is. The example in the report is 2 cells wide and 3 high; here, mazes are square.
//!
//! The start is always (0, 0) and the goal the centre.

use super::super::{Cell, Heading, Maze, Walls};
use super::ParseError;
use super::row::{Drawing, Row, cell_row};
use super::text::Line;

const DRAWING: Drawing = Drawing {
    cell_width: 2,
    first_line: "a whole number of cells, two characters each, and a wall",
    wall_row: "a row of walls",
};

pub(super) fn parse(lines: &[Line<'_>]) -> Result<Maze, ParseError> {
    let dimension = DRAWING.dimension(lines)?;
    let mut walls = Walls::closed(dimension);
    for (index, line) in lines.iter().enumerate() {
        let row = Row::new(line);
        if index % 2 == 0 {
            wall_blocks(&row, index / 2, &mut walls)?;
        } else {
            cell_blocks(&row, index / 2, &mut walls)?;
        }
        DRAWING.end(&row, usize::from(dimension))?;
    }
    Ok(Maze::contest(walls)?)
}

/// Parses a row of posts and horizontal walls, the `above`-th from the top.
fn wall_blocks(row: &Row<'_>, above: usize, walls: &mut Walls) -> Result<(), ParseError> {
    let dimension = walls.dimension();
    let is_perimeter = above == 0 || above == usize::from(dimension);
    for x in 0..dimension {
        let left = usize::from(x) * DRAWING.cell_width;
        let is_post = !is_perimeter && x > 0;
        expect(row, left, '1', if is_post { POST } else { PERIMETER })?;
        if is_perimeter {
            expect(row, left + 1, '1', PERIMETER)?;
        } else {
            let wall = wall(row, left + 1)?;
            walls.set(Cell::new(x, cell_row(dimension, above)), Heading::Up, !wall);
        }
    }
    let right = usize::from(dimension) * DRAWING.cell_width;
    expect(row, right, '1', PERIMETER)
}

/// Parses a row of cells and vertical walls, the `above`-th from the top.
fn cell_blocks(row: &Row<'_>, above: usize, walls: &mut Walls) -> Result<(), ParseError> {
    let dimension = walls.dimension();
    let y = cell_row(dimension, above);
    for x in 0..dimension {
        let left = usize::from(x) * DRAWING.cell_width;
        if x == 0 {
            expect(row, left, '1', PERIMETER)?;
        } else {
            let wall = wall(row, left)?;
            walls.set(Cell::new(x, y), Heading::Left, !wall);
        }
        expect(row, left + 1, '0', "`0` (a cell is open)")?;
    }
    let right = usize::from(dimension) * DRAWING.cell_width;
    expect(row, right, '1', PERIMETER)
}

const PERIMETER: &str = "`1` (the perimeter is closed)";
const POST: &str = "`1` (a post)";

fn expect(row: &Row<'_>, index: usize, block: char, expected: &str) -> Result<(), ParseError> {
    match row.at(index) {
        Some(found) if found == block => Ok(()),
        _ => Err(row.unexpected(index, expected)),
    }
}

/// Whether the block between two cells is a wall.
fn wall(row: &Row<'_>, index: usize) -> Result<bool, ParseError> {
    match row.at(index) {
        Some('1') => Ok(true),
        Some('0') => Ok(false),
        _ => Err(row.unexpected(index, "`1` or `0`")),
    }
}

pub(super) fn print(maze: &Maze) -> String {
    let dimension = maze.dimension();
    let mut text = String::new();
    for y in (0..dimension).rev() {
        print_walls(maze, y, Heading::Up, &mut text);
        for x in 0..dimension {
            text.push(block(maze, Cell::new(x, y), Heading::Left));
            text.push('0');
        }
        text.push_str("1\n");
    }
    print_walls(maze, 0, Heading::Down, &mut text);
    text
}

fn print_walls(maze: &Maze, y: u8, side: Heading, text: &mut String) {
    for x in 0..maze.dimension() {
        text.push('1');
        text.push(block(maze, Cell::new(x, y), side));
    }
    text.push_str("1\n");
}

fn block(maze: &Maze, cell: Cell, side: Heading) -> char {
    if maze.walls().is_open(cell, side) {
        '0'
    } else {
        '1'
    }
}
