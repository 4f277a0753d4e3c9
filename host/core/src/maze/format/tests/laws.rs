//! Properties: round trips through every format, and errors for text of any kind.

use proptest::prelude::*;

use super::*;
use crate::maze::testing::random_walls;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn parsing_what_was_printed_gives_the_same_maze(walls in random_walls(3..=64)) {
        let maze = Maze::contest(walls).expect("start and goal fit");
        for format in Format::ALL {
            let text = print(&maze, format).expect("start and goal are unmarked");
            let parsed = parse(&text).expect("what was printed is a maze");
            prop_assert_eq!(&parsed.maze, &maze);
            prop_assert_eq!(parsed.format, format);
        }
    }

    #[test]
    fn competition_text_stores_any_start_and_goal(
        walls in random_walls(3..=64),
        places in proptest::array::uniform6(0u8..64),
    ) {
        let n = walls.dimension();
        let [x, y, left, bottom, width, height] = places;
        let origin = Cell::new(left % n, bottom % n);
        let (width, height) = (1 + width % (n - origin.x), 1 + height % (n - origin.y));
        let goal = Area::new(origin, width, height).expect("not empty");
        let start = Cell::new(x % n, y % n);
        prop_assume!(!goal.contains(start));
        let maze = Maze::new(walls, start, goal).expect("start and goal fit");
        let text = print(&maze, Format::Competition).expect("has marks");
        prop_assert_eq!(parse(&text).expect("a maze").maze, maze);
    }

    #[test]
    fn no_text_panics(text in "(|3\n|o---o---o\n|0 0 |11111\n1)[ -~\n\t\r,o|SG0-9é\u{0}\u{202e}-]{0,80}") {
        let outcome = parse(&text);
        for format in Format::ALL {
            drop(parse_as(&text, format));
        }
        if let Err(error) = outcome {
            let message = error.to_string();
            prop_assert!(!message.chars().any(char::is_control), "{message:?}");
        }
    }
}
