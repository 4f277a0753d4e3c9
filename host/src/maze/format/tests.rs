//! Good and bad input for every format, and the round-trip law.

use proptest::prelude::*;

use super::super::{Area, Cell, Heading, Maze, Walls};
use super::*;

/// Reads `text` and compares with `Ok` (format, start, goal origin, goal width)
/// or the error message.
fn check(text: &str, expected: Result<(Format, Cell, Area), &str>) {
    let found = parse(text)
        .map(|parsed| (parsed.format, parsed.maze.start(), parsed.maze.goal()))
        .map_err(|error| error.to_string());
    assert_eq!(found, expected.map_err(str::to_owned), "{text:?}");
}

fn center(dimension: u8) -> Area {
    Area::center(dimension)
}

const ZERO: Cell = Cell::new(0, 0);
const UDACITY: &str = "3\n3,5,6\n10,1,14\n9,5,12";
const MAP: &str = "\
+---+---+---+
|           |
+   +---+   +
|       |   |
+---+   +   +
|   |       |
+---+---+---+
";

/// The same maze as [`MAP`].
const BLOCKS: &str = "\
1111111
1000001
1011101
1000101
1110101
1010001
1111111
";

#[test]
fn good_files() {
    let udacity = Ok((Format::Udacity, ZERO, center(3)));
    check(UDACITY, udacity);
    check(&UDACITY.replace('\n', "\r\n"), udacity);
    check(&format!("{UDACITY}\n\n  \n"), udacity);
    check(&format!("\u{feff}{UDACITY}"), udacity);
    check(&UDACITY.replace(',', " ,\t"), udacity);
    check("3\n0,0,0\n0,0,0\n0,0,0", udacity);

    let map = Ok((Format::Map, ZERO, center(3)));
    check(MAP, map);
    check(MAP.trim_end(), map);
    check(&MAP.replace('\n', "\r\n"), map);
    for post in ['.', '#', '*', '┼', ' '] {
        check(&MAP.replace('+', &post.to_string()), map);
    }
    check(&MAP.replace(['|', '-'], "#"), map);

    let picture = MAP.replace('+', "o");
    check(&picture, Ok((Format::Competition, ZERO, center(3))));
    let marked = picture
        .replace("|       |   |", "|       | S |")
        .replace("|           |", "| G   G     |");
    let goal = Area::new(Cell::new(0, 2), 2, 1).expect("not empty");
    check(&marked, Ok((Format::Competition, Cell::new(2, 1), goal)));
    let marked = marked.replace('o', "+");
    check(&marked, Ok((Format::Map, Cell::new(2, 1), goal)));

    let blocks = Ok((Format::Blocks, ZERO, center(3)));
    check(BLOCKS, blocks);
    check(BLOCKS.trim_end(), blocks);
    check(&BLOCKS.replace('\n', "\r\n"), blocks);
    check(&format!("\u{feff}{BLOCKS}\n \n"), blocks);

    let num = print(&parse(MAP).expect("a maze").maze, Format::Num).expect("no marks");
    let backwards: Vec<&str> = num.lines().rev().collect();
    let tabs = format!("  {}", num.replace(' ', "\t ").replace('\n', " \n"));
    for text in [&num, &backwards.join("\n"), &tabs] {
        check(text, Ok((Format::Num, ZERO, center(3))));
    }
}

#[test]
fn all_formats_describe_the_same_maze() {
    let maze = parse(MAP).expect("a maze").maze;
    assert!(maze.walls().is_open(Cell::new(1, 0), Heading::Up));
    assert!(!maze.walls().is_open(Cell::new(1, 1), Heading::Up));
    assert!(!maze.walls().is_open(Cell::new(0, 0), Heading::Right));
    let texts = [
        (Format::Udacity, "3\n0,3,6\n3,12,10\n9,5,12".to_owned()),
        (Format::Map, MAP.to_owned()),
        (Format::Blocks, BLOCKS.to_owned()),
        (
            Format::Num,
            "0 0 1 1 1 1\n0 1 0 0 1 1\n0 2 1 0 0 1\n\
             1 0 0 0 1 1\n1 1 1 1 0 0\n1 2 1 0 1 0\n\
             2 0 0 1 1 0\n2 1 0 1 0 1\n2 2 1 1 0 0\n"
                .to_owned(),
        ),
    ];
    for (format, text) in texts {
        assert_eq!(print(&maze, format), Ok(text.clone()));
        assert_eq!(parse_as(&text, format).expect("a maze").maze, maze);
    }
}

#[test]
fn text_that_is_no_maze() {
    for blank in ["", "\n", " \r\n\t\n", "\u{feff}"] {
        check(blank, Err("the text is empty"));
    }
    let what = "line 1: expected the dimension alone, a row of posts such as `o---o`, \
                the six numbers of a cell, or a row of blocks such as `11111`, found ";
    let unknown = [
        ("# My maze\n", "`# My maze`"),
        ("\n12\n", "nothing"),
        ("      \n12\n", "`      `"),
        ("twelve", "`twelve`"),
        ("-3", "`-3`"),
        ("1111x", "`1111x`"),
        ("o--o", "`o--o`"),
        ("\u{1b}[2Jboo", "`\\u{1b}[2Jboo`"),
        (
            "{\"maze\": \"a very long line of JSON\"}",
            "`{\"maze\": \"a very long li...`",
        ),
    ];
    for (text, found) in unknown {
        check(text, Err(&format!("{what}{found}")));
    }
    let huge = "1".repeat(100 << 20);
    check(
        &huge,
        Err("104857600 bytes are more than any maze file has (at most 262144)"),
    );
}

#[test]
fn bad_udacity_files() {
    let bad = [
        (
            "0",
            "line 1, column 1: expected a dimension from 2 to 64, found `0`",
        ),
        (
            "1\n0",
            "line 1, column 1: expected a dimension from 2 to 64, found `1`",
        ),
        (
            "65",
            "line 1, column 1: expected a dimension from 2 to 64, found `65`",
        ),
        (
            "  999999999\n",
            "line 1, column 3: expected a dimension from 2 to 64, found `999999999`",
        ),
        (
            "99999999999999999999999999999999\n",
            "line 1, column 1: expected a dimension from 2 to 64, found `999999999999999999999999...`",
        ),
        (
            "3\n3,5,6\n10,1,14",
            "line 4: expected the 3 values of column 2, found the end of the text",
        ),
        (
            "3\n3,5,6\n10,1,14\n9,5,12\n1,2,3",
            "line 5, column 1: expected the end of the text after 3 columns, found `1,2,3`",
        ),
        (
            "3\n3,5\n10,1,14\n9,5,12",
            "line 2, column 4: expected 3 values, the line has 2, found the end of the line",
        ),
        (
            "3\n3,5,6, 7\n10,1,14\n9,5,12",
            "line 2, column 8: expected the end of the line after 3 values, found `7`",
        ),
        (
            "3\n3,16,6\n10,1,14\n9,5,12",
            "line 2, column 3: expected a number from 0 to 15, found `16`",
        ),
        (
            "3\n3,-1,6\n10,1,14\n9,5,12",
            "line 2, column 3: expected a number from 0 to 15, found `-1`",
        ),
        (
            "3\n3,,6\n10,1,14\n9,5,12",
            "line 2, column 3: expected a number from 0 to 15, found nothing",
        ),
        (
            "3\n3,é, \u{7}\n",
            "line 2, column 3: expected a number from 0 to 15, found `é`",
        ),
        (
            "3\n3,5, \u{7}\n",
            "line 2, column 6: expected a number from 0 to 15, found `\\u{7}`",
        ),
        (
            "3\n\n3,5,6\n",
            "line 2, column 1: expected a number from 0 to 15, found nothing",
        ),
        (
            "3\n3,5,6\n10,1,14\n9,5,14",
            "1 wrong edge: (2, 2) is open right through the perimeter",
        ),
        (
            "3\n3,5,6\n10,1,10\n9,5,12",
            "1 wrong edge: (1, 1) is open up but (1, 2) is closed down",
        ),
        (
            "3\n15,15,15\n15,15,15\n0,15,15",
            "12 wrong edges: (0, 0) is open down through the perimeter, \
             (0, 0) is open left through the perimeter, \
             (0, 1) is open left through the perimeter, \
             (0, 2) is open up through the perimeter, \
             (0, 2) is open left through the perimeter, \
             (1, 0) is open right but (2, 0) is closed left, \
             (1, 0) is open down through the perimeter, \
             (1, 2) is open up through the perimeter and 4 more",
        ),
        ("2\n3,6\n9,12", "start (0, 0) lies in the goal"),
    ];
    for (text, message) in bad {
        check(text, Err(message));
    }
}

#[test]
fn bad_blocks() {
    // (text to replace once, replacement, message)
    let bad = [
        (
            "1011101",
            "1001101",
            "line 3, column 3: expected `1` (a post), found `0`",
        ),
        (
            "1000101",
            "1100101",
            "line 4, column 2: expected `0` (a cell is open), found `1`",
        ),
        (
            "1011101",
            "10x1101",
            "line 3, column 3: expected `1` (a post), found `x`",
        ),
        (
            "1011101",
            "10 1101",
            "line 3, column 3: expected `1` (a post), found a space",
        ),
        (
            "1011101",
            "1211101",
            "line 3, column 2: expected `1` or `0`, found `2`",
        ),
        (
            "1000101",
            "10\u{7}0101",
            "line 4, column 3: expected `1` or `0`, found `\\u{7}`",
        ),
        (
            "1011101",
            "0011101",
            "line 3, column 1: expected `1` (the perimeter is closed), found `0`",
        ),
        (
            "1000101",
            "1000100",
            "line 4, column 7: expected `1` (the perimeter is closed), found `0`",
        ),
        (
            "1111111",
            "1101111",
            "line 1, column 3: expected `1` (the perimeter is closed), found `0`",
        ),
        (
            "1010001\n1111111",
            "1010001\n1111110",
            "line 7, column 7: expected `1` (the perimeter is closed), found `0`",
        ),
        (
            "1000101",
            "100010",
            "line 4, column 7: expected `1` (the perimeter is closed), found the end of the line",
        ),
        (
            "1011101",
            "101110",
            "line 3, column 7: expected `1` (the perimeter is closed), found the end of the line",
        ),
        (
            "1000101",
            "10001010",
            "line 4, column 8: expected the end of the line after 3 cells, found `0`",
        ),
        (
            "1111111\n1000001",
            "11111111\n1000001",
            "line 1, column 9: expected a whole number of cells, two characters each, and a wall, \
             found the end of the line",
        ),
        (
            "1010001\n1111111\n",
            "1010001\n1111111\nMilestone 3",
            "line 8, column 1: expected the end of the text after 3 rows of cells, found `Milestone 3`",
        ),
        (
            "1010001\n1111111\n",
            "1010001\n",
            "line 7: expected a row of walls, found the end of the text",
        ),
        (
            "1010001\n1111111\n",
            "",
            "the maze has 3 columns and 2 rows of cells; mazes are square",
        ),
    ];
    for (good, change, message) in bad {
        check(&BLOCKS.replacen(good, change, 1), Err(message));
    }
    // The example of the report.
    check(
        "11111\n10001\n11101\n10001\n10101\n10101\n11111",
        Err("the maze has 2 columns and 3 rows of cells; mazes are square"),
    );
    check(
        "11111\n10001\n10101\n10001\n11111",
        Err("start (0, 0) lies in the goal"),
    );
    for cells in [65, 20_000] {
        check(
            &"1".repeat(2 * cells + 1),
            Err(&format!(
                "a width of {cells} is outside the 2 to 64 cells that mazes have"
            )),
        );
    }
    // Too short for blocks, so it can only be meant as a dimension.
    check(
        "111\n101\n111",
        Err("line 1, column 1: expected a dimension from 2 to 64, found `111`"),
    );
}

#[test]
fn bad_num_files() {
    let bad = [
        (
            "0 0 1 1 1 1",
            "a width of 1 is outside the 2 to 64 cells that mazes have",
        ),
        (
            "0 0 1 1 1",
            "line 1, column 10: expected the west wall (0 to 1), found the end of the line",
        ),
        (
            "0 0 1 1 1 1 1",
            "line 1, column 13: expected the end of the line after six numbers, found `1`",
        ),
        (
            "0  0 1 2 1 1",
            "line 1, column 8: expected the east wall (0 to 1), found `2`",
        ),
        (
            "999999999 0 1 1 1 1",
            "line 1, column 1: expected the x of a cell (0 to 63), found `999999999`",
        ),
        (
            "0 64 1 1 1 1",
            "line 1, column 3: expected the y of a cell (0 to 63), found `64`",
        ),
        (
            "0 0 1 1 1 1\n0 x 1 1 1 1",
            "line 2, column 3: expected the y of a cell (0 to 63), found `x`",
        ),
        (
            // The example in the README of mms.
            "0 0 0 1 1 1\n0 1 1 0 0 1\n1 0 0 0 1 1\n1 1 1 1 0 0\n2 0 0 1 1 0\n2 1 1 1 0 1",
            "the maze has 3 columns and 2 rows of cells; mazes are square",
        ),
        (
            "0 0 0 1 1 1\n1 1 1 1 0 0\n0 0 0 1 1 1",
            "line 3: second line for cell (0, 0), the first is line 1",
        ),
        ("0 0 0 1 1 1\n1 1 1 1 0 0", "no line for (0, 1), (1, 0)"),
        (
            "0 0 1 1 1 1\n0 1 1 1 0 1\n1 0 1 1 1 1\n1 1 1 0 1 1",
            "2 wrong edges: (0, 0) is closed up but (0, 1) is open down, \
             (1, 1) is open right through the perimeter",
        ),
    ];
    for (text, message) in bad {
        check(text, Err(message));
    }
}

#[test]
fn bad_pictures() {
    // (text to replace once, replacement, message for posts `o`)
    let bad = [
        (
            "|       |",
            "|       x",
            "line 4, column 9: expected `|` or a space, found `x`",
        ),
        (
            "+   +---+",
            "+   x---+",
            "line 3, column 5: expected a post `o`, found `x`",
        ),
        (
            "+   +---+",
            "+   +-- +",
            "line 3, column 8: expected `-` as before it, found a space",
        ),
        (
            "+   +---+",
            "+ - +---+",
            "line 3, column 3: expected a space as before it, found `-`",
        ),
        (
            "+   +---+",
            "+   +=--+",
            "line 3, column 6: expected `-` or a space, found `=`",
        ),
        (
            "|           |",
            "            |",
            "line 2, column 1: expected `|` (the perimeter is closed), found a space",
        ),
        (
            "|           |",
            "|            ",
            "line 2, column 13: expected `|` (the perimeter is closed), found a space",
        ),
        (
            "|           |",
            "|          ",
            "line 2, column 12: expected a space, found the end of the line",
        ),
        (
            "|           |",
            "|           | ",
            "line 2, column 14: expected the end of the line after 3 cells, found ` `",
        ),
        (
            "|           |",
            "|X          |",
            "line 2, column 2: expected a space, found `X`",
        ),
        (
            "|           |",
            "| X         |",
            "line 2, column 3: expected a space, `S` or `G`, found `X`",
        ),
        (
            "|           |",
            "| \u{8}         |",
            "line 2, column 3: expected a space, `S` or `G`, found `\\u{8}`",
        ),
        (
            "|           |",
            "| S   S     |",
            "line 2, column 7: second start `S`, the first is at (0, 2)",
        ),
        (
            "|           |",
            "| G       G |",
            "the 2 goal cells do not fill a rectangle: (0, 2), (2, 2)",
        ),
        (
            "|   |       |",
            "| G |       |",
            "start (0, 0) lies in the goal",
        ),
        (
            "+---+---+---+\n|   ",
            "+---+---+   +\n|   ",
            "line 1, column 10: expected `-` (the perimeter is closed), found a space",
        ),
        (
            "+---+---+---+\n|   ",
            "+---+---+---+-\n|   ",
            "line 1, column 15: expected a whole number of cells, four characters each, and a post, found the end of the line",
        ),
        (
            "+---+---+---+\n|   ",
            "+---+---+\n|   ",
            "the maze has 2 columns and 3 rows of cells; mazes are square",
        ),
        (
            "+---+   +   +\n|   |       |\n+---+---+---+\n",
            "",
            "line 5: expected a row of posts and walls, found the end of the text",
        ),
        (
            "|   |       |\n+---+---+---+\n",
            "",
            "the maze has 3 columns and 2 rows of cells; mazes are square",
        ),
    ];
    for (good, change, message) in bad {
        let competition = MAP.replacen(good, change, 1).replace('+', "o");
        check(&competition, Err(message));
    }
    let picture = MAP.replace('+', "o");
    let after = "line 8, column 1: expected the end of the text after 3 rows of cells, found ";
    check(
        &format!("{picture}by A. Mouse"),
        Err(&format!("{after}`by A. Mouse`")),
    );
    check(
        &format!("{picture}by\nA. Mouse"),
        Err(&format!("{after}`by`")),
    );
    check(
        &format!("{picture}{picture}"),
        Err(&format!("{after}`o---o---o---o`")),
    );
    let row = "o---o---o---o\n|           |\n";
    let taller = format!("{row}{row}{picture}");
    check(
        &taller,
        Err("the maze has 3 columns and 5 rows of cells; mazes are square"),
    );
    let map = MAP.replacen("+   +---+", "+ - +---+", 1);
    check(
        &map,
        Err("line 3, column 3: expected a space as before it, found `-`"),
    );
    let map = MAP.replacen("+   +---+", "+   \t---+", 1);
    check(&map, Err("line 3, column 5: expected a post, found `\\t`"));
    for cells in [1, 65, 20_000] {
        check(
            &format!("o{}", "---o".repeat(cells)),
            Err(&format!(
                "a width of {cells} is outside the 2 to 64 cells that mazes have"
            )),
        );
    }
}

/// Puts an `x` in every place of a good file, one after the other: the error
/// has to point there or, for a number, to its beginning.
#[test]
fn every_wrong_character_is_found_where_it_is() {
    let maze = parse(MAP).expect("a maze").maze;
    for format in [
        Format::Udacity,
        Format::Competition,
        Format::Num,
        Format::Blocks,
    ] {
        let good = print(&maze, format).expect("the usual start and goal");
        for (number, good_line) in good.lines().enumerate() {
            for at in 0..good_line.len() {
                let mut lines: Vec<String> = good.lines().map(str::to_owned).collect();
                lines[number].replace_range(at..=at, "x");
                let wrong = lines.join("\n");
                let Err(ParseError::Unexpected { line, column, .. }) = parse_as(&wrong, format)
                else {
                    panic!("line and column are known: {wrong}");
                };
                let begin = match format {
                    Format::Competition | Format::Map | Format::Blocks => at,
                    Format::Udacity | Format::Num => {
                        let before = good_line[..at].rfind([',', ' ']);
                        before.map_or(0, |separator| separator + 1)
                    }
                };
                assert_eq!((line, column), (number + 1, begin + 1), "{wrong}");
            }
        }
    }
}

#[test]
fn a_given_format_is_not_guessed() {
    let error = parse_as(MAP, Format::Competition).expect_err("posts are +");
    assert_eq!(
        error.to_string(),
        "line 1, column 1: expected a post `o`, found `+`"
    );
    let parsed = parse_as(&MAP.replace('+', "o"), Format::Map).expect("any post");
    assert_eq!(parsed.format, Format::Map);
}

#[test]
fn only_competition_text_holds_marks() {
    let walls = Walls::open(5);
    let start = Maze::new(walls.clone(), Cell::new(1, 0), center(5)).expect("fits");
    let room = Area::new(Cell::new(3, 3), 2, 1).expect("not empty");
    let goal = Maze::new(walls, ZERO, room).expect("fits");
    for format in [Format::Udacity, Format::Map, Format::Num, Format::Blocks] {
        assert_eq!(
            print(&start, format).expect_err("no mark").to_string(),
            format!(
                "the {format} format cannot hold start (1, 0): it has no mark, the start is (0, 0)"
            )
        );
        assert_eq!(
            print(&goal, format).expect_err("no mark").to_string(),
            format!(
                "the {format} format cannot hold a goal of 2 x 1 cells at (3, 3): \
                 it has no mark, the goal is the centre (1 x 1 cells at (2, 2))"
            )
        );
    }
    for maze in [start, goal] {
        let text = print(&maze, Format::Competition).expect("has marks");
        assert_eq!(parse(&text).expect("a maze").maze, maze);
    }
}

#[test]
fn format_names_are_parsed() {
    for format in Format::ALL {
        assert_eq!(format.name().parse(), Ok(format));
    }
    assert_eq!(
        "ma\tp"
            .parse::<Format>()
            .expect_err("no format")
            .to_string(),
        "unknown maze format `ma\\tp`, expected udacity, competition, map, num or blocks"
    );
}

#[test]
fn the_official_file_is_printed_byte_for_byte() {
    let text = include_str!("../../../mazes/test_maze_01.txt");
    let maze = parse(text).expect("a maze").maze;
    assert_eq!(print(&maze, Format::Udacity), Ok(text.to_owned()));
}

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
