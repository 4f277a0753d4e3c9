//! Pictures of a match: the ways of both runs, and the state at one step.

use super::picture::{Label, Paint, Picture, Wall};
use crate::maze::{Cell, Heading, Maze};
use crate::robot::{Belief, Color, Journal, Note};
use crate::sim::{Event, Run, Trace};

/// The way of the last run of a match as a line, over how often run 1 stopped in
/// each cell as heat.
pub fn ways(maze: &Maze, trace: &Trace) -> Picture {
    let mut picture = Picture::of(maze);
    let run = trace
        .steps()
        .last()
        .map_or(Run::Exploration, |step| step.run);
    if run == Run::Speed {
        for (cell, visits) in visits(maze, trace) {
            if let Some(mark) = picture.mark_mut(cell) {
                mark.heat = Some(visits);
            }
        }
    }
    picture.set_stops(&stops(maze, trace, run));
    picture
}

/// The cells in which the steps of a run ended, the start first.
fn stops(maze: &Maze, trace: &Trace, run: Run) -> Vec<Cell> {
    let mut stops = vec![maze.start()];
    for step in trace.steps().iter().filter(|step| step.run == run) {
        if let Event::Moved { cell, cells, .. } = step.event
            && cells > 0
        {
            stops.push(cell);
        }
    }
    stops
}

/// How many steps of run 1 ended in each cell where one did.
fn visits(maze: &Maze, trace: &Trace) -> Vec<(Cell, u32)> {
    let mut counts = vec![0; usize::from(maze.dimension()).pow(2)];
    for cell in stops(maze, trace, Run::Exploration) {
        counts[maze.walls().index(cell)] += 1;
    }
    let counted = maze.walls().cells().zip(counts);
    counted.filter(|&(_, visits)| visits > 0).collect()
}

/// A match after its first `steps` steps: the robot, its way in run 2, and
/// everything that it has painted and labelled by then. A robot that tells its
/// beliefs about walls is shown with the maze that it believes in, unknown walls
/// dotted; for any other the true maze is drawn.
pub fn moment(maze: &Maze, trace: &Trace, journal: &Journal, steps: usize) -> Picture {
    let tells_walls = journal
        .entries()
        .any(|entry| matches!(entry.note, Note::Wall { .. }));
    let mut picture = if tells_walls {
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
            Event::ResetDone => {
                (run, cell, heading) = (Run::Speed, maze.start(), Heading::Up);
                stops = vec![cell];
            }
            Event::ResetBeforeGoal | Event::ResetInSpeedRun => {}
        }
    }
    // A way that crosses itself many times hides more than it shows.
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
