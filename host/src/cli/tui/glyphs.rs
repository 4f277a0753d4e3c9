//! The characters that mazes are drawn with.

use super::look::HEAT_LEVELS;
use crate::report::picture::Charset;

/// The characters of one charset, each one column wide.
pub struct Glyphs {
    /// A wall between a cell and the one below.
    pub level: char,
    /// A wall between a cell and the one beside it.
    pub upright: char,
    /// The floor of a small cell.
    pub floor: char,
    /// What nobody has looked at, and an upright wall of that kind.
    pub unknown: char,
    pub unknown_upright: char,
    /// The robot, by heading.
    pub robot: [char; 4],
    /// The path of the robot: where a step ends, and a cell passed through.
    pub path: [char; 2],
    /// The same of a path that is possible or optimal.
    pub optimum: [char; 2],
    /// By level, cold first.
    pub heat: [char; HEAT_LEVELS as usize + 1],
    /// By the arms of the post: 1 up, 2 right, 4 down, 8 left.
    pub posts: [char; 16],
}

impl Glyphs {
    /// The characters of that charset.
    pub const fn of(charset: Charset) -> &'static Self {
        match charset {
            Charset::Unicode => &Self::UNICODE,
            Charset::Ascii => &Self::ASCII,
        }
    }

    const UNICODE: Self = Self {
        level: '─',
        upright: '│',
        floor: '_',
        unknown: '·',
        unknown_upright: '┊',
        robot: ['▲', '▶', '▼', '◀'],
        path: ['●', '○'],
        optimum: ['◆', '◇'],
        heat: [' ', '░', '▒', '▓', '█'],
        posts: [
            ' ', '╵', '╶', '└', '╷', '│', '┌', '├', '╴', '┘', '─', '┴', '┐', '┤', '┬', '┼',
        ],
    };

    const ASCII: Self = Self {
        level: '-',
        upright: '|',
        floor: '_',
        unknown: '.',
        unknown_upright: ':',
        robot: ['^', '>', 'v', '<'],
        path: ['*', '+'],
        optimum: ['x', ','],
        heat: [' ', ':', '=', '%', '#'],
        posts: ['o'; 16],
    };
}
