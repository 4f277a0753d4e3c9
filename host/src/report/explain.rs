//! [`explain`]: a match step by step as text, with what the robot wrote and the fuel that it used.

use std::fmt::Write as _;

use wasmouse_core::game::{Action, Event, GameRules, Sensors, Simulation, Step, Trace};
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::{Belief, Color, Journal, Level, Note};
use wasmouse_core::maze::{Cell, Heading, Maze, Turn};
use wasmouse_core::record::MatchRecord;

use super::escape::for_terminal;
use super::faults::explained;
use super::number::grouped;
use crate::contest::Complaint;

/// Columns of a line, at most; names of robots and mazes may be longer.
const WIDTH: usize = 80;

/// How lines of the journal are indented.
const INDENT: &str = "        ";

/// A match, with everything that the robot left behind.
#[derive(Clone, Copy, Debug)]
pub struct Explained<'a> {
    /// The robot's name.
    pub robot: GuestStr<'a>,
    /// The maze's name, unescaped.
    pub maze_name: GuestStr<'a>,
    /// The maze.
    pub maze: &'a Maze,
    /// The rules of the game.
    pub rules: &'a GameRules,
    /// What came of the match.
    pub record: &'a MatchRecord,
    /// Its steps, of the same maze and rules.
    pub trace: &'a Trace,
    /// What the robot wrote.
    pub journal: &'a Journal,
    /// Fuel of every call of `next-move`.
    pub step_fuel: &'a [u64],
}

/// The match: its verdict, then each step in a line, followed by the log lines, paints and labels of
/// that step, then the fault. A step shows cell and heading before it, the readings, the action,
/// what came of it if that is not what was asked for, and the fuel. Ends with a newline.
pub fn explain(it: &Explained<'_>) -> String {
    let mut text = format!(
        "`{}` in `{}`, seed {}: {}\n\n",
        for_terminal(it.robot),
        for_terminal(it.maze_name),
        it.record.key.seed,
        it.record.verdict.title()
    );
    text.push_str(
        " Step  Cell      Heading  Left Front Right  Action                        Fuel\n",
    );
    text.push_str(&"-".repeat(WIDTH));
    text.push('\n');
    let mut notes = Notes::new(it.journal);
    row(&mut text, "start", "", it.record.fuel.start);
    notes.print(0, &mut text);
    for (number, (step, fuel)) in (1..).zip(it.trace.steps().iter().zip(it.step_fuel)) {
        if step.run.number() == 2 && number > 1 && is_first_of_run(it.trace, number) {
            text.push_str(&format!("{:-^WIDTH$}\n", " speed run "));
        }
        let state = state((step.cell, step.heading), step.sensors, &done(step));
        row(&mut text, &number.to_string(), &state, *fuel);
        notes.print(number, &mut text);
    }
    if let Some(fault) = it.record.verdict.fault() {
        let made = it.trace.steps().len();
        if let (Some(fuel), Some(state)) = (it.step_fuel.get(made), unfinished(it)) {
            row(&mut text, &(made + 1).to_string(), &state, *fuel);
        }
        notes.print(u32::MAX, &mut text);
        let complaint = Complaint::of(it.journal, fault);
        let fault = for_terminal(&explained(fault, Some(&complaint)));
        text.push_str(&format!("\nfault: {fault}\n"));
    }
    if it.journal.dropped() > 0 {
        let dropped = grouped(it.journal.dropped());
        text.push_str(&format!(
            "\n{dropped} more entries exceeded the journal limit\n"
        ));
    }
    let fuel = it.record.fuel;
    let total = grouped(fuel.start.saturating_add(fuel.steps));
    let most = grouped(fuel.step_max);
    text.push_str(&format!(
        "\nfuel: {total} in all, at most {most} in a step\n"
    ));
    text
}

/// One step: `text` is what is between its number and its fuel.
fn row(text: &mut String, step: &str, state: &str, fuel: u64) {
    writeln!(text, "{step:>5}  {state:<55}{:>18}", grouped(fuel))
        .expect("writing to a string cannot fail");
}

fn state((cell, heading): (Cell, Heading), sensors: Sensors, action: &str) -> String {
    let Sensors { left, front, right } = sensors;
    let (cell, heading) = (cell.to_string(), heading_name(heading));
    format!("{cell:<9} {heading:<7}  {left:>4} {front:>5} {right:>5}  {action}")
}

/// Whether the step with that number, counted from 1, is the first of its run.
fn is_first_of_run(trace: &Trace, number: u32) -> bool {
    let at = usize::try_from(number).unwrap_or(usize::MAX) - 1;
    let before = at.checked_sub(1).and_then(|it| trace.steps().get(it));
    let run = |step: &Step| step.run.number();
    before.map(run) != trace.steps().get(at).map(run)
}

/// The action of a step, and what came of it if it is not what was asked for.
fn done(step: &Step) -> String {
    let mut text = match step.action {
        Action::Move { turn, advance } => format!("{} {advance}", turn_name(turn)),
        Action::Reset => "reset".to_owned(),
    };
    match step.event {
        Event::Moved {
            bumped: true,
            cells,
            ..
        } => text.push_str(&format!(", bumped after {cells}")),
        Event::Moved {
            clamped: true,
            cells,
            ..
        } => text.push_str(&format!(", clamped to {cells}")),
        Event::ResetBeforeGoal | Event::ResetInSpeedRun => text.push_str(", ignored"),
        Event::Moved { .. } | Event::Reset => {}
    }
    text
}

/// The state before the step that failed; `None` if there is no such step.
fn unfinished(it: &Explained<'_>) -> Option<String> {
    let mut simulation = Simulation::new(it.maze, it.rules);
    for step in it.trace.steps() {
        simulation.apply(step.action);
    }
    let place = (simulation.cell(), simulation.heading());
    (!simulation.has_ended()).then(|| state(place, simulation.sense(), "fault"))
}

/// The journal, which is printed step by step.
struct Notes<'a> {
    entries: std::iter::Peekable<Box<dyn Iterator<Item = wasmouse_core::journal::Entry<'a>> + 'a>>,
}

impl<'a> Notes<'a> {
    fn new(journal: &'a Journal) -> Self {
        let entries: Box<dyn Iterator<Item = _>> = Box::new(journal.entries());
        Self {
            entries: entries.peekable(),
        }
    }

    /// Prints what was written up to and including that step. Paints, labels and beliefs that
    /// follow each other share lines.
    fn print(&mut self, step: u32, text: &mut String) {
        let mut marks: Vec<String> = Vec::new();
        while let Some(entry) = self.entries.next_if(|it| it.step <= step) {
            match mark(entry.note) {
                Some(mark) => marks.push(mark),
                None => {
                    print_marks(&mut marks, text);
                    if let Note::Log { level, text: line } = entry.note {
                        print_log(level, line, text);
                    }
                }
            }
        }
        print_marks(&mut marks, text);
    }
}

/// A note about a cell in a few words; `None` for a log line.
fn mark(note: Note<'_>) -> Option<String> {
    Some(match note {
        Note::Log { .. } => return None,
        Note::Paint { cell, color } => format!("paint {cell} {}", color_name(color)),
        Note::Label { cell, text } => format!("label {cell} `{}`", for_terminal(text)),
        Note::Wall { cell, side, belief } => {
            format!("wall {cell} {} {}", heading_name(side), belief_name(belief))
        }
    })
}

/// Prints the marks, as many in a line as fit.
fn print_marks(marks: &mut Vec<String>, text: &mut String) {
    let mut line = String::new();
    for mark in marks.drain(..) {
        let length = INDENT.len() + line.chars().count() + 2 + mark.chars().count();
        if !line.is_empty() && length > WIDTH {
            text.push_str(&format!("{INDENT}{line}\n"));
            line.clear();
        }
        if !line.is_empty() {
            line.push_str("; ");
        }
        line.push_str(&mark);
    }
    if !line.is_empty() {
        text.push_str(&format!("{INDENT}{line}\n"));
    }
}

/// Prints a log line; one that is too long goes on below.
fn print_log(level: Level, line: GuestStr<'_>, text: &mut String) {
    let mut start = format!("{:<8}", level_name(level));
    let room = WIDTH - INDENT.len() - start.len();
    for line in line.lines() {
        let characters: Vec<char> = for_terminal(line).chars().collect();
        let mut parts = characters.chunks(room).peekable();
        if parts.peek().is_none() {
            continue;
        }
        for part in parts {
            let part: String = part.iter().collect();
            text.push_str(&format!("{INDENT}{start}{}\n", part.trim_end()));
            start = " ".repeat(start.len());
        }
    }
}

const fn level_name(level: Level) -> &'static str {
    match level {
        Level::Debug => "debug",
        Level::Info => "info",
        Level::Warning => "warning",
        Level::Error => "error",
    }
}

const fn heading_name(heading: Heading) -> &'static str {
    match heading {
        Heading::Up => "up",
        Heading::Right => "right",
        Heading::Down => "down",
        Heading::Left => "left",
    }
}

const fn turn_name(turn: Turn) -> &'static str {
    match turn {
        Turn::Left => "left",
        Turn::Straight => "straight",
        Turn::Right => "right",
    }
}

const fn belief_name(belief: Belief) -> &'static str {
    match belief {
        Belief::Unknown => "unknown",
        Belief::Open => "open",
        Belief::Closed => "closed",
    }
}

const fn color_name(color: Color) -> &'static str {
    match color {
        Color::None => "none",
        Color::Red => "red",
        Color::Orange => "orange",
        Color::Yellow => "yellow",
        Color::Green => "green",
        Color::Cyan => "cyan",
        Color::Blue => "blue",
        Color::Violet => "violet",
        Color::Gray => "gray",
    }
}

#[cfg(test)]
mod tests {
    use wasmouse_core::game::{FaultKind, Phase};
    use wasmouse_core::maze::Walls;
    use wasmouse_core::record::{FuelUse, Transcript, Usage, trace};

    use super::super::sample::HOSTILE;
    use super::super::sample::results;
    use super::*;

    /// A match that bumps, writes all kinds of notes and faults in its third step.
    #[test]
    fn a_match_is_explained_in_80_columns() {
        let maze = Maze::contest(Walls::open(4)).expect("start and goal fit");
        let mut transcript = Transcript::default();
        for (turn, advance) in [(Turn::Right, 2), (Turn::Left, 5)] {
            transcript.push(Action::Move { turn, advance });
        }
        let detail = "executed `unreachable`".to_owned();
        transcript.end_with_fault(FaultKind::Unreachable, Phase::NextMove, detail);
        let rules = GameRules::default();
        let (result, trace) = trace(&maze, &rules, &transcript).expect("a match");
        let mut journal = Journal::default();
        journal.clear(10_000);
        fn log(level: Level, text: &str) -> Note<'_> {
            let text = text.into();
            Note::Log { level, text }
        }
        let cell = Cell::new(1, 2);
        let long = "long ".repeat(30);
        for (step, note) in [
            (0, log(Level::Info, "4 cells")),
            (
                1,
                Note::Paint {
                    cell,
                    color: Color::Red,
                },
            ),
            (
                1,
                Note::Label {
                    cell,
                    text: HOSTILE.into(),
                },
            ),
            (
                1,
                Note::Wall {
                    cell,
                    side: Heading::Left,
                    belief: Belief::Closed,
                },
            ),
            (1, log(Level::Debug, &long)),
            (
                3,
                log(
                    Level::Error,
                    "Traceback:\n  File \"app.py\", line 3\nValueError: boom",
                ),
            ),
        ] {
            journal.push(step, note);
        }
        let fuel = FuelUse {
            start: 12,
            steps: 20_000_003_456,
            step_max: 20_000_000_000,
        };
        let usage = Usage {
            fuel,
            memory_bytes: 0,
            journal: journal.counts(),
        };
        let key = results().matches[0].key;
        let record = MatchRecord::new(key, result, usage, &transcript);
        let text = explain(&Explained {
            robot: HOSTILE.into(),
            maze_name: "small".into(),
            maze: &maze,
            rules: &rules,
            record: &record,
            trace: &trace,
            journal: &journal,
            step_fuel: &[1234, 20_000_000_000, 2222],
        });
        let expected = [
            " Step  Cell      Heading  Left Front Right  Action                        Fuel",
            "--------------------------------------------------------------------------------",
            "start                                                                         12",
            "        info    4 cells",
            "    1  (0, 0)    up          0     3     3  right 2                        1,234",
            "        paint (1, 2) red",
            "        label (1, 2) `<b>\\u{1b}[31m\\u{9b}\"\\\\n\\r\\u{2028}\\u{202e}\\u{e0041}🧿`",
            "        wall (1, 2) left closed",
            "        debug   long long long long long long long long long long long long long",
            "                 long long long long long long long long long long long long lon",
            "                g long long long long",
            "    2  (2, 0)    right       3     1     0  left 5, clamped to 3    20,000,000,000",
            "    3  (2, 3)    up          2     0     1  fault                          2,222",
            "        error   Traceback:",
            "                  File \"app.py\", line 3",
            "                ValueError: boom",
            "",
            "fault: ValueError: boom; executed `unreachable` in step 3 (exploration run, at (2, 3))",
            "",
            "fuel: 20,000,003,468 in all, at most 20,000,000,000 in a step",
        ];
        let (title, lines) = text.split_once("\n\n").expect("a title");
        assert!(title.ends_with("in `small`, seed 18446744073709551615: fault: unreachable"));
        assert_eq!(lines.lines().collect::<Vec<_>>(), expected);
    }
}
