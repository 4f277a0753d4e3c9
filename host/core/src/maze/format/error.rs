//! Why a text is not a maze, and why a format cannot hold a maze.

use std::fmt;

use super::super::listed::Listed;
use super::super::{Area, Cell, DIMENSIONS, Heading, MazeError};
use super::{Format, TEXT_BYTES_MAX};

/// Why a text is not a maze. Lines and columns count from 1, columns in characters.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseError {
    /// The text is longer than [`TEXT_BYTES_MAX`].
    #[error("{bytes} bytes are more than any maze file has (at most {TEXT_BYTES_MAX})")]
    TooLong {
        /// Length of the text.
        bytes: usize,
    },
    /// The text has no characters, or only blank ones.
    #[error("the text is empty")]
    Empty,
    /// The first line begins none of the formats.
    #[error(
        "line 1: expected the dimension alone, a row of posts such as `o---o`, \
         the six numbers of a cell, or a row of blocks such as `11111`, found {found}"
    )]
    Unrecognized {
        /// The beginning of the line, quoted.
        found: String,
    },
    /// Something else stands where the format wants something.
    #[error("line {line}, column {column}: expected {expected}, found {found}")]
    Unexpected {
        /// The line.
        line: usize,
        /// The column where `found` begins.
        column: usize,
        /// What belongs there, in words.
        expected: String,
        /// What stands there, quoted.
        found: String,
    },
    /// The text ends too early.
    #[error("line {line}: expected {expected}, found the end of the text")]
    Ended {
        /// The first line that is missing.
        line: usize,
        /// What belongs there, in words.
        expected: String,
    },
    /// The maze is smaller or larger than [`DIMENSIONS`].
    #[error(
        "a width of {cells} is outside the {} to {} cells that mazes have",
        DIMENSIONS.start(), DIMENSIONS.end()
    )]
    Dimension {
        /// Width of the maze in cells.
        cells: usize,
    },
    /// Width and height differ.
    #[error("the maze has {columns} columns and {rows} rows of cells; mazes are square")]
    NotSquare {
        /// Cells from left to right.
        columns: usize,
        /// Cells from bottom to top.
        rows: usize,
    },
    /// Cells that disagree about the wall between them, and gaps in the perimeter.
    #[error("{} wrong {}: {}", .0.len(), sides(.0), Listed(.0))]
    Edges(
        /// All of them, in the order of the cells. Messages name eight.
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
        /// All of them, from the top of the picture. Messages name eight.
        Vec<Cell>,
    ),
    /// A cell has two lines.
    #[error("line {line}: second line for cell {cell}, the first is line {first}")]
    RepeatedCell {
        /// The line.
        line: usize,
        /// The cell.
        cell: Cell,
        /// The line that had the cell already.
        first: usize,
    },
    /// Cells have no line.
    #[error("no line for {}", Listed(.0))]
    MissingCells(
        /// All of them, in the order of the cells. Messages name eight.
        Vec<Cell>,
    ),
    /// The start or the goal does not fit.
    #[error(transparent)]
    Maze(#[from] MazeError),
}

fn sides(edges: &[Edge]) -> &'static str {
    if edges.len() == 1 { "edge" } else { "edges" }
}

/// One side of a cell about which a file contradicts itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// The cell says one thing about the edge and its neighbour another.
    Disagreement {
        /// The cell to the left of or below the edge.
        cell: Cell,
        /// The side of `cell`: right or up.
        heading: Heading,
        /// The cell on the other side.
        neighbor: Cell,
        /// Whether `cell` says that the edge is open; `neighbor` says the contrary.
        open: bool,
    },
    /// The edge is a piece of the perimeter and open.
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
                write!(f, "{cell} is open {heading} through the perimeter")
            }
        }
    }
}

/// Why a format cannot hold a maze.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PrintError {
    /// The start is not at (0, 0) and the format has no mark for it.
    #[error("the {format} format cannot hold start {start}: it has no mark, the start is (0, 0)")]
    Start {
        /// The format.
        format: Format,
        /// The start of the maze.
        start: Cell,
    },
    /// The goal is not in the centre and the format has no mark for it.
    #[error(
        "the {format} format cannot hold a goal of {} at {}: \
         it has no mark, the goal is the centre ({} at {})",
        size(*.goal), .goal.origin(), size(*.center), .center.origin()
    )]
    Goal {
        /// The format.
        format: Format,
        /// The goal of the maze.
        goal: Area,
        /// The goal that the format stands for.
        center: Area,
    },
}

fn size(area: Area) -> String {
    format!("{} x {} cells", area.width(), area.height())
}
