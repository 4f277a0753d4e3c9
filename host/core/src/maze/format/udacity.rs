//! Udacity text: the format of the contest's own tester.
//!
//! Line 1 is the size n. Then n lines follow, one per *column* from the left, each with n
//! comma-separated values from the bottom up. A value is the sum of the open sides: 1 up,
//! 2 right, 4 down, 8 left; 0 is an enclosed cell. Blanks around a value are accepted, as in
//! the tester.
//!
//! The start is always (0, 0) and the goal the centre.

use std::fmt::Write as _;

use super::super::{Cell, DIMENSIONS, Maze};
use super::text::{Line, quoted, words};
use super::{ParseError, edges};

const VALUE_MAX: u8 = 15;

pub(super) fn parse(lines: &[Line<'_>]) -> Result<Maze, ParseError> {
    let dimension = dimension(&lines[0])?;
    let count = usize::from(dimension);
    let mut values = Vec::with_capacity(count * count);
    for column in 0..count {
        let line = lines.get(1 + column).ok_or_else(|| ParseError::Ended {
            line: 2 + column,
            expected: format!("the {count} values of column {column}"),
        })?;
        column_values(line, count, &mut values)?;
    }
    if let Some(line) = lines.get(1 + count) {
        let expected = format!("the end of the text after {count} columns");
        return Err(line.unexpected(0, expected, quoted(line.text())));
    }
    Ok(Maze::contest(edges::walls(dimension, &values)?)?)
}

fn dimension(line: &Line<'_>) -> Result<u8, ParseError> {
    let (low, high) = (*DIMENSIONS.start(), *DIMENSIONS.end());
    // Without separators the whole line is one word.
    let word = words(line, []).next().expect("a split has a first part");
    word.number(high)
        .filter(|dimension| DIMENSIONS.contains(dimension))
        .ok_or_else(|| {
            let expected = format!("a maze size from {low} to {high}");
            line.unexpected(word.before, expected, word.quoted())
        })
}

fn column_values(line: &Line<'_>, count: usize, values: &mut Vec<u8>) -> Result<(), ParseError> {
    let mut found = 0;
    for word in words(line, [',']) {
        if found == count {
            let expected = format!("the end of the line after {count} values");
            return Err(line.unexpected(word.before, expected, word.quoted()));
        }
        values.push(word.number(VALUE_MAX).ok_or_else(|| {
            let expected = format!("a number from 0 to {VALUE_MAX}");
            line.unexpected(word.before, expected, word.quoted())
        })?);
        found += 1;
    }
    if found < count {
        let end = line.text().chars().count();
        let found = format!("the end of the line after {found}");
        return Err(line.unexpected(end, format!("{count} values"), found));
    }
    Ok(())
}

/// The text ends without a newline, as the official files do.
pub(super) fn print(maze: &Maze) -> String {
    let dimension = maze.dimension();
    let mut text = dimension.to_string();
    for x in 0..dimension {
        for y in 0..dimension {
            let separator = if y == 0 { '\n' } else { ',' };
            let value = maze.walls().value(Cell::new(x, y));
            write!(text, "{separator}{value}").expect("writing to a string never fails");
        }
    }
    text
}
