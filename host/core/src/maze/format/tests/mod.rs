//! Valid files of every format, and text of no format. Invalid files of each format are in
//! [`numbers`] and [`pictures`], properties of all text in [`laws`].

mod laws;
mod numbers;
mod pictures;

use super::*;
use crate::maze::{Area, Cell, Heading, Maze, Walls};

/// Parses `text` and compares with `Ok` (format, start, goal) or the error message.
#[track_caller]
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
fn valid_files_are_parsed() {
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
fn text_of_no_format_is_rejected() {
    for blank in ["", "\n", " \r\n\t\n", "\u{feff}"] {
        check(blank, Err("the text is empty"));
    }
    let what = "line 1: expected the maze size on its own, a row of posts such as `o---o`, \
                the six numbers of a cell, or a row of blocks such as `11111`, found ";
    let unknown = [
        ("# My maze\n", "`#...`"),
        ("\n12\n", "nothing"),
        ("      \n12\n", "` ...`"),
        ("twelve", "`t...`"),
        ("-3", "`-3`"),
        ("1111x", "`1...`"),
        ("o--o", "`o...`"),
        ("\u{1b}[2Jboo", "`\\u{1b}...`"),
        ("{\"maze\": \"a very long line of JSON\"}", "`{...`"),
    ];
    for (text, found) in unknown {
        check(text, Err(&format!("{what}{found}")));
    }
    let huge = "1".repeat(100 << 20);
    check(
        &huge,
        Err("the text has 104857600 bytes, the limit is 262144"),
    );
}

/// Replaces every character of a valid file by `x`, one at a time: the error points there or,
/// for a number, to its start.
#[test]
fn every_invalid_character_is_located() {
    let maze = parse(MAP).expect("a maze").maze;
    // In a map, an `x` is a wall or a post.
    for format in Format::ALL.into_iter().filter(|&it| it != Format::Map) {
        let good = print(&maze, format).expect("the usual start and goal");
        for (number, good_line) in good.lines().enumerate() {
            for at in 0..good_line.len() {
                let mut lines: Vec<String> = good.lines().map(str::to_owned).collect();
                lines[number].replace_range(at..=at, "x");
                let wrong = lines.join("\n");
                let Err(ParseError::Unexpected { line, column, .. }) = parse_as(&wrong, format)
                else {
                    panic!("no line and column: {wrong}");
                };
                let start = match format {
                    Format::Competition | Format::Map | Format::Blocks => at,
                    Format::Udacity | Format::Num => {
                        let before = good_line[..at].rfind([',', ' ']);
                        before.map_or(0, |separator| separator + 1)
                    }
                };
                assert_eq!((line, column), (number + 1, start + 1), "{wrong}");
            }
        }
    }
}

#[test]
fn a_given_format_is_not_recognised_again() {
    let error = parse_as(MAP, Format::Competition).expect_err("posts are +");
    assert_eq!(
        error.to_string(),
        "line 1, column 1: expected a post `o`, found `+`"
    );
    let parsed = parse_as(&MAP.replace('+', "o"), Format::Map).expect("any post");
    assert_eq!(parsed.format, Format::Map);
}

#[test]
fn only_competition_text_stores_marks() {
    let walls = Walls::open(5);
    let start = Maze::new(walls.clone(), Cell::new(1, 0), center(5)).expect("fits");
    let room = Area::new(Cell::new(3, 3), 2, 1).expect("not empty");
    let goal = Maze::new(walls, ZERO, room).expect("fits");
    for format in [Format::Udacity, Format::Map, Format::Num, Format::Blocks] {
        let message = |maze| print(maze, format).expect_err("no mark").to_string();
        assert_eq!(
            message(&start),
            format!("the {format} format cannot store start (1, 0): its start is always (0, 0)")
        );
        assert_eq!(
            message(&goal),
            format!(
                "the {format} format cannot store a goal of 2 x 1 cells at (3, 3): \
                 its goal is always the centre (1 x 1 cells at (2, 2))"
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
    let error = "ma\tp".parse::<Format>().expect_err("no format");
    assert_eq!(
        error.to_string(),
        "unknown maze format `ma\\tp`, expected udacity, competition, map, num or blocks"
    );
}

#[test]
fn the_official_file_is_printed_byte_for_byte() {
    let text = include_str!("../../../../mazes/test_maze_01.txt");
    let maze = parse(text).expect("a maze").maze;
    assert_eq!(print(&maze, Format::Udacity), Ok(text.to_owned()));
}
