//! [`MazesEntry`]: one `[[mazes]]` of a contest file.

use serde::Deserialize;

use super::super::config::{FilePath, Integer, Name};
use super::super::matrix::MazeSet;

/// A set of mazes that is scored by itself, too.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct MazesEntry {
    /// What reports call the set. No other set has the name.
    pub set: Name,
    /// The mazes: names of bundled ones, `gen:` specifications, files, folders and patterns. At
    /// least one.
    pub paths: Vec<FilePath>,
    /// How many times each of its mazes counts. Default 1.
    #[serde(default = "one")]
    pub weight: Integer<1, 1000>,
    /// Whether reports for contestants must not show its mazes. Default `false`.
    #[serde(default)]
    pub hidden: bool,
    /// Whether mazes that break contest rules are accepted. Default `false`.
    #[serde(default)]
    pub lenient: bool,
}

impl MazesEntry {
    /// The set without its mazes.
    pub fn maze_set(&self) -> MazeSet {
        MazeSet {
            name: self.set.as_str().to_owned(),
            is_hidden: self.hidden,
            weight: self.weight.get_u32(),
        }
    }
}

fn one() -> Integer<1, 1000> {
    Integer::new(1).expect("it is in the range")
}
