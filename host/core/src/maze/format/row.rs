//! Lines as rows of characters, for the formats that draw the maze.
//!
//! Pictures and block maps share this layout: all cells have the same width, rows of walls
//! and rows of cells alternate, and the drawing starts and ends with a wall. Each format
//! defines what the characters mean.

use super::super::DIMENSIONS;
use super::ParseError;
use super::text::{Line, quoted, quoted_character};

/// The layout of a format, and the words for it in messages.
pub(super) struct Drawing {
    /// Characters from one vertical wall to the next.
    pub(super) cell_width: usize,
    /// What the first line has to be.
    pub(super) first_line: &'static str,
    /// The name of a row of walls.
    pub(super) wall_row: &'static str,
}

impl Drawing {
    /// The size of the maze, from the length of the first line and the number of lines.
    pub(super) fn dimension(&self, lines: &[Line<'_>]) -> Result<u8, ParseError> {
        let first = Row::new(&lines[0]);
        let columns = first.characters.len() / self.cell_width;
        if first.characters.len() % self.cell_width != 1 {
            return Err(first.unexpected(first.characters.len(), self.first_line));
        }
        let dimension = u8::try_from(columns)
            .ok()
            .filter(|columns| DIMENSIONS.contains(columns))
            .ok_or(ParseError::Dimension { cells: columns })?;
        let rows = lines.len() / 2;
        // Below the picture, a line of another length is a comment; one of the same length
        // is another row.
        if let Some([last, line]) = lines.get(columns * 2..=columns * 2 + 1)
            && (Row::new(line).characters.len() != Row::new(last).characters.len()
                || lines.len().is_multiple_of(2))
        {
            let expected = format!("the end of the text after {columns} rows of cells");
            return Err(line.unexpected(0, expected, quoted(line.text())));
        }
        if lines.len().is_multiple_of(2) {
            return Err(ParseError::Ended {
                line: lines.len() + 1,
                expected: self.wall_row.to_owned(),
            });
        }
        if rows != columns {
            return Err(ParseError::NotSquare { columns, rows });
        }
        Ok(dimension)
    }

    /// Checks that the line ends after that many cells and a wall.
    pub(super) fn end(&self, row: &Row<'_>, columns: usize) -> Result<(), ParseError> {
        let length = columns * self.cell_width + 1;
        if row.characters.len() <= length {
            return Ok(());
        }
        let rest: String = row.characters[length..].iter().collect();
        let expected = format!("the end of the line after {columns} cells");
        Err(row.line.unexpected(length, expected, quoted(&rest)))
    }
}

/// A line with access by character.
pub(super) struct Row<'a> {
    line: Line<'a>,
    characters: Vec<char>,
}

impl<'a> Row<'a> {
    pub(super) fn new(line: &Line<'a>) -> Self {
        Self {
            line: *line,
            characters: line.text().chars().collect(),
        }
    }

    /// The number of the line, counted from 1.
    pub(super) const fn number(&self) -> usize {
        self.line.number()
    }

    /// The character at `index`, counted from 0; `None` past the end.
    pub(super) fn at(&self, index: usize) -> Option<char> {
        self.characters.get(index).copied()
    }

    /// The error that `expected` is not at `index`.
    pub(super) fn unexpected(&self, index: usize, expected: impl Into<String>) -> ParseError {
        let found = quoted_character(self.at(index));
        self.line.unexpected(index, expected, found)
    }
}

/// The y of the cells below the `above`-th row of walls from the top.
pub(super) fn cell_row(dimension: u8, above: usize) -> u8 {
    let above = u8::try_from(above).expect("a drawing has at most 64 rows of cells");
    dimension - 1 - above
}
