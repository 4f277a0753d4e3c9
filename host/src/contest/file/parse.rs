//! [`ContestFile::parse`]: from the text of a contest file to its values, all checked.

use super::super::config::{ConfigError, Document};
use super::check;
use super::contest_file::{CONTEST_FILE_VERSION, ContestFile};

impl ContestFile {
    /// Reads a contest file.
    ///
    /// ```
    /// use wasmouse::contest::ContestFile;
    ///
    /// let file = ContestFile::parse(
    ///     "version = 1\n\
    ///      [[robots]]\n\
    ///      path = \"submissions/*.wasm\"\n\
    ///      [[mazes]]\n\
    ///      set = \"public\"\n\
    ///      paths = [\"test_maze_01\", \"gen:tree:16:1..=100\"]\n",
    /// );
    /// let file = file.expect("a contest file");
    /// assert_eq!(file.mazes[0].weight.get(), 1);
    /// ```
    ///
    /// # Errors
    ///
    /// With the first thing that is wrong.
    pub fn parse(text: &str) -> Result<Self, ConfigError> {
        let document = Document::parse(text)?;
        check::version(&document, CONTEST_FILE_VERSION)?;
        let file = document.read()?;
        check::check(&file, &document)?;
        Ok(file)
    }
}
