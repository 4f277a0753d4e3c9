//! The round trip of any maze through every format, and text of any kind.

use proptest::prelude::*;

use super::*;

prop_compose! {
    fn any_walls()(dimension in 3u8..=64)(
        dimension in Just(dimension),
        open in proptest::collection::vec(
            any::<bool>(),
            2 * usize::from(dimension) * usize::from(dimension),
        ),
    ) -> Walls {
        let mut walls = Walls::closed(dimension);
        let mut open = open.into_iter();
        let cells: Vec<Cell> = walls.cells().collect();
        for cell in cells {
            for heading in [Heading::Up, Heading::Right] {
                let open = open.next().expect("two per cell");
                if walls.neighbor(cell, heading).is_some() {
                    walls.set(cell, heading, open);
                }
            }
        }
        walls
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn printing_and_reading_is_the_identity(walls in any_walls()) {
        let maze = Maze::contest(walls).expect("start and goal fit");
        for format in Format::ALL {
            let text = print(&maze, format).expect("start and goal are the usual ones");
            let parsed = parse(&text).expect("what was printed is a maze");
            prop_assert_eq!(&parsed.maze, &maze);
            prop_assert_eq!(parsed.format, format);
        }
    }

    #[test]
    fn competition_text_holds_any_start_and_goal(
        walls in any_walls(),
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
