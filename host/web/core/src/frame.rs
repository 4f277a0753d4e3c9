//! [`frame`]: what there is to see at a position, in numbers.

use wasmouse_core::game::{Action, Event, Step};
use wasmouse_core::journal::Belief;
use wasmouse_core::maze::{Cell, Distances, Heading, Metric, distances_to_goal, shortest_path};
use wasmouse_core::playback::Playback;

/// No number.
pub const NONE: i32 = -1;

/// The numbers in front of the lists.
pub const HEAD: usize = 27;

/// What there is to see at a position, which is at most [`Playback::last`].
///
/// | index | meaning |
/// |---|---|
/// | 0 | the position |
/// | 1 to 4 | the run (1 or 2), x, y, heading |
/// | 5 to 7 | steps of the exploration run, of the speed run; whether the goal was reached |
/// | 8 to 10 | the reading: left, front, right |
/// | 11, 12 | the optimal speed run by what is known, in steps: optimistic, pessimistic |
/// | 13, 14 | unknown walls; walls that are new with this reading |
/// | 15 to 19 | the step before this position: see below |
/// | 20 to 24 | the step after it |
/// | 25, 26 | the lengths of the two lists that follow |
/// | from 27 | the cells where the steps of this run ended, x and y each |
/// | then | the cells of the optimistic path, x and y each |
/// | then | by cell: how often the robot was there |
/// | then | by cell: what is known of its sides, 2 bits each from up clockwise: 0 unknown, 1 open, 2 closed |
/// | then | by cell: steps to the goal by the optimistic path |
///
/// A step is its action (0 move, 1 reset), turn (0 left, 1 straight, 2 right), advance, the event as
/// in `Trace::identity_bytes`, and the cells driven. Cells are in the order of `Walls::cells`.
pub fn frame(playback: &Playback, at: usize) -> Vec<i32> {
    let position = playback.at(at);
    let audit = playback.audit().steps[at];
    let knowledge = playback.knowledge(at);
    let optimistic = knowledge.optimistic();
    let metric = Metric::Steps {
        longest_move: playback.rules().longest_move,
    };
    let path = shortest_path(&optimistic, metric).map_or_else(Vec::new, |it| it.trail());
    let stops = playback.stops(at);
    let steps = playback.trace().steps();
    let mut numbers = vec![
        number(at),
        i32::from(position.run.number()),
        i32::from(position.cell.x),
        i32::from(position.cell.y),
        position.heading as i32,
        number(position.steps.exploration as usize),
        number(position.steps.speed as usize),
        i32::from(position.goal_reached),
    ];
    let sensors = position.sensors;
    numbers.extend([sensors.left, sensors.front, sensors.right].map(i32::from));
    numbers.extend([
        optional(audit.outlook.optimistic),
        optional(audit.outlook.pessimistic),
        number(knowledge.unknown_walls()),
        number(audit.new_walls as usize),
    ]);
    numbers.extend(step(at.checked_sub(1).and_then(|it| steps.get(it))));
    numbers.extend(step(steps.get(at)));
    numbers.extend([number(stops.len()), number(path.len())]);
    let cells = stops.iter().chain(&path);
    numbers.extend(cells.flat_map(|it| [i32::from(it.x), i32::from(it.y)]));
    let visits = playback.visits(at);
    numbers.extend(visits.into_iter().map(|it| number(it as usize)));
    let all = || optimistic.walls().cells();
    numbers.extend(all().map(|cell| {
        let code = |side: Heading| match knowledge.wall(cell, side) {
            Belief::Unknown => 0,
            Belief::Open => 1,
            Belief::Closed => 2,
        };
        let sides = Heading::ALL.into_iter();
        sides.fold(0, |sum, side| sum | code(side) << (2 * side as i32))
    }));
    let distances: Distances = distances_to_goal(&optimistic, metric);
    numbers.extend(all().map(|cell: Cell| optional(distances.get(cell))));
    numbers
}

/// The five numbers of a step.
fn step(step: Option<&Step>) -> [i32; 5] {
    let Some(step) = step else {
        return [NONE; 5];
    };
    let (action, turn, advance) = match step.action {
        Action::Move { turn, advance } => (0, turn as i32, i32::from(advance)),
        Action::Reset => (1, NONE, NONE),
    };
    let (event, cells) = match step.event {
        Event::Moved {
            cells,
            bumped,
            clamped,
            ..
        } => (i32::from(bumped) | i32::from(clamped) << 1, cells),
        Event::Reset => (4, 0),
        Event::ResetBeforeGoal => (5, 0),
        Event::ResetInSpeedRun => (6, 0),
    };
    [action, turn, advance, event, i32::from(cells)]
}

/// A number that the page can have; no maze and no match is that large.
pub fn number(number: usize) -> i32 {
    i32::try_from(number).unwrap_or(i32::MAX)
}

/// The same for one that may be missing.
pub fn optional(number: Option<u32>) -> i32 {
    number.map_or(NONE, |it| self::number(it as usize))
}
