//! [`print`]: from a maze to text.

use super::super::{Area, Cell, Maze};
use super::style::Style;
use super::{Format, PrintError, num, picture, udacity};

/// Prints a maze in a given format. Parsing the text gives an equal maze.
///
/// # Errors
///
/// If the start is not (0, 0) or the goal is not [`Area::center`], and the format cannot mark
/// them. Only [`Format::Competition`] can.
pub fn print(maze: &Maze, format: Format) -> Result<String, PrintError> {
    if format != Format::Competition {
        check_unmarked(maze, format)?;
    }
    Ok(match format {
        Format::Udacity => udacity::print(maze),
        Format::Competition => picture::print(maze, Style::Competition),
        Format::Map => picture::print(maze, Style::Map),
        Format::Num => num::print(maze),
        Format::Blocks => picture::print(maze, Style::Blocks),
    })
}

/// Checks that start and goal are where a format without marks implies them to be.
fn check_unmarked(maze: &Maze, format: Format) -> Result<(), PrintError> {
    let start = maze.start();
    if start != Cell::new(0, 0) {
        return Err(PrintError::Start { format, start });
    }
    let goal = maze.goal();
    let center = Area::center(maze.dimension());
    if goal != center {
        return Err(PrintError::Goal {
            format,
            goal,
            center,
        });
    }
    Ok(())
}
