//! [`Style`]: the formats that are pictures, and their characters.

/// The formats that are pictures.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Style {
    /// Competition text, the format of public micromouse maze collections. Posts are `o`, walls
    /// `---` and `|`, `S` marks the start and `G` the goal cells. Without `S` the start is
    /// (0, 0), without `G` the goal is the centre (training mazes have neither). Both marks are
    /// always printed.
    Competition,
    /// The text map of micromouse simulators such as mms. Any visible character is a wall; any
    /// character is a post, even a space, because simulators look at the walls only. Marks are
    /// parsed like those of competition text, but not printed, because they are not part of the
    /// format. Posts are printed as `+`.
    Map,
    /// Block maps, the format of the sketch-city report: `1` is a wall and `0` is open. A post is
    /// `1` even if no wall touches it, and a cell is `0` even if it has no exit. In other files,
    /// robots could stand where a robot of this contest cannot, or pass where no edge of a cell
    /// is. The example in the report is 2 cells wide and 3 high; here, mazes are square. The
    /// start is always (0, 0) and the goal the centre.
    Blocks,
}

impl Style {
    /// Characters from one vertical wall to the next.
    pub(super) const fn cell_width(self) -> usize {
        match self {
            Self::Competition | Self::Map => 4,
            Self::Blocks => 2,
        }
    }

    /// The characters of posts, horizontal walls, vertical walls and open places.
    pub(super) const fn drawn(self) -> [char; 4] {
        match self {
            Self::Competition => ['o', '-', '|', ' '],
            Self::Map => ['+', '-', '|', ' '],
            Self::Blocks => ['1', '1', '1', '0'],
        }
    }

    pub(super) fn is_post(self, found: char) -> bool {
        match self {
            Self::Map => found == ' ' || is_visible(found),
            Self::Competition | Self::Blocks => found == self.drawn()[0],
        }
    }

    pub(super) fn is_wall(self, found: char, drawn: char) -> bool {
        match self {
            Self::Map => is_visible(found),
            Self::Competition | Self::Blocks => found == drawn,
        }
    }
}

fn is_visible(character: char) -> bool {
    !character.is_whitespace() && !character.is_control()
}
