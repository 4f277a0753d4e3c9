//! [`paths()`]: both runs of a match in one picture.

use wasmouse_core::game::{Event, Run, Trace};
use wasmouse_core::maze::{Cell, Maze};

use super::picture::Picture;

/// The path of the speed run as a line, over how often the exploration run stopped in each
/// cell as heat. Without a speed run, the path of the exploration run.
pub fn paths(maze: &Maze, trace: &Trace) -> Picture {
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

/// How many steps of the exploration run ended in each cell where one did.
fn visits(maze: &Maze, trace: &Trace) -> Vec<(Cell, u32)> {
    let mut counts = vec![0; usize::from(maze.dimension()).pow(2)];
    for cell in stops(maze, trace, Run::Exploration) {
        counts[maze.walls().index(cell)] += 1;
    }
    let counted = maze.walls().cells().zip(counts);
    counted.filter(|&(_, visits)| visits > 0).collect()
}
