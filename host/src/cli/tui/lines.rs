//! Lines of text in a part of the screen. What is written is safe or comes from
//! [`plain`](super::plain).

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use wasmouse_core::guest_text::GuestStr;

use super::look::{Look, Role};
use super::plain::{clipped, width};

/// Writes line after line from the top of an area, until it is full.
pub struct Writer<'a> {
    buffer: &'a mut Buffer,
    area: Rect,
    look: Look,
    row: u16,
}

impl<'a> Writer<'a> {
    /// A writer at the top of an area.
    pub fn new(buffer: &'a mut Buffer, area: Rect, look: Look) -> Self {
        let area = area.intersection(*buffer.area());
        Self {
            buffer,
            area,
            look,
            row: 0,
        }
    }

    /// Rows that are left.
    pub const fn rows_left(&self) -> u16 {
        self.area.height.saturating_sub(self.row)
    }

    /// Writes a line of several parts; what does not fit is cut, and a mark says so.
    pub fn line(&mut self, parts: &[(&str, Role)]) {
        let parts = parts.iter().map(|&(text, role)| (text.into(), role));
        self.parts(parts);
    }

    /// As [`Writer::line`], of parts that may come from outside.
    pub fn parts<'t>(&mut self, parts: impl IntoIterator<Item = (GuestStr<'t>, Role)>) {
        if self.rows_left() == 0 {
            return;
        }
        let mut column = self.area.x;
        for (text, role) in parts {
            let room = usize::from(self.area.right() - column);
            let shown = clipped(text, self.look.charset, room);
            let style = self.look.style(role);
            let (next, _) =
                self.buffer
                    .set_stringn(column, self.area.y + self.row, &shown, room, style);
            column = next;
            if shown.len() < text.len() && usize::from(self.area.right() - column) < 2 {
                break;
            }
        }
        self.row += 1;
    }

    /// Writes ordinary text.
    pub fn text(&mut self, text: &str) {
        self.line(&[(text, Role::Plain)]);
    }

    /// Writes a text over as many lines as it needs, broken between words, but at most so many.
    pub fn wrapped<'t>(&mut self, text: impl Into<GuestStr<'t>>, role: Role, lines_max: u16) {
        let room = usize::from(self.area.width);
        let mut rest = text.into().raw();
        for line in 1..=lines_max {
            if rest.is_empty() || self.rows_left() == 0 {
                return;
            }
            let is_last = line == lines_max || self.rows_left() == 1;
            if is_last || width(rest) <= room {
                self.line(&[(rest, role)]);
                return;
            }
            let (head, tail) = broken(rest, room);
            self.line(&[(head, role)]);
            rest = tail;
        }
    }

    /// Leaves a line empty.
    pub const fn skip(&mut self) {
        self.row = self.row.saturating_add(1);
    }
}

/// A text in two: what fits into a line, up to a space if there is one, and the rest.
fn broken(text: &str, room: usize) -> (&str, &str) {
    let mut used = 0;
    let mut end = text.len();
    for (at, character) in text.char_indices() {
        used += width(character.encode_utf8(&mut [0; 4]));
        if used > room {
            end = at;
            break;
        }
    }
    // A space right after the end does as well.
    let limit = if text[end..].starts_with(' ') {
        end + 1
    } else {
        end
    };
    match text[..limit].rfind(' ') {
        Some(space) if space > 0 => (&text[..space], &text[space + 1..]),
        _ if end > 0 => text.split_at(end),
        _ => (text, ""),
    }
}

/// Draws a box in the middle of the screen, over everything, with a title and lines in it.
pub fn overlay(buffer: &mut Buffer, look: Look, title: &str, lines: &[(String, Role)]) {
    let screen = *buffer.area();
    let longest = lines.iter().map(|(line, _)| width(line)).max().unwrap_or(0);
    let inner = longest
        .max(width(title))
        .min(usize::from(screen.width.saturating_sub(4)));
    let columns = u16::try_from(inner + 4)
        .unwrap_or(screen.width)
        .min(screen.width);
    let rows = u16::try_from(lines.len() + 2)
        .unwrap_or(screen.height)
        .min(screen.height);
    let area = Rect {
        x: screen.x + (screen.width - columns) / 2,
        y: screen.y + (screen.height - rows) / 2,
        width: columns,
        height: rows,
    };
    if columns < 5 || rows < 3 {
        return;
    }
    let [corner_a, corner_b, corner_c, corner_d, level, upright] = if look.is_ascii() {
        ['+', '+', '+', '+', '-', '|']
    } else {
        ['┌', '┐', '└', '┘', '─', '│']
    };
    for place in area.positions() {
        let (left, right) = (place.x == area.x, place.x == area.right() - 1);
        let (top, bottom) = (place.y == area.y, place.y == area.bottom() - 1);
        let character = match (left, right, top, bottom) {
            (true, _, true, _) => corner_a,
            (_, true, true, _) => corner_b,
            (true, _, _, true) => corner_c,
            (_, true, _, true) => corner_d,
            (_, _, true, _) | (_, _, _, true) => level,
            (true, ..) | (_, true, ..) => upright,
            _ => ' ',
        };
        let cell = &mut buffer[place];
        cell.reset();
        cell.set_char(character).set_style(Style::new());
    }
    let title_area = Rect {
        x: area.x + 2,
        y: area.y,
        width: area.width - 4,
        height: 1,
    };
    Writer::new(buffer, title_area, look).line(&[(title, Role::Strong)]);
    let text_area = Rect {
        x: area.x + 2,
        y: area.y + 1,
        width: area.width - 4,
        height: area.height - 2,
    };
    let mut writer = Writer::new(buffer, text_area, look);
    for (line, role) in lines {
        writer.line(&[(line, *role)]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::text_of;
    use super::*;

    #[test]
    fn lines_are_cut_and_broken_between_words() {
        let area = Rect::new(0, 0, 12, 6);
        let mut buffer = Buffer::empty(area);
        let mut writer = Writer::new(&mut buffer, area, Look::RICH);
        writer.line(&[("robot ", Role::Plain), ("a very long name", Role::Plain)]);
        writer.wrapped("every goal cell must be reachable", Role::Plain, 3);
        writer.wrapped(&"x".repeat(40), Role::Plain, 9);
        writer.text("no room");
        assert_eq!(
            text_of(&buffer),
            "robot a ver…\nevery goal\ncell must be\nreachable\nxxxxxxxxxxxx\nxxxxxxxxxxx…\n"
        );
    }

    #[test]
    fn boxes_fit_any_screen() {
        for (width, height) in [(0, 0), (1, 1), (4, 2), (5, 3), (20, 4), (200, 60)] {
            let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
            let lines = vec![("a line".to_owned(), Role::Plain); 9];
            overlay(&mut buffer, Look::RICH, "title", &lines);
        }
    }
}
