//! `vectors.json` has what the Rust SDK does in a few hundred cases: turns, maps, searches, and
//! whole matches of the flood robot. The tests of each language's SDK read a copy of it.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use robot_flood::Flood;
use serde_json::{Value, json};
use wasmouse_core::maze::format::{self, Format};
use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions, Stop};
use wasmouse_sdk::{
    Action, Area, Cell, CellSet, Heading, Map, Pose, Random, Search, Turn, View, Wall,
};

use crate::matches::generated_mazes;

/// Where the copies are, below the folder with a folder for each language. Languages whose
/// template has none have no SDK.
const COPIES: [&str; 4] = [
    "go/testdata/vectors.json",
    "javascript/test/vectors.json",
    "python/tests/vectors.json",
    "typescript/test/vectors.json",
];

const TURNS: [Turn; 3] = [Turn::Left, Turn::Straight, Turn::Right];

/// All copies are what the SDK does now.
#[test]
fn every_language_has_the_vectors_of_the_sdk() {
    let expected = vectors();
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../example-robots/languages");
    let update = std::env::var_os("WASMOUSE_UPDATE_VECTORS").is_some();
    for copy in COPIES {
        let path = folder.join(copy);
        if update {
            fs::write(&path, &expected).expect("a template");
        }
        let found = fs::read_to_string(&path).expect("a template with vectors");
        assert!(
            found == expected,
            "{copy} is stale; write all copies with: WASMOUSE_UPDATE_VECTORS=1 cargo test \
             --workspace --test it languages::vectors"
        );
    }
}

fn vectors() -> String {
    let mazes = mazes();
    let sections = [
        ("turns", turns()),
        ("maps", mazes.iter().map(|it| map(it)).collect()),
        ("searches", searches(&mazes)),
        ("matches", mazes.iter().map(|it| match_of(it)).collect()),
    ];
    let mut text = "{\n".to_owned();
    for (index, (name, cases)) in sections.iter().enumerate() {
        let cases: Vec<String> = cases.iter().map(|it| format!("    {it}")).collect();
        let end = if index + 1 < sections.len() { "," } else { "" };
        let cases = cases.join(",\n");
        writeln!(text, "  \"{name}\": [\n{cases}\n  ]{end}").expect("writing to a string");
    }
    text.push_str("}\n");
    text
}

/// In the text format of the contest.
fn mazes() -> Vec<String> {
    let mut mazes = vec![MAZE_01.to_owned()];
    for spec in ["gen:tree:14:3", "gen:division:16:5"] {
        for (_, maze) in generated_mazes(spec) {
            mazes.push(format::print(&maze, Format::Udacity).expect("a contest maze"));
        }
    }
    mazes
}

/// The maze's columns from the left, each from the bottom up; a cell is the sum of its open
/// sides: 1 up, 2 right, 4 down, 8 left.
fn columns(maze: &str) -> Value {
    let column = |line: &str| -> Vec<u8> {
        let numbers = line.split(',').map(|it| it.trim().parse());
        numbers.collect::<Result<_, _>>().expect("numbers")
    };
    json!(maze.lines().skip(1).map(column).collect::<Vec<_>>())
}

fn turns() -> Vec<Value> {
    let mut cases = Vec::new();
    for from in Heading::ALL {
        for to in Heading::ALL {
            let turn = from.turn_to(to).map(turn_name);
            cases.push(json!({"from": heading_name(from), "to": heading_name(to), "turn": turn}));
        }
        for turn in TURNS {
            let after = heading_name(from.turned(turn));
            let turn = turn_name(turn);
            cases.push(json!({"from": heading_name(from), "turned": turn, "after": after}));
        }
    }
    cases
}

/// What a map knows after the first 20 readings of a match.
fn map(maze: &str) -> Value {
    let played = testing::play::<Flood>(maze, &PlayOptions::default());
    let dimension = dimension(maze);
    let mut map = Map::new(dimension);
    let mut observations = Vec::new();
    for &Stop {
        cell,
        heading,
        sensors,
        ..
    } in played.stops.iter().take(20)
    {
        let news = map.observe(Pose { cell, heading }, sensors);
        observations.push(json!({
            "x": cell.x, "y": cell.y, "heading": heading_name(heading),
            "sensors": [sensors.left, sensors.front, sensors.right],
            "opened": news.opened, "closed": news.closed,
        }));
    }
    let walls = |cell| -> String {
        let sides = Heading::ALL.map(|heading| match map.wall(cell, heading) {
            Wall::Unknown => '?',
            Wall::Open => '.',
            Wall::Closed => '#',
        });
        sides.into_iter().collect()
    };
    let column = |x| -> Vec<String> { (0..dimension).map(|y| walls(Cell::new(x, y))).collect() };
    let walls: Vec<_> = (0..dimension).map(column).collect();
    json!({"dimension": dimension, "observations": observations, "walls": walls})
}

fn searches(mazes: &[String]) -> Vec<Value> {
    let mut random = Random::new(13);
    let mut cases = Vec::new();
    for maze in mazes {
        for longest in [3, 1, 7] {
            cases.push(search(maze, longest, &mut random));
        }
    }
    cases
}

/// Steps to the goal from every cell, and from a random one only as far as is needed, with the
/// route.
fn search(maze: &str, longest: u32, random: &mut Random) -> Value {
    let dimension = dimension(maze);
    let map = whole_map(maze);
    let passages = map.passages(View::Pessimistic);
    let targets = CellSet::from(Area::center(dimension));
    let mut search = Search::new(dimension, longest);
    search.fill(passages, &targets);
    let all = steps(&search, dimension);
    let cell = Cell::new(random.below(dimension), random.below(dimension));
    let heading = Heading::ALL[random.below(4) as usize];
    search.fill_until(passages, &targets, cell);
    let route: Vec<_> = search.route(passages, Pose { cell, heading }).collect();
    let route: Vec<_> = route
        .iter()
        .map(|hop| json!([heading_name(hop.heading), hop.cells]))
        .collect();
    json!({
        "maze": columns(maze), "longest_move": longest, "steps": all,
        "from": {"x": cell.x, "y": cell.y, "heading": heading_name(heading)},
        "steps_until": steps(&search, dimension), "route": route,
    })
}

fn steps(search: &Search, dimension: u32) -> Vec<Vec<Option<u32>>> {
    let column = |x| {
        let cells = (0..dimension).map(|y| Cell::new(x, y));
        cells.map(|cell| search.steps(cell)).collect()
    };
    (0..dimension).map(column).collect()
}

fn whole_map(maze: &str) -> Map {
    let dimension = dimension(maze);
    let mut map = Map::new(dimension);
    for (x, line) in (0..).zip(maze.lines().skip(1)) {
        for (y, value) in (0..).zip(line.split(',')) {
            let value: u8 = value.trim().parse().expect("a number");
            for heading in Heading::ALL {
                let open = value >> (heading as u8) & 1 != 0;
                let wall = if open { Wall::Open } else { Wall::Closed };
                map.set(Cell::new(x, y), heading, wall);
            }
        }
    }
    map
}

/// A match of the flood robot: its actions as words, such as `R3` for a turn to the right and
/// three cells.
fn match_of(maze: &str) -> Value {
    let played = testing::play::<Flood>(maze, &PlayOptions::default());
    let actions: Vec<String> = played
        .stops
        .iter()
        .map(|stop| match stop.action {
            Action::Move(it) => {
                let turn = turn_name(it.turn)[..1].to_uppercase();
                format!("{turn}{}", it.advance)
            }
            Action::Reset => "reset".to_owned(),
        })
        .collect();
    let actions = actions.join(" ");
    json!({"maze": columns(maze), "summary": played.summary(), "actions": actions})
}

fn dimension(maze: &str) -> u32 {
    let first = maze.lines().next().expect("a line");
    first.trim().parse().expect("a number")
}

const fn heading_name(heading: Heading) -> &'static str {
    match heading {
        Heading::Up => "up",
        Heading::Right => "right",
        Heading::Down => "down",
        Heading::Left => "left",
    }
}

const fn turn_name(turn: Turn) -> &'static str {
    match turn {
        Turn::Left => "left",
        Turn::Straight => "straight",
        Turn::Right => "right",
    }
}
