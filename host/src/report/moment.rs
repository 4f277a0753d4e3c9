//! [`moment()`]: a match at one step, with what the robot wrote to its journal by then.

use wasmouse_core::game::{Event, Run, Trace};
use wasmouse_core::journal::{Belief, Color, Journal, Note};
use wasmouse_core::maze::{Heading, Maze};

use super::picture::{Label, Paint, Picture, Wall};

/// A match after its first `steps` steps: the robot, its path in the speed run, and everything
/// that it has painted and labelled by then. When the robot reports beliefs about walls, the
/// picture shows the maze that it believes in, with unknown walls dotted; otherwise it shows
/// the true maze.
pub fn moment(maze: &Maze, trace: &Trace, journal: &Journal, steps: usize) -> Picture {
    let reports_walls = journal
        .entries()
        .any(|entry| matches!(entry.note, Note::Wall { .. }));
    let mut picture = if reports_walls {
        Picture::unknown(maze.dimension(), maze.start(), maze.goal())
    } else {
        Picture::of(maze)
    };
    let done = &trace.steps()[..steps.min(trace.steps().len())];
    let (mut run, mut cell, mut heading) = (Run::Exploration, maze.start(), Heading::Up);
    let mut stops = vec![cell];
    for step in done {
        match step.event {
            Event::Moved {
                cell: to,
                heading: turned,
                cells,
                ..
            } => {
                (cell, heading) = (to, turned);
                if cells > 0 {
                    stops.push(to);
                }
            }
            Event::Reset => {
                (run, cell, heading) = (Run::Speed, maze.start(), Heading::Up);
                stops = vec![cell];
            }
            Event::ResetBeforeGoal | Event::ResetInSpeedRun => {}
        }
    }
    // A path that crosses itself many times hides more than it shows.
    if run == Run::Speed {
        picture.set_stops(&stops);
    }
    draw_journal(&mut picture, journal, steps);
    picture.set_robot(cell, heading);
    picture
}

fn draw_journal(picture: &mut Picture, journal: &Journal, steps: usize) {
    let seen = |step: u32| usize::try_from(step).is_ok_and(|step| step <= steps);
    for entry in journal.entries().filter(|entry| seen(entry.step)) {
        match entry.note {
            Note::Log { .. } => {}
            Note::Paint { cell, color } => {
                if let Some(mark) = picture.mark_mut(cell) {
                    mark.paint = paint(color);
                }
            }
            Note::Label { cell, text } => {
                if let Some(mark) = picture.mark_mut(cell) {
                    mark.label = Label::new(text);
                }
            }
            Note::Wall { cell, side, belief } => {
                let wall = match belief {
                    Belief::Unknown => Wall::Unknown,
                    Belief::Open => Wall::Open,
                    Belief::Closed => Wall::Closed,
                };
                picture.set_wall(cell, side, wall);
            }
        }
    }
}

const fn paint(color: Color) -> Option<Paint> {
    Some(match color {
        Color::None => return None,
        Color::Red => Paint::Red,
        Color::Orange => Paint::Orange,
        Color::Yellow => Paint::Yellow,
        Color::Green => Paint::Green,
        Color::Cyan => Paint::Cyan,
        Color::Blue => Paint::Blue,
        Color::Violet => Paint::Violet,
        Color::Gray => Paint::Gray,
    })
}

#[cfg(test)]
mod tests {
    use wasmouse_core::game::{Action, GameRules};
    use wasmouse_core::maze::{Cell, Turn, Walls};
    use wasmouse_core::record::{Transcript, trace};

    use super::super::picture::TextStyle;
    use super::*;

    #[test]
    fn a_moment_shows_what_the_robot_believed_by_then() {
        let maze = Maze::contest(Walls::open(4)).expect("start and goal fit");
        let mut transcript = Transcript::default();
        for turn in [Turn::Right, Turn::Left, Turn::Straight] {
            transcript.push(Action::Move { turn, advance: 1 });
        }
        let rules = GameRules {
            budget: 3,
            ..GameRules::default()
        };
        let (_, trace) = trace(&maze, &rules, &transcript).expect("three steps");
        let mut journal = Journal::default();
        journal.clear(1000);
        let text = |journal: &Journal, steps| {
            moment(&maze, &trace, journal, steps).to_text(TextStyle::ASCII)
        };
        assert!(text(&journal, 0).ends_with("| ^             |\no---o---o---o---o\n"));
        let cell = Cell::new(3, 0);
        for (step, note) in [
            (0, Note::Label { cell, text: "ab" }),
            (
                1,
                Note::Paint {
                    cell,
                    color: Color::Red,
                },
            ),
            (
                2,
                Note::Wall {
                    cell,
                    side: Heading::Left,
                    belief: Belief::Closed,
                },
            ),
            (3, Note::Label { cell, text: "late" }),
        ] {
            journal.push(step, note);
        }
        let [before, after] = [0, 2].map(|steps| text(&journal, steps));
        let last_row = |text: &str| text.lines().nth(7).map(str::to_owned);
        assert_eq!(
            last_row(&before).as_deref(),
            Some("| ^ . . . . .ab |"),
            "\n{before}"
        );
        assert_eq!(
            last_row(&after).as_deref(),
            Some("| S  . .  .    |ab:r|"),
            "\n{after}"
        );
    }
}
