//! [`Paint`]: the colours a cell can be painted in.

use wasmouse_core::journal::Color;

/// A colour of a cell. Every renderer also shows its [`letter`](Paint::letter)
/// or its name, so that no picture depends on seeing colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the colours name themselves")]
pub enum Paint {
    Red,
    Orange,
    Yellow,
    Green,
    Cyan,
    Blue,
    Violet,
    Gray,
}

impl Paint {
    /// All colours, in the order of the WIT.
    pub const ALL: [Self; 8] = [
        Self::Red,
        Self::Orange,
        Self::Yellow,
        Self::Green,
        Self::Cyan,
        Self::Blue,
        Self::Violet,
        Self::Gray,
    ];

    /// The colour that a robot painted a cell with; `None` removes it.
    pub const fn of(color: Color) -> Option<Self> {
        Some(match color {
            Color::None => return None,
            Color::Red => Self::Red,
            Color::Orange => Self::Orange,
            Color::Yellow => Self::Yellow,
            Color::Green => Self::Green,
            Color::Cyan => Self::Cyan,
            Color::Blue => Self::Blue,
            Color::Violet => Self::Violet,
            Color::Gray => Self::Gray,
        })
    }

    /// `red`, `orange` and so on.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Red => "red",
            Self::Orange => "orange",
            Self::Yellow => "yellow",
            Self::Green => "green",
            Self::Cyan => "cyan",
            Self::Blue => "blue",
            Self::Violet => "violet",
            Self::Gray => "gray",
        }
    }

    /// The first letter of the name, but `a` for gray.
    pub const fn letter(self) -> char {
        match self {
            Self::Red => 'r',
            Self::Orange => 'o',
            Self::Yellow => 'y',
            Self::Green => 'g',
            Self::Cyan => 'c',
            Self::Blue => 'b',
            Self::Violet => 'v',
            Self::Gray => 'a',
        }
    }

    /// The number of a similar colour in the 256-colour table of terminals.
    pub(super) const fn ansi(self) -> u8 {
        match self {
            Self::Red => 196,
            Self::Orange => 208,
            Self::Yellow => 220,
            Self::Green => 40,
            Self::Cyan => 44,
            Self::Blue => 33,
            Self::Violet => 135,
            Self::Gray => 245,
        }
    }

    /// A colour for SVG that stands out on white and on near-black.
    pub(super) const fn hex(self) -> &'static str {
        match self {
            Self::Red => "#e5484d",
            Self::Orange => "#f2861d",
            Self::Yellow => "#e2b203",
            Self::Green => "#30a46c",
            Self::Cyan => "#12a5b8",
            Self::Blue => "#3e7bfa",
            Self::Violet => "#8e5ce6",
            Self::Gray => "#8b8d98",
        }
    }
}
