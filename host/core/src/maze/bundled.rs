//! The mazes that come with wasmouse.
//!
//! The files of `host/core/mazes`, embedded as text and parsed like any other file.

/// A maze that comes with wasmouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BundledMaze {
    /// The name of its file without the extension.
    pub name: &'static str,
    /// The contents of its file.
    pub text: &'static str,
}

/// The first official maze, then generated mazes of every size, then the experiment of
/// Lobato's report (section 5.1): maze 01 with two more walls, up of (3, 4) and right of
/// (6, 8). They close the path through the middle and leave two. A search that treats unknown
/// walls as open takes the long one through the top left, because it stays near the goal. The
/// optimal path leads away from the goal first, through the right. (The report shows its own
/// maze only as a picture.)
const MAZES: &[BundledMaze] = &[
    maze("test_maze_01", include_str!("../../mazes/test_maze_01.txt")),
    maze("braid-12", include_str!("../../mazes/braid-12.txt")),
    maze("division-14", include_str!("../../mazes/division-14.txt")),
    maze("tree-16", include_str!("../../mazes/tree-16.txt")),
    maze("division-18", include_str!("../../mazes/division-18.txt")),
    maze("braid-20", include_str!("../../mazes/braid-20.txt")),
    maze(
        "lobato-detour",
        include_str!("../../mazes/lobato-detour.txt"),
    ),
];

const fn maze(name: &'static str, text: &'static str) -> BundledMaze {
    BundledMaze { name, text }
}

/// All bundled mazes, in the order of listings and contests. Each is a legal contest maze.
///
/// ```
/// use wasmouse_core::maze::{bundled, format};
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
    use super::*;
    use crate::maze::format::{self, Format};
    use crate::maze::generate::GenSpec;
    use crate::maze::{Cell, Heading, violations};

    #[test]
    fn bundled_mazes_are_legal_and_have_unique_names() {
        for (place, bundled_maze) in bundled().iter().enumerate() {
            let parsed = format::parse(bundled_maze.text).expect("bundled mazes parse");
            assert_eq!(violations(&parsed.maze), [], "{}", bundled_maze.name);
            let before = &bundled()[..place];
            assert!(before.iter().all(|maze| maze.name != bundled_maze.name));
        }
    }

    /// Anyone can generate the generated mazes again.
    #[test]
    fn generated_mazes_match_their_specifications() {
        let specs = [
            "gen:braid:12:11",
            "gen:division:14:7",
            "gen:tree:16:1",
            "gen:division:18:4",
            "gen:braid:20:2",
        ];
        let [_official, generated @ .., _detour] = bundled() else {
            panic!("at least two mazes");
        };
        assert_eq!(generated.len(), specs.len());
        for (bundled_maze, spec) in generated.iter().zip(specs) {
            let spec: GenSpec = spec.parse().expect("a specification");
            let generated = spec.expand().next().expect("one maze");
            let (name, maze) = (generated.to_string(), generated.generate());
            let text = format::print(&maze, Format::Udacity).expect("a contest maze");
            assert_eq!(bundled_maze.text, text, "{} is {name}", bundled_maze.name);
            let kind_and_size = format!("{}-{}", spec.kind().name(), maze.dimension());
            assert_eq!(bundled_maze.name, kind_and_size);
        }
    }

    #[test]
    fn the_detour_is_maze_01_with_the_two_walls_of_its_comment() {
        let [official, .., detour] = bundled() else {
            panic!("at least two mazes");
        };
        let maze = |it: &BundledMaze| format::parse(it.text).expect("bundled mazes parse").maze;
        let mut walls = maze(official).walls().clone();
        for (cell, heading) in [
            (Cell::new(3, 4), Heading::Up),
            (Cell::new(6, 8), Heading::Right),
        ] {
            assert!(walls.is_open(cell, heading));
            walls.set(cell, heading, false);
        }
        assert_eq!(maze(detour).walls(), &walls);
    }
}
