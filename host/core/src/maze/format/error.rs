//! [`ParseError`]: why a text is not a maze. [`PrintError`]: why a format cannot store one.

use std::fmt;

use super::super::listed::Listed;
use super::super::{Area, Cell, DIMENSIONS, Heading, MazeError};
use super::kind::{Format, TEXT_BYTES_MAX};

/// Why a text is not a maze. Lines and columns count from 1, columns in characters.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseError {
    /// The text is longer than [`TEXT_BYTES_MAX`].
    #[error("the text has {bytes} bytes, the limit is {TEXT_BYTES_MAX}")]
    TooLong {
        /// Length of the text.
        bytes: usize,
    },
    /// The text has no characters, or only blank ones.
    #[error("the text is empty")]
    Empty,
    /// The first line belongs to no format.
    #[error(
        "line 1: expected the maze size on its own, a row of posts such as `o---o`, \
         the six numbers of a cell, or a row of blocks such as `11111`, found {found}"
    )]
    Unrecognized {
        /// The first character of the line, or a number, quoted.
        found: String,
    },
    /// The format expects something else there.
    #[error("line {line}, column {column}: expected {expected}, found {found}")]
    Unexpected {
        /// The line.
        line: usize,
        /// The column where `found` starts.
        column: usize,
        /// What the format expects.
        expected: String,
        /// The first character there, or a number, quoted.
        found: String,
    },
    /// The text ends too early.
    #[error("line {line}: expected {expected}, found the end of the text")]
    Ended {
        /// The first line that is missing.
        line: usize,
        /// What the format expects.
        expected: String,
    },
    /// The maze is smaller or larger than [`DIMENSIONS`].
    #[error(
        "maze size {cells} is outside the supported range of {} to {} cells",
        DIMENSIONS.start(), DIMENSIONS.end()
    )]
    Dimension {
        /// The width of the maze, in cells.
        cells: usize,
    },
    /// Width and height differ.
    #[error("the maze has {columns} columns and {rows} rows of cells, but must be square")]
    NotSquare {
        /// Cells from left to right.
        columns: usize,
        /// Cells from bottom to top.
        rows: usize,
    },
    /// Cells that disagree about the wall between them, and gaps in the perimeter.
    #[error("{} invalid {}: {}", .0.len(), edges(.0), Listed(.0))]
    Edges(
        /// All of them, in the order of the cells. Messages name at most eight.
        Vec<Edge>,
    ),
    /// A second `S`.
    #[error("line {line}, column {column}: second start `S`, the first is at {first}")]
    SecondStart {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The cell of the first `S` in the text.
        first: Cell,
    },
    /// The cells marked `G` are not a filled rectangle.
    #[error("the {} goal cells do not fill a rectangle: {}", .0.len(), Listed(.0))]
    GoalShape(
        /// All of them, from the top of the picture. Messages name at most eight.
        Vec<Cell>,
    ),
    /// A cell has more than one line.
    #[error("line {line}: second line for cell {cell}, the first is line {first}")]
    RepeatedCell {
        /// The line.
        line: usize,
        /// The cell.
        cell: Cell,
        /// The first line of the cell.
        first: usize,
    },
    /// Some cells have no line.
    #[error("missing cells: {}", Listed(.0))]
    MissingCells(
        /// All of them, in the order of the cells. Messages name at most eight.
        Vec<Cell>,
    ),
    /// The start or the goal is not possible there.
    #[error(transparent)]
    Maze(#[from] MazeError),
}

fn edges(edges: &[Edge]) -> &'static str {
    if edges.len() == 1 { "edge" } else { "edges" }
}

/// A side of a cell that is not a valid part of a maze.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// The two cells of the edge disagree: one is open there, the other closed.
    Disagreement {
        /// The cell to the left of or below the edge.
        cell: Cell,
        /// The side of `cell`: right or up.
        heading: Heading,
        /// The cell on the other side.
        neighbor: Cell,
        /// Whether `cell` is open there; `neighbor` is the opposite.
        open: bool,
    },
    /// The edge is part of the perimeter and open.
    Perimeter {
        /// The cell inside.
        cell: Cell,
        /// The side of `cell`.
        heading: Heading,
    },
}

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = |open: bool| if open { "open" } else { "closed" };
        match *self {
            Self::Disagreement {
                cell,
                heading,
                neighbor,
                open,
            } => {
                let (here, there) = (word(open), word(!open));
                let back = heading.opposite();
                write!(
                    f,
                    "{cell} is {here} {heading} but {neighbor} is {there} {back}"
                )
            }
            Self::Perimeter { cell, heading } => {
                write!(f, "the perimeter is open at {cell}, {heading}")
            }
        }
    }
}

/// Why a format cannot store a maze.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PrintError {
    /// The start is not (0, 0), and the format cannot mark it.
    #[error("the {format} format cannot store start {start}: its start is always (0, 0)")]
    Start {
        /// The format.
        format: Format,
        /// The start of the maze.
        start: Cell,
    },
    /// The goal is not in the centre, and the format cannot mark it.
    #[error(
        "the {format} format cannot store a goal of {} at {}: \
         its goal is always the centre ({} at {})",
        size(*.goal), .goal.origin(), size(*.center), .center.origin()
    )]
    Goal {
        /// The format.
        format: Format,
        /// The goal of the maze.
        goal: Area,
        /// The goal that the format implies.
        center: Area,
    },
}

fn size(area: Area) -> String {
    format!("{} x {} cells", area.width(), area.height())
}
