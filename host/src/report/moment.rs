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
