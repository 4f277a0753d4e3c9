//! `--watch`: a match step by step on the terminal, as large as it fits.
//!
//! The match is over before it is shown: matches take less than a millisecond,
//! so what is watched is its trace, at a speed for eyes. That also lets the
//! viewer stop and step back.

use std::io::{self, IsTerminal as _, Write as _};
use std::time::Duration;

use crossterm::event::{self, Event, KeyCode, KeyEventKind, KeyModifiers};
use crossterm::{cursor, execute, queue, terminal};

use super::exit::Exit;
use super::failure::Failure;
use super::terminal::picture_style;
use crate::contest::{Contest, MatchResult};
use crate::report::{replay, visible};
use crate::robot::{Level, Note, Recorder, Referee, Verdict};
use crate::sim::{Action, Event as SimEvent};

/// Shows the only match of a contest until it is over or the viewer leaves.
///
/// # Errors
///
/// When there is not exactly one match, or standard output is no terminal.
pub fn watch(
    contest: &Contest,
    referee: &Referee,
    results: &[MatchResult],
    delay: Duration,
    ascii: bool,
) -> Result<Exit, Failure> {
    let [result] = results else {
        return Err(Failure::usage(format!(
            "--watch shows one match, and this contest has {}",
            results.len()
        ))
        .hint("name one robot and one maze"));
    };
    if !io::stdout().is_terminal() {
        return Err(
            Failure::usage("--watch needs a terminal on standard output").hint("leave it out"),
        );
    }
    let mut recorder = Recorder::default();
    contest
        .replay(referee, result, &mut recorder)
        .map_err(Failure::internal)?;
    let show = Show {
        contest,
        result,
        recorder: &recorder,
        ascii,
    };
    let screen = Screen::open().map_err(lost)?;
    let played = show.play(delay).map_err(lost);
    drop(screen);
    played?;
    Ok(Exit::Success)
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
    contest: &'a Contest,
    result: &'a MatchResult,
    recorder: &'a Recorder,
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
        let last = self.recorder.trace.steps().len();
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
        let maze = &self.contest.mazes[self.result.maze];
        let Recorder { trace, journal, .. } = self.recorder;
        let picture = replay::moment(&maze.maze, trace, journal, step);
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
        let robot = visible(&self.contest.entrants[self.result.entrant].name);
        let maze = visible(&self.contest.mazes[self.result.maze].name);
        let steps = self.recorder.trace.steps();
        let state = if step == steps.len() {
            match &self.result.outcome.verdict {
                Verdict::Finished(score) => format!("finished, score {score}"),
                Verdict::Fault(fault) => visible(&fault.to_string()),
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
                let answer = answer(step.action);
                let run = step.run.number();
                let event = event_name(step.event);
                format!("run {run}: saw {left} {front} {right}, answered {answer}{event}")
            });
        let keys = "space: pause   left, right: one step   home, end   q: quit".to_owned();
        let said = self.last_line(step).unwrap_or(keys);
        [title, what, said]
    }

    /// What the robot wrote last, when it was in this step.
    fn last_line(&self, step: usize) -> Option<String> {
        let number = u32::try_from(step).ok()?;
        let said = self.recorder.journal.entries().filter_map(|entry| {
            match (entry.step == number, entry.note) {
                (true, Note::Log { level, text }) => Some((level, text)),
                _ => None,
            }
        });
        let (level, text) = said.last()?;
        let mark = match level {
            Level::Debug | Level::Info => "",
            Level::Warning => "warning: ",
            Level::Error => "error: ",
        };
        Some(format!("\"{mark}{}\"", visible(text)))
    }
}

fn answer(action: Action) -> String {
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

const fn event_name(event: SimEvent) -> &'static str {
    match event {
        SimEvent::Moved { bumped: true, .. } => ", bumped",
        SimEvent::Moved { .. } | SimEvent::ResetDone => "",
        SimEvent::ResetBeforeGoal => ", refused: the goal was not reached yet",
        SimEvent::ResetInSpeedRun => ", refused: this is run 2",
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
