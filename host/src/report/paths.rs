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

#[cfg(test)]
mod tests {
    use wasmouse_core::game::{Action, GameRules};
    use wasmouse_core::maze::{Area, Turn, Walls};
    use wasmouse_core::record::{Transcript, trace};

    use super::super::picture::TextStyle;
    use super::*;

    /// The picture of a match with these advances straight on; `None` is a reset.
    #[track_caller]
    fn check(actions: &[Option<i8>], expected: &str) {
        let mut transcript = Transcript::default();
        for action in actions {
            transcript.push(match *action {
                Some(advance) => Action::Move {
                    turn: Turn::Straight,
                    advance,
                },
                None => Action::Reset,
            });
        }
        let rules = GameRules {
            budget: u32::try_from(actions.len()).expect("few"),
            ..GameRules::default()
        };
        // A goal above the start, so that straight on leads there.
        let goal = Area::new(Cell::new(0, 2), 1, 1).expect("one cell");
        let maze = Maze::new(Walls::open(4), Cell::new(0, 0), goal).expect("a maze");
        let (_, trace) = trace(&maze, &rules, &transcript).expect("a match");
        let text = paths(&maze, &trace).to_text(TextStyle::ASCII);
        let column: String = text
            .lines()
            .skip(1)
            .step_by(2)
            .map(|line| &line[1..4])
            .collect();
        assert_eq!(column, expected, "\n{text}");
    }

    #[test]
    fn the_speed_run_is_a_line_over_the_exploration_run() {
        check(&[Some(1), Some(0)], "    G  *  S ");
        check(
            &[Some(1), Some(1), Some(1), Some(-1), None, Some(2)],
            "===#*#=+==S=",
        );
    }
}
