//! The terminal itself: taken for a program, and given back whatever happens.

use std::env;
use std::io::{self, IsTerminal as _, Stdout};
use std::mem::ManuallyDrop;
use std::panic;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Once};
use std::thread;
use std::time::{Duration, Instant};

use ratatui::Terminal;
use ratatui::backend::CrosstermBackend;
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{self, DisableMouseCapture, EnableMouseCapture};
use ratatui::crossterm::{cursor, execute, terminal};
use wasmouse_engine::CancelFlag;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::interrupt;
use super::app::{App, Flow};
use super::keyboard::{Keyboard, Waited};
use super::plain::is_plain;

/// How long a signal, or a new size, may go unnoticed.
const NOTICE: Duration = Duration::from_millis(50);

/// How long a program may take to end after a signal.
const GRACE: Duration = Duration::from_secs(1);

/// Runs a program on the terminal until it ends or a signal does that. `what` names the command in
/// the message that it needs a terminal.
///
/// # Errors
///
/// When standard output is not a terminal, or it is lost.
pub fn run(app: &mut impl App, what: &str, hint: &str) -> Result<Exit, Failure> {
    let is_dumb = env::var_os("TERM").is_some_and(|term| term == "dumb");
    if !io::stdout().is_terminal() || is_dumb {
        let wanted = if is_dumb {
            "a terminal that can move its cursor, and TERM is `dumb`"
        } else {
            "a terminal on standard output"
        };
        return Err(Failure::usage(format!("{what} needs {wanted}")).hint(hint));
    }
    let interrupted = interrupt::listen()?;
    let has_ended = Arc::new(AtomicBool::new(false));
    end_after_signals(interrupted, Arc::clone(&has_ended));
    let ended = Screen::open().and_then(|mut screen| screen.run(app, || interrupted.is_set()));
    has_ended.store(true, Ordering::SeqCst);
    interrupt::stop_listening();
    ended.map_err(|error| Failure::internal(format!("failed to use the terminal: {error}")))
}

/// Ends the process if a signal did not: half of a key makes crossterm wait for the other half.
fn end_after_signals(interrupted: &'static CancelFlag, has_ended: Arc<AtomicBool>) {
    let thread = thread::Builder::new().name("terminal".to_owned());
    // Without it, a second signal ends the process.
    let _ = thread.spawn(move || {
        while !has_ended.load(Ordering::SeqCst) {
            thread::sleep(NOTICE);
            if interrupted.is_set() {
                thread::sleep(GRACE);
                if !has_ended.load(Ordering::SeqCst) {
                    give_back();
                    let exit = interrupt::exit_of(Exit::Interrupted);
                    std::process::exit(i32::from(exit as u8));
                }
            }
        }
    });
}

/// The alternate screen, left when it goes out of scope.
struct Screen {
    /// Never dropped: it would show the cursor once more, and panic if it cannot say that the
    /// terminal has gone.
    terminal: ManuallyDrop<Terminal<CrosstermBackend<Stdout>>>,
    keyboard: Keyboard,
}

/// Whether there is something to give back.
static IS_TAKEN: AtomicBool = AtomicBool::new(false);

impl Screen {
    fn open() -> io::Result<Self> {
        give_back_on_panic();
        IS_TAKEN.store(true, Ordering::SeqCst);
        let opened = Self::take();
        if opened.is_err() {
            give_back();
        }
        opened
    }

    fn take() -> io::Result<Self> {
        let keyboard = Keyboard::open()?;
        terminal::enable_raw_mode()?;
        execute!(
            io::stdout(),
            terminal::EnterAlternateScreen,
            EnableMouseCapture,
            cursor::Hide
        )?;
        let terminal = Terminal::new(CrosstermBackend::new(io::stdout()))?;
        Ok(Self {
            terminal: ManuallyDrop::new(terminal),
            keyboard,
        })
    }

    fn run(&mut self, app: &mut impl App, is_interrupted: impl Fn() -> bool) -> io::Result<Exit> {
        let mut ticked = Instant::now();
        loop {
            self.terminal.draw(|frame| {
                app.draw(frame.buffer_mut());
                disarm(frame.buffer_mut());
            })?;
            loop {
                if is_interrupted() {
                    return Ok(Exit::Interrupted);
                }
                let until_tick = app.wait().map(|wait| wait.saturating_sub(ticked.elapsed()));
                if until_tick == Some(Duration::ZERO) {
                    ticked = Instant::now();
                    app.tick();
                    break;
                }
                let wait = until_tick.map_or(NOTICE, |wait| wait.min(NOTICE));
                if self.keyboard.wait(wait)? == Waited::Closed {
                    return Ok(Exit::HungUp);
                }
                if event::poll(Duration::ZERO)? {
                    let waited = app.wait().is_some();
                    if handle_all(app)? == Flow::End {
                        return Ok(Exit::Success);
                    }
                    if !waited {
                        // What begins to move now has not been waiting.
                        ticked = Instant::now();
                    }
                    break;
                }
            }
        }
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        give_back();
    }
}

/// Handles all events that have arrived, so that a held key cannot outrun the drawing.
fn handle_all(app: &mut impl App) -> io::Result<Flow> {
    loop {
        if app.event(&event::read()?) == Flow::End {
            return Ok(Flow::End);
        }
        if !event::poll(Duration::ZERO)? {
            return Ok(Flow::Go);
        }
    }
}

fn give_back() {
    if IS_TAKEN.swap(false, Ordering::SeqCst) {
        // Nothing can be done about a terminal that has gone.
        let _ = execute!(
            io::stdout(),
            DisableMouseCapture,
            cursor::Show,
            terminal::LeaveAlternateScreen
        );
        let _ = terminal::disable_raw_mode();
    }
}

/// A panic is reported on the ordinary screen, where it stays to be read.
fn give_back_on_panic() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let report = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            give_back();
            report(panic);
        }));
    });
}

/// Replaces whatever could control the terminal, however it came into a cell. Programs write no
/// such text: this is what catches a mistake in one of them.
fn disarm(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        if !cell.symbol().chars().all(is_plain) {
            cell.set_char(char::REPLACEMENT_CHARACTER);
        }
    }
}

#[cfg(test)]
mod tests {
    use ratatui::layout::Rect;

    use super::super::testing::text_of;
    use super::*;

    #[test]
    fn cells_that_could_control_the_terminal_are_disarmed() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 6, 1));
        for (column, symbol) in [(0, "\u{1b}[2J"), (1, "a"), (2, "\u{202e}"), (3, "a\u{301}")] {
            buffer[(column, 0)].set_symbol(symbol);
        }
        disarm(&mut buffer);
        assert_eq!(text_of(&buffer), "\u{fffd}a\u{fffd}\u{fffd}\n");
    }
}
