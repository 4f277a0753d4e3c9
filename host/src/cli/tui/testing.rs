//! What tests read from a buffer of cells.

use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{
    Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier};

use super::app::{App, Flow};

/// The rows of a buffer, without spaces at their ends. Where there are colours or reversed cells,
/// a second picture has a letter for each style and a list of the letters.
pub fn text_of(buffer: &Buffer) -> String {
    let mut text = String::new();
    let mut styles: Vec<String> = Vec::new();
    let mut letters = String::new();
    for row in buffer.area().rows() {
        let (mut line, mut line_letters) = (String::new(), String::new());
        for place in row.columns() {
            let cell = &buffer[(place.x, place.y)];
            line.push_str(cell.symbol());
            let style = name_of(cell.fg, cell.bg, cell.modifier);
            line_letters.push(match style.as_str() {
                "" => ' ',
                _ => {
                    let known = styles.iter().position(|it| *it == style);
                    let at = known.unwrap_or_else(|| {
                        styles.push(style);
                        styles.len() - 1
                    });
                    char::from(b'a' + u8::try_from(at).expect("a few styles"))
                }
            });
        }
        text.push_str(line.trim_end());
        text.push('\n');
        letters.push_str(line_letters.trim_end());
        letters.push('\n');
    }
    if styles
        .iter()
        .any(|it| it.contains("on ") || it.contains("fg "))
    {
        text.push_str(&letters);
        for (at, style) in styles.iter().enumerate() {
            let letter = char::from(b'a' + u8::try_from(at).expect("a few styles"));
            text.push_str(&format!("{letter}: {style}\n"));
        }
    }
    text
}

fn name_of(fg: Color, bg: Color, modifier: Modifier) -> String {
    let mut words = Vec::new();
    if fg != Color::Reset {
        words.push(format!("fg {fg}"));
    }
    if bg != Color::Reset {
        words.push(format!("on {bg}"));
    }
    words.extend(
        modifier
            .iter_names()
            .map(|(name, _)| name.to_ascii_lowercase()),
    );
    words.join(", ")
}

/// A program for the terminal as it looks at that size.
pub fn screen_of(app: &mut impl App, width: u16, height: u16) -> String {
    text_of(&buffer_of(app, width, height))
}

/// The cells of a program for the terminal at that size.
pub fn buffer_of(app: &mut impl App, width: u16, height: u16) -> Buffer {
    let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
    app.draw(&mut buffer);
    buffer
}

/// Presses keys one after the other: characters, or names in angle brackets such as `<left>` and
/// `<ctrl-s>`. Returns what the last one led to.
pub fn press(app: &mut impl App, keys: &str) -> Flow {
    let mut flow = Flow::Go;
    let mut rest = keys;
    while let Some(character) = rest.chars().next() {
        let (code, modifiers, length) =
            match rest.strip_prefix('<').and_then(|it| it.split_once('>')) {
                Some((name, _)) => {
                    let (code, modifiers) = named(name);
                    (code, modifiers, name.len() + 2)
                }
                None => (
                    KeyCode::Char(character),
                    KeyModifiers::NONE,
                    character.len_utf8(),
                ),
            };
        flow = app.event(&Event::Key(KeyEvent::new(code, modifiers)));
        rest = &rest[length..];
    }
    flow
}

fn named(name: &str) -> (KeyCode, KeyModifiers) {
    if let Some(rest) = name.strip_prefix("ctrl-") {
        let (code, modifiers) = named(rest);
        return (code, modifiers | KeyModifiers::CONTROL);
    }
    if let Some(rest) = name.strip_prefix("shift-") {
        let (code, modifiers) = named(rest);
        return (code, modifiers | KeyModifiers::SHIFT);
    }
    let code = match name {
        "left" => KeyCode::Left,
        "right" => KeyCode::Right,
        "up" => KeyCode::Up,
        "down" => KeyCode::Down,
        "home" => KeyCode::Home,
        "end" => KeyCode::End,
        "pageup" => KeyCode::PageUp,
        "pagedown" => KeyCode::PageDown,
        "esc" => KeyCode::Esc,
        "enter" => KeyCode::Enter,
        "tab" => KeyCode::Tab,
        _ => {
            let mut characters = name.chars();
            let only = characters.next().filter(|_| characters.next().is_none());
            KeyCode::Char(only.expect("a key"))
        }
    };
    (code, KeyModifiers::NONE)
}

/// Keys with and without modifiers, and the mouse anywhere.
pub fn any_event() -> impl Strategy<Value = Event> {
    let named = prop::sample::select(vec![
        KeyCode::Left,
        KeyCode::Right,
        KeyCode::Up,
        KeyCode::Down,
        KeyCode::Home,
        KeyCode::End,
        KeyCode::PageUp,
        KeyCode::PageDown,
        KeyCode::Tab,
        KeyCode::Enter,
        KeyCode::Esc,
    ]);
    let letter = (b' '..=b'~').prop_map(|byte| KeyCode::Char(char::from(byte)));
    let modifiers = prop::sample::select(vec![
        KeyModifiers::NONE,
        KeyModifiers::SHIFT,
        KeyModifiers::CONTROL,
    ]);
    let key = (prop_oneof![named, letter], modifiers)
        .prop_map(|(code, modifiers)| Event::Key(KeyEvent::new(code, modifiers)));
    let button = MouseButton::Left;
    let kind = prop::sample::select(vec![
        MouseEventKind::Down(button),
        MouseEventKind::Drag(button),
        MouseEventKind::Up(button),
        MouseEventKind::ScrollUp,
        MouseEventKind::ScrollDown,
    ]);
    let mouse = (kind, 0..90_u16, 0..30_u16).prop_map(|(kind, column, row)| {
        Event::Mouse(MouseEvent {
            kind,
            column,
            row,
            modifiers: KeyModifiers::NONE,
        })
    });
    prop_oneof![4 => key, 1 => mouse]
}

/// Handles events as a terminal would bring them, and draws now and then.
pub fn survive(app: &mut impl App, events: &[Event], width: u16, height: u16) {
    for part in events.chunks(7) {
        for event in part {
            app.event(event);
            if app.wait().is_some() {
                app.tick();
            }
        }
        buffer_of(app, width, height);
    }
}
