//! [`Format`]: the text formats by name, and the size limit that they share.

use std::fmt;
use std::str::FromStr;

/// The longest text that is parsed, in bytes: 256 KiB.
///
/// The longest sensible file is a 64 x 64 maze in [`Format::Num`], under 60 KB. Longer text
/// is rejected unread, so that a huge file costs neither time nor memory.
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
    /// The size, then one line of comma-separated values per column.
    Udacity,
    /// A picture with posts `o`, start `S` and goal cells `G`.
    Competition,
    /// The same picture with any character as post, as micromouse simulators draw it.
    Map,
    /// One line of six numbers per cell.
    Num,
    /// A picture of blocks: `1` is a wall, `0` is open.
    Blocks,
}

impl Format {
    /// All formats, in the order of help texts.
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

/// A name that is not the name of a format.
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
