//! The `num` format of the micromouse simulator mms: one line per cell.
//!
//! A line is `x y north east south west`, separated by one or more blanks; x and y count
//! from the bottom left, 1 is a wall and 0 is none. (The legend in the README of mms swaps
//! south and east; its example and its program have them in this order.) Every cell has
//! exactly one line. The order of the lines is free, because mms looks at the coordinates
//! only; they are printed column by column, as mms does.
//!
//! The start is always (0, 0) and the goal the centre.

use std::fmt::Write as _;

use super::super::{Cell, DIMENSIONS, Heading, Maze};
use super::text::{Line, quoted, words};
use super::{ParseError, edges};

/// The separators between the numbers of a line.
const BLANKS: [char; 2] = [' ', '\t'];

const COORDINATE_MAX: u8 = *DIMENSIONS.end() - 1;

/// Names of the numbers of a line.
const FIELDS: [&str; 6] = [
    "the x of a cell",
    "the y of a cell",
    "the north wall",
    "the east wall",
    "the south wall",
    "the west wall",
];

/// A parsed line.
struct CellLine {
    cell: Cell,
    /// The number of the line, counted from 1.
    number: usize,
    /// The Udacity value: bit set = side open.
    value: u8,
}

pub(super) fn parse(lines: &[Line<'_>]) -> Result<Maze, ParseError> {
    let cells: Vec<CellLine> = lines.iter().map(cell_line).collect::<Result<_, _>>()?;
    let dimension = dimension(&cells)?;
    let count = usize::from(dimension);
    let mut places: Vec<Option<&CellLine>> = vec![None; count * count];
    for line in &cells {
        let place = &mut places[usize::from(line.cell.x) * count + usize::from(line.cell.y)];
        if let Some(first) = place {
            return Err(ParseError::RepeatedCell {
                line: line.number,
                cell: line.cell,
                first: first.number,
            });
        }
        *place = Some(line);
    }
    let values = complete(dimension, &places)?;
    Ok(Maze::contest(edges::walls(dimension, &values)?)?)
}

fn cell_line(line: &Line<'_>) -> Result<CellLine, ParseError> {
    let mut numbers = [0; FIELDS.len()];
    // Several blanks are one separator, so empty words do not count.
    let mut words = words(line, BLANKS).filter(|word| !word.text.is_empty());
    for (place, number) in numbers.iter_mut().enumerate() {
        let max = if place < 2 { COORDINATE_MAX } else { 1 };
        let expected = || format!("{} (0 to {max})", FIELDS[place]);
        let Some(word) = words.next() else {
            let end = line.text().chars().count();
            return Err(line.unexpected(end, expected(), "the end of the line".to_owned()));
        };
        *number = word
            .number(max)
            .ok_or_else(|| line.unexpected(word.before, expected(), word.quoted()))?;
    }
    if let Some(word) = words.next() {
        let expected = "the end of the line after six numbers";
        return Err(line.unexpected(word.before, expected, quoted(word.text)));
    }
    let [x, y, walls @ ..] = numbers;
    let sides = Heading::ALL.into_iter().zip(walls);
    Ok(CellLine {
        cell: Cell::new(x, y),
        number: line.number(),
        value: sides
            .filter(|&(_, wall)| wall == 0)
            .map(|(heading, _)| heading.bit())
            .sum(),
    })
}

/// The size of the square that the coordinates span.
fn dimension(cells: &[CellLine]) -> Result<u8, ParseError> {
    let columns = 1 + cells.iter().map(|line| line.cell.x).max().unwrap_or(0);
    let rows = 1 + cells.iter().map(|line| line.cell.y).max().unwrap_or(0);
    if columns != rows {
        return Err(ParseError::NotSquare {
            columns: usize::from(columns),
            rows: usize::from(rows),
        });
    }
    if !DIMENSIONS.contains(&columns) {
        return Err(ParseError::Dimension {
            cells: usize::from(columns),
        });
    }
    Ok(columns)
}

/// The values of all cells, or an error that lists the cells without one.
fn complete(dimension: u8, places: &[Option<&CellLine>]) -> Result<Vec<u8>, ParseError> {
    let cells = (0..dimension).flat_map(|x| (0..dimension).map(move |y| Cell::new(x, y)));
    let missing: Vec<Cell> = cells
        .zip(places)
        .filter(|(_, place)| place.is_none())
        .map(|(cell, _)| cell)
        .collect();
    if !missing.is_empty() {
        return Err(ParseError::MissingCells(missing));
    }
    Ok(places.iter().flatten().map(|line| line.value).collect())
}

pub(super) fn print(maze: &Maze) -> String {
    let mut text = String::new();
    for cell in maze.walls().cells() {
        write!(text, "{} {}", cell.x, cell.y).expect("writing to a string never fails");
        for heading in Heading::ALL {
            let wall = u8::from(!maze.walls().is_open(cell, heading));
            write!(text, " {wall}").expect("writing to a string never fails");
        }
        text.push('\n');
    }
    text
}
