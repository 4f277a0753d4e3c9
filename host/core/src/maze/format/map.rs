//! The text map of micromouse simulators such as mms.
//!
//! [`picture`](super::picture) in which everything but a space counts as a wall
//! or a post, and a post may even be a space, because simulators look at the
//! walls only. `S` and `G` are understood where a file has them, but they are
//! not part of the format, so they are not printed: a maze with another start
//! or goal needs [`competition`](super::competition). Printed with posts `+`.

use super::super::Maze;
use super::ParseError;
use super::picture::{self, Style};
use super::text::Line;

pub(super) fn parse(lines: &[Line<'_>]) -> Result<Maze, ParseError> {
    picture::parse(lines, Style::Map)
}

pub(super) fn print(maze: &Maze) -> String {
    picture::print(maze, Style::Map)
}
