//! The mazes that come with wasmouse.
//!
//! Embedded as text, so that they go through the same reader as any file. The
//! files are in `host/mazes`.

/// A maze that needs no file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BundledMaze {
    /// What users call it: the name of its file without the extension.
    pub name: &'static str,
    /// The contents of its file.
    pub text: &'static str,
}

const MAZES: &[BundledMaze] = &[BundledMaze {
    name: "test_maze_01",
    text: include_str!("../../mazes/test_maze_01.txt"),
}];

/// All bundled mazes, in the order in which they are listed and run. Each is a
/// legal contest maze.
///
/// ```
/// use wasmouse::maze::{bundled, format};
/// let official = &bundled()[0];
/// assert_eq!(official.name, "test_maze_01");
/// let maze = format::parse(official.text).expect("bundled mazes parse").maze;
/// assert_eq!(maze.dimension(), 12);
/// ```
pub const fn bundled() -> &'static [BundledMaze] {
    MAZES
}

#[cfg(test)]
mod tests {
    use super::super::{format, violations};
    use super::*;

    #[test]
    fn every_bundled_maze_is_legal_and_named_once() {
        for (place, bundled_maze) in bundled().iter().enumerate() {
            let parsed = format::parse(bundled_maze.text).expect("bundled mazes parse");
            assert_eq!(violations(&parsed.maze), [], "{}", bundled_maze.name);
            let before = &bundled()[..place];
            assert!(before.iter().all(|maze| maze.name != bundled_maze.name));
        }
    }
}
