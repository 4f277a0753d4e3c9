//! What the contest rules promise about the goal: [`Room`].
//!
//! The goal room of a contest maze is in the centre, is open inside and has one entrance. The
//! robot assumes that until the maze contradicts it.

use wasmouse_sdk::{Area, Briefing, Grid, Heading};

use crate::knowledge::Known;

/// The goal room, while it is believed to be one with a single entrance.
pub struct Room {
    believed: bool,
    /// The walls around it, of which one is open.
    entrances: Vec<u16>,
    inside: Vec<u16>,
    /// By wall: asked forevery unknown wall after every step.
    parts: Vec<Part>,
}

/// What a wall is to the room.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Nothing,
    Entrance,
    Inside,
}

impl Room {
    /// The room of a match, if the goal is where contests have it.
    pub fn new(briefing: &Briefing) -> Self {
        let (goal, dimension) = (briefing.goal, briefing.dimension);
        let grid = Grid::new(dimension);
        let mut room = Self {
            believed: goal == Area::center(dimension)
                && dimension.is_multiple_of(2)
                && dimension >= 6
                && !goal.contains(briefing.start),
            entrances: Vec::new(),
            inside: Vec::new(),
            parts: vec![Part::Nothing; grid.wall_count()],
        };
        if !room.believed {
            return room;
        }
        for cell in goal.cells() {
            for side in Heading::ALL {
                let wall = grid.wall(grid.cell(cell), side) as u16;
                let inner = cell.toward(side, 1).is_some_and(|it| goal.contains(it));
                let (list, part) = if inner {
                    (&mut room.inside, Part::Inside)
                } else {
                    (&mut room.entrances, Part::Entrance)
                };
                if !list.contains(&wall) {
                    list.push(wall);
                    room.parts[usize::from(wall)] = part;
                }
            }
        }
        room
    }

    /// Whether it is believed in; the walls mean nothing otherwise.
    pub const fn is_believed(&self) -> bool {
        self.believed
    }

    /// The walls of which one is the entrance.
    pub fn entrances(&self) -> &[u16] {
        &self.entrances
    }

    /// The walls that are open because they are inside.
    pub fn inside(&self) -> &[u16] {
        &self.inside
    }

    /// Whether the room says that a wall is open.
    pub fn is_inside(&self, wall: usize) -> bool {
        self.believed && self.parts[wall] == Part::Inside
    }

    /// Whether the room says what that wall is like.
    pub fn holds(&self, wall: usize) -> bool {
        self.believed && self.parts[wall] != Part::Nothing
    }

    /// Gives up the belief when what has been seen contradicts it.
    pub fn check(&mut self, known: &[Known], seen: usize) {
        if !self.holds(seen) {
            return;
        }
        let count = |list: &[u16], what| {
            let alike = |&&wall: &&u16| known[usize::from(wall)] == what;
            list.iter().filter(alike).count()
        };
        self.believed = count(&self.inside, Known::Closed) == 0
            && count(&self.entrances, Known::Open) <= 1
            && count(&self.entrances, Known::Closed) < self.entrances.len();
    }
}
