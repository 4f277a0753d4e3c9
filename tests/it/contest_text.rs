//! [`ContestText`]: a contest file of robots, mazes and whatever else it says.

use std::fs;
use std::path::Path;

/// The text of a contest file. Robots and mazes are in the order of the calls.
pub struct ContestText(String);

impl ContestText {
    /// A contest of bundled robots.
    pub fn of(robots: &[&str]) -> Self {
        let start = Self("version = 1\n".to_owned());
        robots.iter().fold(start, |contest, robot| {
            contest.with(&format!("[[robots]]\nbundled = \"{robot}\""))
        })
    }

    /// And a set of mazes.
    pub fn mazes(self, set: &str, paths: &[&str]) -> Self {
        self.with(&format!("[[mazes]]\nset = \"{set}\"\npaths = {paths:?}"))
    }

    /// And these lines.
    pub fn with(mut self, lines: &str) -> Self {
        self.0.push_str(lines);
        self.0.push('\n');
        self
    }

    /// Writes it as the `contest.toml` of a folder.
    #[track_caller]
    pub fn write(&self, folder: &Path) {
        fs::write(folder.join("contest.toml"), &self.0).expect("a folder to write to");
    }
}
