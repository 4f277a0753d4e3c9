//! Drawings of one small maze, in every style.

use wasmouse_core::maze::{
    Area, Cell, Heading, Maze, Metric, distances_to_goal, format, shortest_path,
};

use super::drawing::cells;
use super::*;

/// A 4 x 4 maze with a wall of every shape and a free-standing post.
const SMALL: &str = "\
o---o---o---o---o
|           |   |
o   o   o   o   o
|     G   G     |
o   o---o   o   o
|   | G   G |   |
o   o---o---o   o
| S |           |
o---o---o---o---o
";

fn small() -> (Maze, Picture) {
    let maze = format::parse(SMALL).expect("a maze").maze;
    let picture = Picture::of(&maze);
    (maze, picture)
}

fn check(picture: &Picture, style: TextStyle, expected: &str) {
    let text = picture.to_text(style);
    assert_eq!(text, expected.trim_start_matches('\n'), "\n{text}");
}

#[test]
fn ascii_looks_like_the_competition_format() {
    let (_, picture) = small();
    check(&picture, TextStyle::ASCII, SMALL);
}

#[test]
fn unicode_joins_walls_at_posts() {
    let (_, picture) = small();
    check(
        &picture,
        TextStyle::UNICODE,
        "
┌───────────┬───┐
│           │   │
│           ╵   │
│     G   G     │
│   ┌───╴   ╷   │
│   │ G   G │   │
│   ├───────┘   │
│ S │           │
└───┴───────────┘
",
    );
}

#[test]
fn a_path_shows_where_steps_end() {
    let (maze, mut picture) = small();
    picture.set_path(&shortest_path(&maze, Metric::STEPS).expect("solvable"));
    picture.set_robot(Cell::new(3, 0), Heading::Left);
    check(
        &picture,
        TextStyle::UNICODE,
        "
┌───────────┬───┐
│           │   │
│           ╵   │
│ ●   ●   G     │
│   ┌───╴   ╷   │
│ ○ │ G   G │   │
│   ├───────┘   │
│ S │         ◀ │
└───┴───────────┘
",
    );
    check(
        &picture,
        TextStyle::ASCII,
        "
o---o---o---o---o
|           |   |
o   o   o   o   o
| *   *   G     |
o   o---o   o   o
| + | G   G |   |
o   o---o---o   o
| S |         < |
o---o---o---o---o
",
    );
}

#[test]
fn numbers_make_cells_as_wide_as_they_need() {
    let (maze, mut picture) = small();
    picture.set_numbers(&distances_to_goal(&maze, Metric::Cells));
    picture.mark_mut(Cell::new(3, 3)).expect("inside").number = Some(1234);
    check(
        &picture,
        TextStyle::ASCII,
        "
o----o----o----o----o
| 2    1    1  |1234|
o    o    o    o    o
| 1    G0   G0   1  |
o    o----o    o    o
| 2  | G0   G0 | 2  |
o    o----o----o    o
| S3 | 5    4    3  |
o----o----o----o----o
",
    );
}

#[test]
fn heat_is_visible_without_colours() {
    let (maze, mut picture) = small();
    picture.set_heat(&distances_to_goal(&maze, Metric::Cells));
    check(
        &picture,
        TextStyle::UNICODE,
        "
┌───────────┬───┐
│▒▒▒ ░░░ ░░░│▒▒▒│
│           ╵   │
│░░░  G   G  ░░░│
│   ┌───╴   ╷   │
│▒▒▒│ G   G │▒▒▒│
│   ├───────┘   │
│▓S▓│███ ███ ▓▓▓│
└───┴───────────┘
",
    );
    check(
        &picture,
        TextStyle::ASCII,
        "
o---o---o---o---o
|=== ::: :::|===|
o   o   o   o   o
|:::  G   G  :::|
o   o---o   o   o
|===| G   G |===|
o   o---o---o   o
|%S%|### ### %%%|
o---o---o---o---o
",
    );
}

#[test]
fn colours_only_add_to_the_characters() {
    let (maze, mut picture) = small();
    picture.set_heat(&distances_to_goal(&maze, Metric::STEPS));
    picture.set_path(&shortest_path(&maze, Metric::STEPS).expect("solvable"));
    for charset in [Charset::Unicode, Charset::Ascii] {
        let plain = picture.to_text(TextStyle {
            charset,
            color: false,
        });
        let colored = picture.to_text(TextStyle {
            charset,
            color: true,
        });
        assert!(!plain.contains('\u{1b}') && colored.contains('\u{1b}'));
        let mut stripped = String::new();
        for part in colored.split('\u{1b}') {
            // The first part has no escape sequence, and no `m` in front of walls.
            let after = part.strip_prefix('[').and_then(|part| part.split_once('m'));
            stripped.push_str(after.map_or(part, |(_, text)| text));
        }
        assert_eq!(stripped, plain);
    }
}

/// What a robot knows after a look around from the start.
fn partial() -> Picture {
    let goal = Area::center(4);
    let mut picture = Picture::unknown(4, Cell::new(0, 0), goal);
    picture.set_robot(Cell::new(0, 0), Heading::Up);
    picture.set_wall(Cell::new(0, 0), Heading::Right, Wall::Closed);
    for y in 0..3 {
        picture.set_wall(Cell::new(0, y), Heading::Up, Wall::Open);
    }
    picture.set_wall(Cell::new(1, 2), Heading::Down, Wall::Closed);
    picture
}

#[test]
fn unknown_walls_and_cells_are_dots() {
    check(
        &partial(),
        TextStyle::UNICODE,
        "
┌───────────────┐
│   · · · · · · │
│   · · · · · · │
│   · G · G · · │
│   ╶───╴ · · · │
│   · G · G · · │
│   ╷ · · · · · │
│ ▲ │   · · · · │
└───┴───────────┘
",
    );
    check(
        &partial(),
        TextStyle::ASCII,
        "
o---o---o---o---o
|   . . . . . . |
o   . . . . . . o
|   . G . G . . |
o   o---o . . . o
|   . G . G . . |
o   o . . . . . o
| ^ |   . . . . |
o---o---o---o---o
",
    );
}

#[test]
fn labels_and_titles_are_untrusted() {
    let mut picture = partial();
    let texts = [
        "<b>&\"",
        "\u{1b}[2J",
        "\u{202e}",
        "日本",
        "too long to show",
    ];
    for (y, text) in texts.into_iter().enumerate() {
        let cell = Cell::new(3, u8::try_from(y).expect("few"));
        if let Some(mark) = picture.mark_mut(cell) {
            mark.label = Label::new(text);
        }
    }
    for (x, paint) in Paint::ALL.into_iter().enumerate().take(3) {
        let cell = Cell::new(u8::try_from(x).expect("few"), 2);
        picture.mark_mut(cell).expect("inside").paint = Some(paint);
    }
    picture.set_title("</title><script>\u{1b}");
    check(
        &picture,
        TextStyle::UNICODE,
        "
┌───────────────────────┐
│     ·  ·  ·  ·  · ��  │
│     · · · · · · · · · │
│  r  · G:o · G:y ·  �  │
│     ╶─────╴ · · · · · │
│     ·  G  ·  G  ·�[2J │
│     ╷ · · · · · · · · │
│  ▲  │     ·  ·  ·<b>&\"│
└─────┴─────────────────┘
",
    );
    check(
        &picture,
        TextStyle::ASCII,
        "
o-----o-----o-----o-----o
|     .  .  .  .  . ??  |
o     . . . . . . . . . o
|  r  . G:o . G:y .  ?  |
o     o-----o . . . . . o
|     .  G  .  G  .?[2J |
o     o . . . . . . . . o
|  ^  |     .  .  .<b>&\"|
o-----o-----o-----o-----o
",
    );
    let svg = picture.to_svg();
    assert!(svg.contains("<title>&lt;/title&gt;&lt;script&gt;\u{fffd}</title>"));
    assert!(svg.contains(">&lt;b&gt;&amp;&quot;</text>"));
    assert!(svg.contains("<title>orange</title>"));
    assert!(!svg.contains(['\u{1b}', '\u{202e}']) && !svg.contains("<script"));
}

#[test]
fn what_lies_outside_is_ignored() {
    let mut picture = partial();
    let before = picture.to_text(TextStyle::UNICODE);
    let outside = [Cell::new(4, 0), Cell::new(0, 4), Cell::new(255, 255)];
    for cell in outside {
        assert_eq!(picture.mark_mut(cell), None);
        for side in Heading::ALL {
            picture.set_wall(cell, side, Wall::Open);
        }
    }
    picture.set_wall(Cell::new(0, 0), Heading::Left, Wall::Open);
    picture.set_stops(&outside);
    assert_eq!(picture.to_text(TextStyle::UNICODE), before);
    picture.set_robot(Cell::new(9, 9), Heading::Up);
    assert!(!picture.to_svg().contains("class=\"maze-robot\""));
}

#[test]
fn svg_has_a_title_and_a_description() {
    let (maze, mut picture) = small();
    picture.set_title("small");
    picture.set_path(&shortest_path(&maze, Metric::STEPS).expect("solvable"));
    picture.set_robot(maze.start(), Heading::Up);
    let svg = picture.to_svg();
    assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 92 92\""));
    assert!(svg.contains("<title>small</title>"));
    let description = "<desc>4 x 4 cells, start (0, 0), path of 2 steps to (1, 2), \
                       robot at (0, 0) heading up</desc>";
    assert!(svg.contains(description), "{svg}");
    assert!(svg.contains("points=\"16,76 16,36 36,36\""), "{svg}");
    assert!(svg.ends_with("</svg>\n"));
}

#[test]
fn extreme_numbers_are_drawn() {
    let (_, mut picture) = small();
    for cell in cells(4) {
        let mark = picture.mark_mut(cell).expect("inside");
        mark.heat = Some(u32::MAX);
        mark.number = Some(u32::MAX);
    }
    assert!(picture.to_text(TextStyle::UNICODE).contains("4294967295"));
    assert!(picture.to_svg().contains("stroke-opacity=\".70\""));
}
