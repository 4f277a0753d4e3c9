//! [`parse`]: from text to a maze, in a format that is given or recognised.

use super::super::{DIMENSIONS, Maze};
use super::style::Style;
use super::text::{Line, lines, quoted};
use super::{Format, ParseError, num, picture, udacity};

/// The contents of a maze file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parsed {
    /// The format of the text.
    pub format: Format,
    /// The maze.
    pub maze: Maze,
}

/// Parses a maze and recognises its format by the first line.
///
/// A line with one number is [`Format::Udacity`], with six numbers [`Format::Num`]; a row of
/// posts and walls is [`Format::Competition`] if the posts are `o`, else [`Format::Map`].
/// Five or more characters `1` and `0` are the top of [`Format::Blocks`]: no size has as
/// many digits.
///
/// # Errors
///
/// If the first line belongs to no format, and all errors of [`parse_as`].
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
    let lines = lines(text)?;
    let format = recognize(&lines[0])?;
    let maze = parse_lines(&lines, format)?;
    Ok(Parsed { format, maze })
}

/// Parses a maze in a given format.
///
/// # Errors
///
/// If the text is too long, empty or not in the format, or if it is not a consistent square
/// maze with a closed perimeter and its start outside the goal.
pub fn parse_as(text: &str, format: Format) -> Result<Parsed, ParseError> {
    let maze = parse_lines(&lines(text)?, format)?;
    Ok(Parsed { format, maze })
}

fn parse_lines(lines: &[Line<'_>], format: Format) -> Result<Maze, ParseError> {
    match format {
        Format::Udacity => udacity::parse(lines),
        Format::Competition => picture::parse(lines, Style::Competition),
        Format::Map => picture::parse(lines, Style::Map),
        Format::Num => num::parse(lines),
        Format::Blocks => picture::parse(lines, Style::Blocks),
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
        // A post, one character three times, the same post.
        [post, a, b, c, next] if post == next && a == b && b == c && !words.is_empty() => {
            Ok(match post {
                'o' => Format::Competition,
                _ => Format::Map,
            })
        }
        _ => Err(ParseError::Unrecognized {
            found: quoted(first.text()),
        }),
    }
}
