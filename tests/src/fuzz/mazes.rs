//! Maze files: every format, and what comes back when a maze that was read is printed.

use wasmouse::maze::format::{Format, parse, parse_as, print};
use wasmouse::maze::generate::GenSpec;
use wasmouse::maze::{Area, Cell, Maze, Survey, bundled, omniscient_floor, violations};

use super::Target;

pub(super) const TARGET: Target = Target {
    name: "mazes",
    about: "maze files in every format, and mazes as bytes",
    seeds,
    words: &[
        b"o---o",
        b"+---+",
        b"+   +",
        b"| S |",
        b"| G |",
        b"\r\n",
        b"\n",
        b"\xef\xbb\xbf",
        b" 0 ",
        b"1,",
        b"12\n",
        b"64\n",
        b"11111\n",
        b"10001",
        "é".as_bytes(),
    ],
    bytes_max: 64 << 10,
    make: || Box::new(run),
    short: 4000,
    takes_modules: false,
};

/// Cells along the side of mazes that are solved too, at most.
const SOLVED_MAX: u8 = 12;

fn seeds() -> Vec<Vec<u8>> {
    let bundled = bundled().iter().take(3);
    let mut mazes: Vec<Maze> = bundled
        .filter_map(|it| Some(parse(it.text).ok()?.maze))
        .collect();
    let generated: GenSpec = "gen:braid:12:1..=2".parse().expect("a specification");
    mazes.extend(generated.expand().map(|(_, maze)| maze));
    let mut seeds = vec![b"3\n3,5,6\n10,1,14\n9,5,12\n".to_vec()];
    let small = parse("3\n3,5,6\n10,1,14\n9,5,12\n").expect("a maze");
    mazes.insert(0, small.maze);
    for maze in &mazes {
        let texts = Format::ALL
            .into_iter()
            .filter_map(|it| print(maze, it).ok());
        seeds.extend(texts.map(String::into_bytes));
        seeds.push(maze.identity_bytes());
    }
    seeds
}

fn run(bytes: &[u8]) -> String {
    if let Some(maze) = Maze::from_identity_bytes(bytes) {
        assert_eq!(maze.identity_bytes(), bytes, "identity");
        return look_at(&maze);
    }
    let Ok(text) = std::str::from_utf8(bytes) else {
        return "no text".into();
    };
    let parsed = match parse(text) {
        Ok(parsed) => parsed,
        Err(error) => {
            for format in Format::ALL {
                if let Ok(parsed) = parse_as(text, format) {
                    return format!("hidden {format}: {}", look_at(&parsed.maze));
                }
            }
            return error.to_string();
        }
    };
    let again = parse_as(text, parsed.format).expect("it was read in that format");
    assert_eq!(again, parsed, "read in two ways");
    format!("{}: {}", parsed.format, look_at(&parsed.maze))
}

/// A maze survives every format that can hold it, and can be judged.
fn look_at(maze: &Maze) -> String {
    let is_usual = maze.start() == Cell::new(0, 0) && maze.goal() == Area::center(maze.dimension());
    for format in Format::ALL {
        match print(maze, format) {
            Ok(text) => {
                let again = parse_as(&text, format).expect("what was printed is a maze");
                assert_eq!(again.maze, *maze, "as {format}");
                let found = parse(&text).expect("what was printed is recognised");
                assert_eq!(found.format, format, "printed as {format}");
            }
            Err(error) => {
                let is_possible = is_usual || format == Format::Competition;
                assert!(!is_possible, "as {format}: {error}");
            }
        }
    }
    assert_eq!(
        Maze::from_identity_bytes(&maze.identity_bytes()).as_ref(),
        Some(maze),
        "identity"
    );
    let broken = violations(maze).len();
    Survey::default().add(maze);
    let dimension = maze.dimension();
    let solved = (dimension <= SOLVED_MAX).then(|| omniscient_floor(maze, 3).is_some());
    let size = if dimension.is_multiple_of(2) {
        "even"
    } else {
        "odd"
    };
    let is_large = dimension > SOLVED_MAX;
    format!(
        "{size} {is_large} usual {is_usual} broken {} solved {solved:?}",
        broken > 0
    )
}
