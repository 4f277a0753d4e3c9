//! The mazes that come with wasmouse.
//!
//! Embedded as text, so that they go through the same reader as any file. The
//! files are in `host/core/mazes`.

/// A maze that needs no file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BundledMaze {
    /// What users call it: the name of its file without the extension.
    pub name: &'static str,
    /// The contents of its file.
    pub text: &'static str,
}

/// The official maze, then generated ones of every size, then the experiment of
/// Lobato's report (section 5.1): maze 01 with two more walls, up of (3, 4) and right
/// of (6, 8). They close the way across the middle and leave two: a long one by the
/// top left, which a search that counts walls not seen yet as open takes because it
/// stays near the goal, and the best one by the right, which goes away from it first.
/// The report's own maze is only in a picture.
const MAZES: &[BundledMaze] = &[
    BundledMaze {
        name: "test_maze_01",
        text: include_str!("../../mazes/test_maze_01.txt"),
    },
    BundledMaze {
        name: "braid-12",
        text: include_str!("../../mazes/braid-12.txt"),
    },
    BundledMaze {
        name: "division-14",
        text: include_str!("../../mazes/division-14.txt"),
    },
    BundledMaze {
        name: "tree-16",
        text: include_str!("../../mazes/tree-16.txt"),
    },
    BundledMaze {
        name: "division-18",
        text: include_str!("../../mazes/division-18.txt"),
    },
    BundledMaze {
        name: "braid-20",
        text: include_str!("../../mazes/braid-20.txt"),
    },
    BundledMaze {
        name: "lobato-detour",
        text: include_str!("../../mazes/lobato-detour.txt"),
    },
];

/// All bundled mazes, in the order in which they are listed and run. Each is a
/// legal contest maze.
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
    use super::super::format::{self, Format};
    use super::super::generate::GenSpec;
    use super::super::{Cell, Heading, violations};
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

    /// The generated ones are no private copies: anyone can make them again.
    #[test]
    fn generated_mazes_are_what_their_specifications_say() {
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

    /// The experiment's maze is maze 01 with the two walls that its comment names.
    #[test]
    fn the_detour_is_maze_01_with_two_more_walls() {
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
