//! [`Look`]: characters and colours of the terminal. Every colour repeats what a character says.

use ratatui::style::{Color, Modifier, Style};

use crate::report::picture::{Charset, Paint};

/// How things look on this terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// The characters.
    pub charset: Charset,
    /// Whether there are colours.
    pub color: bool,
}

/// What a part of the screen is there for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Ordinary text, and walls.
    Plain,
    /// What matters less: unknown walls, hints.
    Faint,
    /// Titles and values.
    Strong,
    /// The robot.
    Robot,
    /// The path of the robot.
    Path,
    /// A path that is possible or optimal.
    Optimum,
    /// Good news.
    Good,
    /// Something that is wrong.
    Bad,
    /// Something that might be wrong.
    Warning,
    /// What the keys act on.
    Cursor,
    /// A cell of this heat, from 0 to [`HEAT_LEVELS`].
    Heat(u8),
    /// A painted cell.
    Paint(Paint),
    /// The letter of a colour, where filling the cell would hide its walls.
    Ink(Paint),
}

/// Levels of heat above cold.
pub const HEAT_LEVELS: u8 = 4;

/// Backgrounds of heat by level, and whether text on them is light, in the 256-colour table.
const HEAT: [(u8, bool); HEAT_LEVELS as usize + 1] = [
    (17, true),
    (25, true),
    (30, true),
    (172, false),
    (203, false),
];

/// Black and white of the 256-colour table, which no theme changes.
const BLACK: Color = Color::Indexed(16);
const WHITE: Color = Color::Indexed(231);

impl Look {
    /// Unicode with colours.
    #[cfg(test)]
    pub const RICH: Self = Self {
        charset: Charset::Unicode,
        color: true,
    };

    /// Whether only ASCII may be written.
    pub fn is_ascii(self) -> bool {
        self.charset == Charset::Ascii
    }

    /// The first text, or the second where only ASCII may be written.
    pub fn either<'a>(self, unicode: &'a str, ascii: &'a str) -> &'a str {
        if self.is_ascii() { ascii } else { unicode }
    }

    /// The style for a part of the screen.
    pub fn style(self, role: Role) -> Style {
        let style = Style::new();
        let style = match role {
            Role::Plain | Role::Path | Role::Optimum | Role::Good | Role::Heat(_) => style,
            Role::Paint(_) | Role::Ink(_) => style,
            Role::Faint => style.add_modifier(Modifier::DIM),
            Role::Strong | Role::Robot | Role::Bad | Role::Warning => {
                style.add_modifier(Modifier::BOLD)
            }
            Role::Cursor => style.add_modifier(Modifier::REVERSED),
        };
        if !self.color {
            return style;
        }
        match role {
            Role::Plain | Role::Faint | Role::Strong | Role::Cursor => style,
            Role::Robot => style.fg(Color::Indexed(199)),
            Role::Path => style.fg(Color::Indexed(35)),
            Role::Optimum => style.fg(Color::Indexed(33)),
            Role::Good => style.fg(Color::Indexed(35)),
            Role::Bad => style.fg(Color::Indexed(196)),
            Role::Warning => style.fg(Color::Indexed(172)),
            Role::Heat(level) => {
                let (background, is_light) = HEAT[usize::from(level.min(HEAT_LEVELS))];
                let text = if is_light { WHITE } else { BLACK };
                style.bg(Color::Indexed(background)).fg(text)
            }
            Role::Ink(paint) => style.fg(Color::Indexed(paint_color(paint))),
            Role::Paint(paint) => style.bg(Color::Indexed(paint_color(paint))).fg(BLACK),
        }
    }
}

/// A similar colour in the 256-colour table.
const fn paint_color(paint: Paint) -> u8 {
    match paint {
        Paint::Red => 203,
        Paint::Orange => 208,
        Paint::Yellow => 220,
        Paint::Green => 78,
        Paint::Cyan => 44,
        Paint::Blue => 75,
        Paint::Violet => 141,
        Paint::Gray => 248,
    }
}
