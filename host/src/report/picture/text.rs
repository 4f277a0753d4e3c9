//! Pictures as text: Unicode box drawing or plain ASCII, with or without colour.
//!
//! Two rows of text per row of cells. All cells of a picture are equally wide,
//! 3 columns or as many as the longest content needs. The ASCII picture of a
//! maze has the posts and walls of the competition format.
//!
//! | shown          | Unicode           | ASCII         |
//! |----------------|-------------------|---------------|
//! | end of a step  | `●`               | `*`           |
//! | driven through | `○`               | `+`           |
//! | robot          | `▲ ▶ ▼ ◀`         | `^ > v <`     |
//! | unknown        | `·`               | `.`           |
//! | heat, rising   | ` `, `░ ▒ ▓ █`    | ` `, `: = % #`|
//!
//! `S` is the start and `G` a goal cell. Paint is the letter of its colour, after
//! a colon when the cell has other content.

use wasmouse_core::maze::{Cell, Heading};

use super::drawing::{Picture, Wall, cells};
use super::paint::Paint;

/// Which characters a picture is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Charset {
    /// Box drawing characters, one column wide each.
    Unicode,
    /// Characters that every terminal and font has.
    Ascii,
}

/// How a picture is drawn as text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextStyle {
    /// The characters.
    pub charset: Charset,
    /// Whether to add ANSI colours. They repeat what the characters say.
    pub color: bool,
}

impl TextStyle {
    /// Box drawing without colours.
    pub const UNICODE: Self = Self {
        charset: Charset::Unicode,
        color: false,
    };

    /// ASCII without colours.
    pub const ASCII: Self = Self {
        charset: Charset::Ascii,
        color: false,
    };
}

/// The narrowest cell, in columns.
const WIDTH_MIN: usize = 3;

/// Levels of heat above cold, one character each.
const HEAT_LEVELS: u32 = 4;

/// Colours of the path and the robot in the 256-colour table, and of heat by level.
const PATH_ANSI: u8 = 35;
const ROBOT_ANSI: u8 = 199;
const HEAT_ANSI: [u8; HEAT_LEVELS as usize + 1] = [25, 31, 178, 208, 196];

impl Picture {
    /// The picture as lines of text, each with a line feed.
    ///
    /// Labels keep only characters that surely are one column wide; others
    /// become `?` in ASCII and U+FFFD in Unicode.
    pub fn to_text(&self, style: TextStyle) -> String {
        Canvas::new(self, style).draw()
    }
}

/// What stands in a cell: who or what is there, and what is written there.
struct Content {
    text: String,
    /// A colour for the text, in the 256-colour table.
    ansi: Option<u8>,
}

/// A picture while it is turned into text.
struct Canvas<'a> {
    picture: &'a Picture,
    style: TextStyle,
    glyphs: &'static Glyphs,
    /// By cell index; the columns of a cell fit the longest.
    contents: Vec<Content>,
    width: usize,
}

impl<'a> Canvas<'a> {
    fn new(picture: &'a Picture, style: TextStyle) -> Self {
        let glyphs = match style.charset {
            Charset::Unicode => &Glyphs::UNICODE,
            Charset::Ascii => &Glyphs::ASCII,
        };
        let contents = contents(picture, style.charset, glyphs);
        let longest = contents.iter().map(|content| content.text.chars().count());
        // Heat fills what the content leaves, so it needs a column on each side.
        let has_heat = picture.marks.iter().any(|mark| mark.heat.is_some());
        let room = if has_heat { 2 } else { 0 };
        Self {
            picture,
            style,
            glyphs,
            width: WIDTH_MIN.max(longest.max().unwrap_or(0) + room),
            contents,
        }
    }

    fn draw(&self) -> String {
        let mut text = String::new();
        for y in (0..self.picture.dimension).rev() {
            self.wall_row(y + 1, &mut text);
            self.cell_row(y, &mut text);
        }
        self.wall_row(0, &mut text);
        text
    }

    /// The walls below row `y` of cells, which may be one above the last.
    fn wall_row(&self, y: u8, text: &mut String) {
        for x in 0..self.picture.dimension {
            text.push(self.post(x, y));
            let wall = self.wall_below(Cell::new(x, y));
            match wall {
                Wall::Open => text.extend(std::iter::repeat_n(' ', self.width)),
                Wall::Closed => text.extend(std::iter::repeat_n(self.glyphs.level, self.width)),
                Wall::Unknown => text.extend((0..self.width).map(|column| match column % 2 {
                    0 => ' ',
                    _ => self.glyphs.unknown,
                })),
            }
        }
        text.push(self.post(self.picture.dimension, y));
        text.push('\n');
    }

    fn cell_row(&self, y: u8, text: &mut String) {
        for x in 0..self.picture.dimension {
            text.push(self.upright(self.wall_left(Cell::new(x, y))));
            self.cell(Cell::new(x, y), text);
        }
        text.push(self.upright(Wall::Closed));
        text.push('\n');
    }

    fn cell(&self, cell: Cell, text: &mut String) {
        let index = self.picture.index(cell).expect("the cells of the picture");
        let Content {
            text: content,
            ansi,
        } = &self.contents[index];
        let spare = self.width - content.chars().count();
        let heat = self.picture.heat_level(cell, HEAT_LEVELS);
        let level = heat.map_or(0, |level| level as usize);
        let shade = |columns| self.glyphs.heat[level].to_string().repeat(columns);
        let heat_ansi = heat.map(|_| HEAT_ANSI[level]);
        let left = spare / 2;
        self.colored(&shade(left), heat_ansi, text);
        self.colored(content, *ansi, text);
        self.colored(&shade(spare - left), heat_ansi, text);
    }

    /// Writes `part`, in a colour if it has one and colours are wanted.
    fn colored(&self, part: &str, ansi: Option<u8>, text: &mut String) {
        match ansi {
            Some(ansi) if self.style.color && !part.trim().is_empty() => {
                text.push_str(&format!("\u{1b}[1;38;5;{ansi}m{part}\u{1b}[0m"));
            }
            _ => text.push_str(part),
        }
    }

    const fn upright(&self, wall: Wall) -> char {
        match wall {
            Wall::Open => ' ',
            Wall::Closed => self.glyphs.upright,
            Wall::Unknown => self.glyphs.unknown,
        }
    }

    /// The post at the lower left of cell (x, y), which may be one past the last.
    fn post(&self, x: u8, y: u8) -> char {
        let n = self.picture.dimension;
        let arms = [
            (y < n).then(|| self.wall_left(Cell::new(x, y))),
            (x < n).then(|| self.wall_below(Cell::new(x, y))),
            (y > 0).then(|| self.wall_left(Cell::new(x, y - 1))),
            (x > 0).then(|| self.wall_below(Cell::new(x - 1, y))),
        ];
        let has = |wall| arms.contains(&Some(wall));
        if !has(Wall::Closed) && has(Wall::Unknown) {
            return self.glyphs.unknown;
        }
        let bit = |place: usize| usize::from(arms[place] == Some(Wall::Closed)) << place;
        self.glyphs.posts[bit(0) | bit(1) | bit(2) | bit(3)]
    }

    /// The wall to the left of a cell, which may be one past the last column.
    fn wall_left(&self, cell: Cell) -> Wall {
        match cell.step(Heading::Left) {
            Some(left) => self.picture.wall(left, Heading::Right),
            None => Wall::Closed,
        }
    }

    /// The wall below a cell, which may be one above the last row.
    fn wall_below(&self, cell: Cell) -> Wall {
        match cell.step(Heading::Down) {
            Some(below) => self.picture.wall(below, Heading::Up),
            None => Wall::Closed,
        }
    }
}

/// What stands in each cell, by cell index.
fn contents(picture: &Picture, charset: Charset, glyphs: &Glyphs) -> Vec<Content> {
    let trail = glyphs_of_path(picture, glyphs);
    cells(picture.dimension)
        .zip(trail)
        .map(|(cell, path)| content(picture, charset, glyphs, cell, path))
        .collect()
}

fn content(
    picture: &Picture,
    charset: Charset,
    glyphs: &Glyphs,
    cell: Cell,
    path: Option<char>,
) -> Content {
    let mark = picture.mark(cell);
    let robot = picture.robot.filter(|&(at, _)| at == cell);
    let is_start = (cell == picture.start).then_some('S');
    let is_goal = picture.goal.contains(cell).then_some('G');
    let who = match robot {
        Some((_, heading)) => Some(glyphs.robot[heading as usize]),
        None => is_start.or(path).or(is_goal),
    };
    let mut text = String::from_iter(who);
    match mark.number {
        _ if !mark.label.is_empty() => {
            text.extend(mark.label.as_str().chars().map(|c| narrow(c, charset)));
        }
        Some(number) => text.push_str(&number.to_string()),
        None => {}
    }
    if let Some(paint) = mark.paint {
        if !text.is_empty() {
            text.push(':');
        }
        text.push(paint.letter());
    }
    if text.is_empty() && mark.heat.is_none() && picture.is_unknown(cell) {
        text.push(glyphs.unknown);
    }
    let path_ansi = path.map(|_| PATH_ANSI);
    let ansi = robot.map(|_| ROBOT_ANSI).or(path_ansi);
    Content {
        text,
        ansi: mark.paint.map(Paint::ansi).or(ansi),
    }
}

/// By cell index: how the path shows in the cell. A cell where any step ends
/// shows that end.
fn glyphs_of_path(picture: &Picture, glyphs: &Glyphs) -> Vec<Option<char>> {
    let mut shown = vec![None; picture.marks.len()];
    for pair in picture.stops.windows(2) {
        for cell in straight(pair[0], pair[1]) {
            let index = picture
                .index(cell)
                .expect("between two cells of the picture");
            shown[index] = Some(glyphs.passed);
        }
    }
    for &stop in &picture.stops {
        let index = picture.index(stop).expect("stops lie in the picture");
        shown[index] = Some(glyphs.stop);
    }
    shown
}

/// The cells between two in a row or column; none for two that are in neither.
fn straight(from: Cell, to: Cell) -> Vec<Cell> {
    let between = |a: u8, b: u8| a.min(b)..a.max(b);
    if from.x == to.x {
        between(from.y, to.y)
            .map(|y| Cell::new(from.x, y))
            .collect()
    } else if from.y == to.y {
        between(from.x, to.x)
            .map(|x| Cell::new(x, from.y))
            .collect()
    } else {
        Vec::new()
    }
}

/// The character itself if it surely is one column wide in that charset: Latin,
/// Greek and Cyrillic without combining marks.
const fn narrow(character: char, charset: Charset) -> char {
    match (character, charset) {
        (' '..='~', _) => character,
        (_, Charset::Ascii) => '?',
        ('\u{300}'..='\u{36f}' | '\u{483}'..='\u{489}', _) => char::REPLACEMENT_CHARACTER,
        ('\u{a1}'..='\u{52f}', _) => character,
        _ => char::REPLACEMENT_CHARACTER,
    }
}

/// The characters of one charset.
struct Glyphs {
    level: char,
    upright: char,
    unknown: char,
    stop: char,
    passed: char,
    /// By heading.
    robot: [char; 4],
    /// By level, cold first.
    heat: [char; HEAT_LEVELS as usize + 1],
    /// By the arms of the post: 1 up, 2 right, 4 down, 8 left.
    posts: [char; 16],
}

impl Glyphs {
    const UNICODE: Self = Self {
        level: '─',
        upright: '│',
        unknown: '·',
        stop: '●',
        passed: '○',
        robot: ['▲', '▶', '▼', '◀'],
        heat: [' ', '░', '▒', '▓', '█'],
        posts: [
            ' ', '╵', '╶', '└', '╷', '│', '┌', '├', '╴', '┘', '─', '┴', '┐', '┤', '┬', '┼',
        ],
    };

    const ASCII: Self = Self {
        level: '-',
        upright: '|',
        unknown: '.',
        stop: '*',
        passed: '+',
        robot: ['^', '>', 'v', '<'],
        heat: [' ', ':', '=', '%', '#'],
        posts: ['o'; 16],
    };
}
