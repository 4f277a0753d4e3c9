//! Maze files: five text formats, recognised by content, read and printed.
//!
//! One file per format; `competition` and `map` share `picture`, because
//! they draw the same picture, and `blocks` shares `row` with it. Reading is strict: an error names line, column,
//! what was expected and what stands there. Common to all formats:
//!
//! - Lines may end in LF or CRLF; the last line ending may be missing; blank
//!   lines at the end are ignored. A byte order mark at the start is skipped.
//! - Mazes are square, with 2 to 64 cells along each side.
//! - The perimeter is closed, and two neighbouring cells agree about their wall.
//! - Text longer than [`TEXT_BYTES_MAX`] is refused unread.
//!
//! Nothing here asks whether a maze is fit for a contest: see
//! [`violations`](super::violations).

mod blocks;
mod competition;
mod edges;
mod error;
mod map;
mod num;
mod picture;
mod row;
mod text;
mod udacity;

use std::fmt;
use std::str::FromStr;

pub use error::{Edge, ParseError, PrintError};

use super::{Area, Cell, DIMENSIONS, Maze};
use text::Line;

/// The longest text that is read, in bytes: 256 KiB.
///
/// The longest sensible file is a 64 x 64 maze in [`Format::Num`], under 60 KB.
/// Text beyond the limit is refused before it is looked at, so a huge file
/// costs neither time nor memory.
pub const TEXT_BYTES_MAX: usize = 256 * 1024;

/// A text format for mazes.
///
/// ```
/// use wasmouse_core::maze::format::Format;
/// assert_eq!("udacity".parse(), Ok(Format::Udacity));
/// assert_eq!(Format::Num.to_string(), "num");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The dimension, then one line of comma-separated values per column.
    Udacity,
    /// A picture with posts `o`, start `S` and goal cells `G`.
    Competition,
    /// The same picture with any posts, as micromouse simulators draw it.
    Map,
    /// One line of six numbers per cell.
    Num,
    /// A picture of blocks, `1` for a wall and `0` for an open one.
    Blocks,
}

impl Format {
    /// All formats, in the order in which help texts name them.
    pub const ALL: [Self; 5] = [
        Self::Udacity,
        Self::Competition,
        Self::Map,
        Self::Num,
        Self::Blocks,
    ];

    /// `udacity`, `competition`, `map`, `num` or `blocks`, as on the command line and in JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Udacity => "udacity",
            Self::Competition => "competition",
            Self::Map => "map",
            Self::Num => "num",
            Self::Blocks => "blocks",
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name that is none of the formats'.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "unknown maze format `{}`, expected udacity, competition, map, num or blocks",
    .0.escape_debug()
)]
pub struct UnknownFormat(pub String);

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        Self::ALL
            .into_iter()
            .find(|format| format.name() == name)
            .ok_or_else(|| UnknownFormat(name.to_owned()))
    }
}

/// What a maze file holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parsed {
    /// The format it was read as.
    pub format: Format,
    /// The maze.
    pub maze: Maze,
}

/// Reads a maze in whatever format its first line shows.
///
/// A line with one number is [`Format::Udacity`], six numbers are
/// [`Format::Num`]; a row of posts and walls is [`Format::Competition`] when the
/// posts are `o` and [`Format::Map`] otherwise. Five or more characters `1` and `0`
/// are the top of [`Format::Blocks`]: no dimension has as many digits.
///
/// # Errors
///
/// When the first line shows none of them, and all errors of [`parse_as`].
///
/// ```
/// use wasmouse_core::maze::format::{Format, parse};
/// let parsed = parse("3\n3,5,6\n10,1,14\n9,5,12\n").expect("the text is a maze");
/// assert_eq!(parsed.format, Format::Udacity);
///
/// let error = parse("3\n3,5,6\n10,x,14\n9,5,12\n").expect_err("x is not a value");
/// assert_eq!(
///     error.to_string(),
///     "line 3, column 4: expected a number from 0 to 15, found `x`",
/// );
/// ```
pub fn parse(text: &str) -> Result<Parsed, ParseError> {
    let lines = text::lines(text)?;
    let format = recognize(&lines[0])?;
    let maze = parse_lines(&lines, format)?;
    Ok(Parsed { format, maze })
}

/// Reads a maze in a given format.
///
/// # Errors
///
/// When the text is too long, empty, not in the format, or not a closed and
/// consistent square maze with its start outside the goal.
pub fn parse_as(text: &str, format: Format) -> Result<Parsed, ParseError> {
    let maze = parse_lines(&text::lines(text)?, format)?;
    Ok(Parsed { format, maze })
}

fn parse_lines(lines: &[Line<'_>], format: Format) -> Result<Maze, ParseError> {
    match format {
        Format::Udacity => udacity::parse(lines),
        Format::Competition => competition::parse(lines),
        Format::Map => map::parse(lines),
        Format::Num => num::parse(lines),
        Format::Blocks => blocks::parse(lines),
    }
}

/// Blocks along the side of the smallest maze.
const BLOCKS_MIN: usize = 2 * *DIMENSIONS.start() as usize + 1;

fn recognize(first: &Line<'_>) -> Result<Format, ParseError> {
    let is_number = |word: &str| word.bytes().all(|byte| byte.is_ascii_digit());
    let is_blocks = |word: &str| word.bytes().all(|byte| matches!(byte, b'0' | b'1'));
    let words: Vec<&str> = first.text().split_whitespace().take(7).collect();
    if !words.is_empty() && words.iter().all(|word| is_number(word)) {
        return Ok(match words[..] {
            [word] if word.len() >= BLOCKS_MIN && is_blocks(word) => Format::Blocks,
            [_] => Format::Udacity,
            _ => Format::Num,
        });
    }
    match first.text().chars().take(5).collect::<Vec<char>>()[..] {
        // A post, three times the same, a post.
        [post, a, b, c, next] if post == next && a == b && b == c && !words.is_empty() => {
            Ok(match post {
                'o' => Format::Competition,
                _ => Format::Map,
            })
        }
        _ => Err(ParseError::Unrecognized {
            found: text::quoted(first.text()),
        }),
    }
}

/// Prints a maze in a given format. Reading the text again gives an equal maze.
///
/// Only [`Format::Competition`] has marks for start and goal.
///
/// # Errors
///
/// When the start is not (0, 0) or the goal is not [`Area::center`], and the
/// format has no marks for them.
pub fn print(maze: &Maze, format: Format) -> Result<String, PrintError> {
    if format != Format::Competition {
        without_marks(maze, format)?;
    }
    Ok(match format {
        Format::Udacity => udacity::print(maze),
        Format::Competition => competition::print(maze),
        Format::Map => map::print(maze),
        Format::Num => num::print(maze),
        Format::Blocks => blocks::print(maze),
    })
}

/// Checks that start and goal are where a reader of a format without marks
/// will put them.
fn without_marks(maze: &Maze, format: Format) -> Result<(), PrintError> {
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

#[cfg(test)]
mod tests;
