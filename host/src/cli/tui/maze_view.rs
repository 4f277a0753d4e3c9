//! [`draw_maze`]: a scene, in the cells of a terminal.
//!
//! At medium and large size, walls are lines between posts, and a cell has room for a few
//! characters. At small size a cell is one character with its floor under it, then its right wall:
//! a floor under other content is underlined. What is said by a background colour is said by
//! a character as well.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use wasmouse_core::maze::{Cell, Heading};

use super::camera::{Viewport, Zoom};
use super::glyphs::Glyphs;
use super::look::{Look, Role};
use super::plain::{plain, width};
use super::scene::{Mark, Scene, Step};
use crate::report::picture::Wall;

/// Draws the part of a scene that a viewport shows.
pub fn draw_maze(scene: &Scene, view: &Viewport, look: Look, buffer: &mut Buffer) {
    let canvas = Canvas {
        scene,
        view,
        look,
        glyphs: Glyphs::of(look.charset),
    };
    if view.zoom == Zoom::Small {
        canvas.draw_small(buffer);
    } else {
        canvas.draw_walls(buffer);
        canvas.draw_contents(buffer);
    }
}

struct Canvas<'a> {
    scene: &'a Scene,
    view: &'a Viewport,
    look: Look,
    glyphs: &'static Glyphs,
}

/// Something in a cell, with what it is there for.
type Drawn = (char, Role);

impl Canvas<'_> {
    /// Puts a character at columns and rows of the maze, if that place is on the screen.
    fn put(&self, buffer: &mut Buffer, column: u16, row: u16, (character, style): (char, Style)) {
        let (left, top) = self.view.corner;
        let area = self.view.area;
        let (Some(x), Some(y)) = (column.checked_sub(left), row.checked_sub(top)) else {
            return;
        };
        if x < area.width
            && y < area.height
            && let Some(cell) = buffer.cell_mut((area.x + x, area.y + y))
        {
            cell.set_char(character).set_style(style);
        }
    }

    /// The columns and rows of the maze that are on the screen.
    fn places(&self) -> impl Iterator<Item = (u16, u16)> + use<> {
        let ((left, top), area) = (self.view.corner, self.view.area);
        let rows = top..top + area.height;
        rows.flat_map(move |row| (left..left + area.width).map(move |column| (column, row)))
    }

    fn draw_walls(&self, buffer: &mut Buffer) {
        let (pitch_x, pitch_y) = self.view.zoom.pitch();
        for (column, row) in self.places() {
            let (x, y) = (column / pitch_x, row / pitch_y);
            let (in_x, in_y) = (column % pitch_x, row % pitch_y);
            let drawn = match (in_x, in_y) {
                (0, 0) => self.post(x, y),
                (0, _) => self.upright(self.wall_left(x, y)),
                (_, 0) => match self.wall_above(x, y) {
                    Wall::Open => (' ', Role::Plain),
                    Wall::Closed => (self.glyphs.level, Role::Plain),
                    Wall::Unknown if in_x % 2 == 1 => (' ', Role::Plain),
                    Wall::Unknown => (self.glyphs.unknown, Role::Faint),
                },
                _ => continue,
            };
            let style = self.look.style(drawn.1);
            self.put(buffer, column, row, (drawn.0, style));
        }
    }

    fn upright(&self, wall: Wall) -> Drawn {
        match wall {
            Wall::Open => (' ', Role::Plain),
            Wall::Closed => (self.glyphs.upright, Role::Plain),
            Wall::Unknown => (self.glyphs.unknown, Role::Faint),
        }
    }

    /// The cell in a column of the maze and a row counted from the top.
    fn cell(&self, x: u16, from_top: u16) -> Option<Cell> {
        let n = u16::from(self.scene.dimension);
        let y = n.checked_sub(from_top + 1)?;
        let inside = x < n;
        inside.then(|| Some(Cell::new(u8::try_from(x).ok()?, u8::try_from(y).ok()?)))?
    }

    /// The wall to the left of a cell, which may be one past the last column.
    fn wall_left(&self, x: u16, from_top: u16) -> Wall {
        let cell = self.cell(x, from_top);
        cell.map_or(Wall::Closed, |cell| self.scene.wall(cell, Heading::Left))
    }

    /// The wall above a cell, which may be one below the last row.
    fn wall_above(&self, x: u16, from_top: u16) -> Wall {
        let cell = self.cell(x, from_top);
        cell.map_or(Wall::Closed, |cell| self.scene.wall(cell, Heading::Up))
    }

    /// The post at the upper left of a cell, which may be one past the last row and column.
    fn post(&self, x: u16, from_top: u16) -> Drawn {
        let n = u16::from(self.scene.dimension);
        let arms = [
            (from_top > 0).then(|| self.wall_left(x, from_top.saturating_sub(1))),
            (x < n).then(|| self.wall_above(x, from_top)),
            (from_top < n).then(|| self.wall_left(x, from_top)),
            (x > 0).then(|| self.wall_above(x.saturating_sub(1), from_top)),
        ];
        let has = |wall| arms.contains(&Some(wall));
        if !has(Wall::Closed) && has(Wall::Unknown) {
            return (self.glyphs.unknown, Role::Faint);
        }
        let bit = |place: usize| usize::from(arms[place] == Some(Wall::Closed)) << place;
        let post = self.glyphs.posts[bit(0) | bit(1) | bit(2) | bit(3)];
        (post, Role::Plain)
    }

    fn draw_contents(&self, buffer: &mut Buffer) {
        let (pitch_x, pitch_y) = self.view.zoom.pitch();
        let ((left, top), area) = (self.view.corner, self.view.area);
        for from_top in top / pitch_y..=(top + area.height) / pitch_y {
            for x in left / pitch_x..=(left + area.width) / pitch_x {
                if let Some(cell) = self.cell(x, from_top) {
                    let place = Rect {
                        x: x * pitch_x + 1,
                        y: from_top * pitch_y + 1,
                        width: pitch_x - 1,
                        height: pitch_y - 1,
                    };
                    self.draw_content(cell, place, buffer);
                }
            }
        }
    }

    /// Draws what is in a cell into a place of the maze.
    fn draw_content(&self, cell: Cell, place: Rect, buffer: &mut Buffer) {
        let mark = self.scene.mark(cell);
        let background = self.background(cell, mark);
        let shade = (self.shade(mark).unwrap_or(' '), background);
        for row in place.y..place.bottom() {
            for column in place.x..place.right() {
                self.put(buffer, column, row, shade);
            }
        }
        let who = self.who(cell, mark);
        let who_style = who.map(|(_, role)| self.on_background(mark, background, role));
        let columns = usize::from(place.width);
        // The letter of the colour is in the last column, which no other content gets.
        let letter = mark.paint.map(|paint| (paint.letter(), background));
        if let Some(letter) = letter {
            self.put(buffer, place.right() - 1, place.y, letter);
        }
        let room = columns - usize::from(letter.is_some());
        let written = self.written(mark, room);
        let (first, second) = match place.height {
            1 => (columns, columns),
            _ => (room, columns),
        };
        let middle = |columns: usize, used: usize| {
            u16::try_from((columns - used.min(columns)) / 2).expect("a few columns")
        };
        if place.height == 1 {
            let used = usize::from(who.is_some());
            let text = first_columns(&written, room - used.min(room));
            // With a letter there is no room to centre anything.
            let at = place.x + middle(if letter.is_some() { 0 } else { first }, used + width(text));
            let mut at = self.put_who(buffer, (at, place.y), who, who_style);
            at = self.put_text(buffer, (at, place.y), text, background);
            debug_assert!(at <= place.right());
        } else {
            let at = place.x + middle(first, usize::from(who.is_some()));
            self.put_who(buffer, (at, place.y), who, who_style);
            let text = first_columns(&written, second);
            let at = place.x + middle(second, width(text));
            self.put_text(buffer, (at, place.y + 1), text, background);
        }
    }

    fn put_who(
        &self,
        buffer: &mut Buffer,
        (column, row): (u16, u16),
        who: Option<Drawn>,
        style: Option<Style>,
    ) -> u16 {
        let (Some((character, _)), Some(style)) = (who, style) else {
            return column;
        };
        self.put(buffer, column, row, (character, style));
        column + 1
    }

    /// Writes characters that are one or two columns wide, and returns the next column.
    fn put_text(
        &self,
        buffer: &mut Buffer,
        (mut column, row): (u16, u16),
        text: &str,
        style: Style,
    ) -> u16 {
        for character in text.chars() {
            self.put(buffer, column, row, (character, style));
            let columns = width(character.encode_utf8(&mut [0; 4]));
            column += u16::try_from(columns).expect("one or two");
        }
        column
    }

    /// The label of a cell, or its number. What is wider than the room for it is cut.
    fn written(&self, mark: &Mark, room: usize) -> String {
        if !mark.label.is_empty() {
            return plain(mark.label.as_str(), self.look.charset);
        }
        match mark.number {
            // A number that is cut would be another number.
            Some(number) if number.to_string().len() <= room => number.to_string(),
            _ => String::new(),
        }
    }

    /// Who or what is in the cell.
    fn who(&self, cell: Cell, mark: &Mark) -> Option<Drawn> {
        if let Some((_, heading)) = self.scene.robot.filter(|&(at, _)| at == cell) {
            return Some((self.glyphs.robot[heading as usize], Role::Robot));
        }
        if mark.flagged {
            return Some(('!', Role::Bad));
        }
        if cell == self.scene.start {
            return Some(('S', Role::Strong));
        }
        let place = |step: Step| usize::from(step == Step::Through);
        if let Some(step) = mark.path {
            return Some((self.glyphs.path[place(step)], Role::Path));
        }
        if let Some(step) = mark.optimum {
            return Some((self.glyphs.optimum[place(step)], Role::Optimum));
        }
        if self.scene.goal.contains(cell) {
            return Some(('G', Role::Strong));
        }
        let is_bare = mark.label.is_empty() && mark.number.is_none() && mark.heat.is_none();
        (is_bare && self.is_unknown(cell)).then_some((self.glyphs.unknown, Role::Faint))
    }

    /// Whether nobody has looked at any side of the cell.
    fn is_unknown(&self, cell: Cell) -> bool {
        let mut sides = Heading::ALL.into_iter();
        let wall = |side| self.scene.wall(cell, side);
        // The perimeter is closed whoever looks.
        sides.all(|side| wall(side) == Wall::Unknown || self.is_perimeter(cell, side))
    }

    fn is_perimeter(&self, cell: Cell, side: Heading) -> bool {
        let last = self.scene.dimension - 1;
        match side {
            Heading::Up => cell.y == last,
            Heading::Right => cell.x == last,
            Heading::Down => cell.y == 0,
            Heading::Left => cell.x == 0,
        }
    }

    fn background(&self, cell: Cell, mark: &Mark) -> Style {
        let role = match (mark.paint, mark.heat) {
            (Some(paint), _) if !self.is_small() => Role::Paint(paint),
            (_, Some(level)) => Role::Heat(level),
            _ => Role::Plain,
        };
        let style = self.look.style(role);
        if self.scene.cursor == Some(cell) {
            style.patch(self.look.style(Role::Cursor))
        } else {
            style
        }
    }

    /// The style of something on the background of its cell: a colour would be hard to see on
    /// another, so there the robot is reversed and everything else as the text.
    fn on_background(&self, mark: &Mark, background: Style, role: Role) -> Style {
        let is_painted = mark.paint.is_some() && !self.is_small();
        let is_filled = self.look.color && (is_painted || mark.heat.is_some());
        match role {
            _ if !is_filled => background.patch(self.look.style(role)),
            Role::Robot => background.add_modifier(Modifier::REVERSED | Modifier::BOLD),
            Role::Plain | Role::Faint | Role::Ink(_) => background,
            _ => background.add_modifier(Modifier::BOLD),
        }
    }

    fn is_small(&self) -> bool {
        self.view.zoom == Zoom::Small
    }

    /// The character that stands for the heat of a cell where nothing else is.
    fn shade(&self, mark: &Mark) -> Option<char> {
        // On a background of that colour it would only be in the way.
        let level = mark.heat.filter(|_| !self.look.color)?;
        self.glyphs.heat.get(usize::from(level)).copied()
    }

    fn draw_small(&self, buffer: &mut Buffer) {
        for (column, row) in self.places() {
            let (x, is_wall) = (column.saturating_sub(1) / 2, column.is_multiple_of(2));
            let (character, style) = match (row.checked_sub(1), column, is_wall) {
                // The lid of the maze: the floor of a row above the first.
                (None, _, true) => (' ', Style::new()),
                (None, _, false) => (self.glyphs.floor, Style::new()),
                (Some(_), 0, _) => (self.glyphs.upright, Style::new()),
                (Some(from_top), _, is_wall) => {
                    let Some(cell) = self.cell(x, from_top) else {
                        continue;
                    };
                    if is_wall {
                        self.small_wall(cell)
                    } else {
                        self.small_content(cell)
                    }
                }
            };
            self.put(buffer, column, row, (character, style));
        }
    }

    /// The column to the right of a small cell: its right wall, or more of its floor.
    fn small_wall(&self, cell: Cell) -> (char, Style) {
        let background = self.background(cell, self.scene.mark(cell));
        let faint = background.patch(self.look.style(Role::Faint));
        match self.scene.wall(cell, Heading::Right) {
            Wall::Closed => (self.glyphs.upright, background),
            Wall::Unknown => (self.glyphs.unknown_upright, faint),
            Wall::Open => match self.scene.wall(cell, Heading::Down) {
                Wall::Closed => (self.glyphs.floor, background),
                Wall::Open | Wall::Unknown => (' ', background),
            },
        }
    }

    /// A small cell: one character, with the floor under it.
    fn small_content(&self, cell: Cell) -> (char, Style) {
        let mark = self.scene.mark(cell);
        let background = self.background(cell, mark);
        let floor = self.scene.wall(cell, Heading::Down);
        let written = || self.written(mark, 1).chars().next();
        // Filled cells without lines between them would hide where the walls are.
        let ink = mark.paint.map_or(Role::Plain, Role::Ink);
        let letter = mark.paint.map(|paint| (paint.letter(), ink));
        let content = self
            .who(cell, mark)
            .filter(|&(_, role)| role != Role::Faint)
            .or_else(|| written().map(|it| (one_column(it), ink)))
            .or(letter)
            .or_else(|| self.shade(mark).map(|shade| (shade, Role::Plain)));
        match (content, floor) {
            (Some((character, role)), floor) => {
                let style = self.on_background(mark, background, role);
                let underlined = floor == Wall::Closed;
                let style = if underlined {
                    style.add_modifier(Modifier::UNDERLINED)
                } else {
                    style
                };
                (character, style)
            }
            (None, Wall::Closed) => (self.glyphs.floor, background),
            (None, Wall::Open) => (' ', background),
            (None, Wall::Unknown) => (
                self.glyphs.unknown,
                background.patch(self.look.style(Role::Faint)),
            ),
        }
    }
}

/// The beginning of a text that fits into that many columns.
fn first_columns(text: &str, columns: usize) -> &str {
    let mut used = 0;
    for (at, character) in text.char_indices() {
        used += width(character.encode_utf8(&mut [0; 4]));
        if used > columns {
            return &text[..at];
        }
    }
    text
}

/// The character, unless it needs two columns.
fn one_column(character: char) -> char {
    if width(character.encode_utf8(&mut [0; 4])) == 1 {
        character
    } else {
        char::REPLACEMENT_CHARACTER
    }
}

#[cfg(test)]
mod tests {
    use wasmouse_core::maze::{Maze, Metric, Walls, shortest_path};

    use super::super::camera::Camera;
    use super::super::testing::text_of;
    use super::*;
    use crate::report::picture::{Charset, Label, Paint};

    const PLAIN: Look = Look {
        charset: Charset::Unicode,
        color: false,
    };
    const ASCII: Look = Look {
        charset: Charset::Ascii,
        color: false,
    };

    /// A scene with everything in it.
    fn scene() -> Scene {
        let mut walls = Walls::open(6);
        for (x, y, side) in [
            (0, 0, Heading::Right),
            (1, 2, Heading::Up),
            (2, 2, Heading::Left),
            (4, 4, Heading::Down),
            (4, 3, Heading::Left),
        ] {
            walls.set(Cell::new(x, y), side, false);
        }
        let maze = Maze::contest(walls).expect("start and goal fit");
        let mut scene = Scene::new(&maze, |cell, side| match cell.x + cell.y {
            8.. => Wall::Unknown,
            _ if maze.walls().is_open(cell, side) => Wall::Open,
            _ => Wall::Closed,
        });
        let path = shortest_path(&maze, Metric::STEPS).expect("a path");
        scene.set_path(path.stops());
        scene.set_optimum(&[Cell::new(5, 0), Cell::new(2, 0)]);
        scene.robot = Some((Cell::new(4, 4), Heading::Left));
        scene.cursor = Some(Cell::new(0, 5));
        let mut mark = |x, y, change: &dyn Fn(&mut Mark)| {
            change(scene.mark_mut(Cell::new(x, y)).expect("inside"));
        };
        mark(1, 1, &|mark| mark.label = Label::new("label"));
        mark(2, 1, &|mark| mark.paint = Some(Paint::Red));
        mark(3, 1, &|mark| {
            mark.paint = Some(Paint::Blue);
            mark.label = Label::new("\u{8ff7}\u{8def}\u{202e}");
        });
        mark(4, 1, &|mark| mark.number = Some(123));
        mark(5, 1, &|mark| mark.number = Some(1234));
        mark(4, 0, &|mark| mark.label = Label::new("e\u{301}\u{301}"));
        mark(1, 5, &|mark| mark.heat = Some(1));
        mark(2, 5, &|mark| mark.heat = Some(4));
        mark(3, 5, &|mark| mark.flagged = true);
        scene
    }

    fn drawn(zoom: Zoom, look: Look) -> String {
        let (width, height) = zoom.extent(6);
        let area = Rect::new(0, 0, width, height);
        let mut buffer = Buffer::empty(area);
        let view = Camera::default().viewport(6, area, Cell::new(0, 0));
        assert_eq!(view.zoom, zoom);
        draw_maze(&scene(), &view, look, &mut buffer);
        text_of(&buffer)
    }

    #[test]
    fn small_mazes() {
        insta::assert_snapshot!("small", drawn(Zoom::Small, PLAIN));
        insta::assert_snapshot!("small_ascii", drawn(Zoom::Small, ASCII));
    }

    #[test]
    fn medium_mazes() {
        insta::assert_snapshot!("medium", drawn(Zoom::Medium, PLAIN));
        insta::assert_snapshot!("medium_ascii", drawn(Zoom::Medium, ASCII));
    }

    #[test]
    fn large_mazes() {
        insta::assert_snapshot!("large", drawn(Zoom::Large, PLAIN));
        insta::assert_snapshot!("large_color", drawn(Zoom::Large, Look::RICH));
    }

    /// A part of a maze is that part of the drawing of all of it.
    #[test]
    fn a_viewport_shows_a_part_of_the_whole() {
        let whole = drawn(Zoom::Medium, ASCII);
        let area = Rect::new(0, 0, 11, 7);
        let mut camera = Camera::default();
        camera.zoom(Zoom::Small, true);
        let view = camera.viewport(6, area, Cell::new(4, 4));
        assert!(view.is_cut());
        let mut buffer = Buffer::empty(area);
        draw_maze(&scene(), &view, ASCII, &mut buffer);
        let (left, top) = (usize::from(view.corner.0), usize::from(view.corner.1));
        let part: String = whole
            .lines()
            .skip(top)
            .take(7)
            .map(|line| {
                let part: String = line.chars().skip(left).take(11).collect();
                format!("{}\n", part.trim_end())
            })
            .collect();
        assert_eq!(text_of(&buffer), part);
        assert!(part.contains('<'), "{part}");
    }
}
