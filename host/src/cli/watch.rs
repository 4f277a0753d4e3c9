//! `--watch`: a match step by step on the terminal, as large as it fits.
//!
//! A match takes less than a millisecond, so it is played first and its trace is shown at a
//! readable speed. That also lets the viewer pause and step back.

use std::io::{self, IsTerminal as _, Write as _};
use std::time::Duration;

use crossterm::event::{self, Event, KeyCode, KeyEventKind, KeyModifiers};
use crossterm::{cursor, execute, queue, terminal};
use wasmouse_core::game::{Action, Event as GameEvent, Trace, Verdict};
use wasmouse_core::journal::{Level, Note};
use wasmouse_core::record::trace;
use wasmouse_engine::Executor;

use super::again::{Replayed, play_again};
use super::failure::Failure;
use super::terminal::picture_style;
use crate::contest::{Plan, Player, Results};
use crate::report::escape::for_terminal;
use crate::report::moment;

/// Shows the only match of a contest until it is over or the viewer quits.
///
/// # Errors
///
/// When there is not exactly one match, or standard output is not a terminal.
pub fn watch(
    plan: &Plan,
    players: &[Player],
    executor: &dyn Executor,
    results: &Results,
    delay: Duration,
    ascii: bool,
) -> Result<(), Failure> {
    let [record] = &results.matches[..] else {
        let count = results.matches.len();
        let message = format!("--watch shows one match, and this contest has {count}");
        return Err(Failure::usage(message).hint("name one robot and one maze"));
    };
    if !io::stdout().is_terminal() {
        return Err(
            Failure::usage("--watch needs a terminal on standard output").hint("leave it out"),
        );
    }
    let replayed = play_again(plan, players, executor, record).map_err(Failure::internal)?;
    let Some(replayed) = replayed else {
        return Ok(());
    };
    let maze = &replayed.maze.maze;
    let transcript = &replayed.detailed.recording.transcript;
    let (_, trace) = trace(maze, &plan.rules.game, transcript).map_err(Failure::internal)?;
    let show = Show {
        robot: for_terminal(&plan.entrants[replayed.player.entrants[0]].name),
        replayed: &replayed,
        trace: &trace,
        ascii,
    };
    let screen = Screen::open().map_err(lost)?;
    let played = show.play(delay).map_err(lost);
    drop(screen);
    played
}

fn lost(error: io::Error) -> Failure {
    Failure::internal(format!("failed to use the terminal: {error}"))
}

/// The alternate screen, left when it goes out of scope.
struct Screen;

impl Screen {
    fn open() -> io::Result<Self> {
        terminal::enable_raw_mode()?;
        let screen = Self;
        execute!(io::stdout(), terminal::EnterAlternateScreen, cursor::Hide)?;
        Ok(screen)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        // Nothing can be done about a terminal that has gone.
        let _ = execute!(io::stdout(), cursor::Show, terminal::LeaveAlternateScreen);
        let _ = terminal::disable_raw_mode();
    }
}

struct Show<'a> {
    robot: String,
    replayed: &'a Replayed<'a>,
    trace: &'a Trace,
    ascii: bool,
}

/// What a key means.
enum Command {
    Quit,
    Pause,
    By(isize),
    Nothing,
}

impl Show<'_> {
    fn play(&self, delay: Duration) -> io::Result<()> {
        let last = self.trace.steps().len();
        let (mut step, mut paused) = (0, false);
        loop {
            self.draw(step, paused)?;
            let waits = paused || step == last;
            if !waits && !event::poll(delay)? {
                step += 1;
                continue;
            }
            match command(&event::read()?) {
                Command::Quit => return Ok(()),
                Command::Pause => paused = !paused,
                Command::By(steps) => {
                    paused = true;
                    step = step.saturating_add_signed(steps).min(last);
                }
                Command::Nothing => {}
            }
        }
    }

    fn draw(&self, step: usize, paused: bool) -> io::Result<()> {
        let journal = &self.replayed.detailed.recording.journal;
        let picture = moment(&self.replayed.maze.maze, self.trace, journal, step);
        let text = picture.to_text(picture_style(self.ascii));
        let mut stdout = io::stdout().lock();
        queue!(stdout, cursor::MoveTo(0, 0))?;
        for line in self
            .header(step, paused)
            .iter()
            .map(String::as_str)
            .chain(text.lines())
        {
            write!(stdout, "{line}")?;
            queue!(
                stdout,
                terminal::Clear(terminal::ClearType::UntilNewLine),
                cursor::MoveToNextLine(1)
            )?;
        }
        queue!(stdout, terminal::Clear(terminal::ClearType::FromCursorDown))?;
        stdout.flush()
    }

    fn header(&self, step: usize, paused: bool) -> [String; 3] {
        let robot = &self.robot;
        let maze = for_terminal(&self.replayed.maze.name);
        let steps = self.trace.steps();
        let state = if step == steps.len() {
            match &self.replayed.detailed.record.verdict {
                Verdict::Finished { score } => format!("finished, score {score}"),
                Verdict::Fault { fault } => for_terminal(&fault.to_string()),
                other => other.title().into_owned(),
            }
        } else if paused {
            "paused".into()
        } else {
            String::new()
        };
        let title = format!("{robot} in {maze}: step {step} of {}  {state}", steps.len());
        let what = step
            .checked_sub(1)
            .and_then(|index| steps.get(index))
            .map_or_else(String::new, |step| {
                let sensors = step.sensors;
                let (left, front, right) = (sensors.left, sensors.front, sensors.right);
                let (run, action) = (step.run.name(), action(step.action));
                let event = event_name(step.event);
                format!("{run}: sensors {left} {front} {right}, {action}{event}")
            });
        let keys = "space: pause   left, right: one step   home, end   q: quit".to_owned();
        let log = self.last_log(step).unwrap_or(keys);
        [title, what, log]
    }

    /// The last line that the robot logged in this step.
    fn last_log(&self, step: usize) -> Option<String> {
        let number = u32::try_from(step).ok()?;
        let journal = &self.replayed.detailed.recording.journal;
        let logged =
            journal
                .entries()
                .filter_map(|entry| match (entry.step == number, entry.note) {
                    (true, Note::Log { level, text }) => Some((level, text)),
                    _ => None,
                });
        let (level, text) = logged.last()?;
        let mark = match level {
            Level::Debug | Level::Info => "",
            Level::Warning => "warning: ",
            Level::Error => "error: ",
        };
        Some(format!("\"{mark}{}\"", for_terminal(text)))
    }
}

fn action(action: Action) -> String {
    match action {
        Action::Move { turn, advance } => {
            let turn = match turn {
                wasmouse_core::maze::Turn::Left => "left",
                wasmouse_core::maze::Turn::Straight => "straight",
                wasmouse_core::maze::Turn::Right => "right",
            };
            format!("{turn} {advance}")
        }
        Action::Reset => "reset".into(),
    }
}

const fn event_name(event: GameEvent) -> &'static str {
    match event {
        GameEvent::Moved { bumped: true, .. } => ", bumped",
        GameEvent::Moved { .. } | GameEvent::Reset => "",
        GameEvent::ResetBeforeGoal => " ignored: the goal was not reached yet",
        GameEvent::ResetInSpeedRun => " ignored: this is the speed run",
    }
}

fn command(event: &Event) -> Command {
    let Event::Key(key) = event else {
        return Command::Nothing;
    };
    if key.kind == KeyEventKind::Release {
        return Command::Nothing;
    }
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    match key.code {
        KeyCode::Char('c') if control => Command::Quit,
        KeyCode::Char('q') | KeyCode::Esc => Command::Quit,
        KeyCode::Char(' ') => Command::Pause,
        KeyCode::Right => Command::By(1),
        KeyCode::Left => Command::By(-1),
        KeyCode::Home => Command::By(isize::MIN),
        KeyCode::End => Command::By(isize::MAX),
        _ => Command::Nothing,
    }
}
