//! Competition text: the picture format of public micromouse maze collections.
//!
//! [`picture`](super::picture) with posts `o`, horizontal walls `---`, vertical
//! walls `|`, `S` on the start and `G` on the goal cells. A file without `S`
//! starts at (0, 0); without `G` its goal is the centre (training mazes have
//! neither). Both marks are always printed.

use super::super::Maze;
use super::ParseError;
use super::picture::{self, Style};
use super::text::Line;

pub(super) fn parse(lines: &[Line<'_>]) -> Result<Maze, ParseError> {
    picture::parse(lines, Style::Competition)
}

pub(super) fn print(maze: &Maze) -> String {
    picture::print(maze, Style::Competition)
}
