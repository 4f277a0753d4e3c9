//! Bars that show on a terminal how far something is.

use std::fmt::Write;
use std::io;

use console::Term;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle, TermLike};

/// How often a bar is drawn in a second, at most.
const DRAWN_MAX: u8 = 20;

/// Room for what the terminal shows for keys: `^C`, twice.
const ECHO_COLUMNS: usize = 4;

/// A bar on standard error, where that is a terminal.
pub fn new(length: u64, style: ProgressStyle) -> ProgressBar {
    let term = Term::buffered_stderr();
    let target = if !term.is_term() || console::is_dumb() {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::term_like_with_hz(Box::new(Terminal(term)), DRAWN_MAX)
    };
    ProgressBar::with_draw_target(Some(length), target).with_style(style)
}

/// A terminal whose cursor stays clear of the right edge. Indicatif leaves it there; the `^C` that
/// the terminal shows would then begin a line of its own, and the bar would be removed one line
/// too low.
#[derive(Debug)]
struct Terminal(Term);

impl TermLike for Terminal {
    fn width(&self) -> u16 {
        TermLike::width(&self.0)
    }

    fn height(&self) -> u16 {
        TermLike::height(&self.0)
    }

    fn move_cursor_up(&self, lines: usize) -> io::Result<()> {
        self.0.move_cursor_up(lines)
    }

    fn move_cursor_down(&self, lines: usize) -> io::Result<()> {
        self.0.move_cursor_down(lines)
    }

    fn move_cursor_right(&self, columns: usize) -> io::Result<()> {
        self.0.move_cursor_right(columns)
    }

    fn move_cursor_left(&self, columns: usize) -> io::Result<()> {
        self.0.move_cursor_left(columns)
    }

    fn write_line(&self, line: &str) -> io::Result<()> {
        self.0.write_line(line)
    }

    fn write_str(&self, text: &str) -> io::Result<()> {
        self.0.write_str(text)
    }

    fn clear_line(&self) -> io::Result<()> {
        self.0.clear_line()
    }

    /// Called when everything is drawn.
    fn flush(&self) -> io::Result<()> {
        self.0.move_cursor_left(ECHO_COLUMNS)?;
        self.0.flush()
    }
}

/// Counts matches, with their rate and the time that the rest will take, and `below` after that.
pub fn matches(below: &str) -> ProgressStyle {
    let template = format!("{{bar:40}} {{pos}}/{{len}} matches, {{rate}}/s, {{eta}} left{below}");
    let style = ProgressStyle::with_template(&template).expect("a template of known keys");
    // The rate of indicatif has four decimals.
    let rate = |state: &ProgressState, line: &mut dyn Write| {
        write!(line, "{:.0}", state.per_sec()).expect("a line takes any text");
    };
    style.with_key("rate", rate)
}
